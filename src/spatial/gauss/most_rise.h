// How far a solid's edges at a vertex rise at most.
#pragma once

#include <cstdint>
#include <limits>

#include "spatial/gauss/polytope.h"

namespace dymsum::spatial {

/// Calls look(slot) for slots of the ring of v: at least for all whose product of `row` and the unit vector along the
/// edge is at least `least`. O(those) and a few more at vertices of many edges, else O(edges).
template <class Look>
void look_above(const Polytope& p, std::uint32_t v, Vec3 row, double least, const Look& look) {
  const std::uint32_t begin = p.ring_start[v], end = p.ring_start[v + 1];
  const auto all = [&](std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t k = first; k < last; ++k)
      if (dot(row, p.ring_direction[begin + k]) >= least) look(k);
  };
  if (const RingBounds* bounds = p.bounds(p.direction_bounds, v)) bounds->look_above(row, least, all);
  else all(0, end - begin);
}

/// The largest product of `row` and a unit vector along an edge that leaves v, which has three or more. At vertices of
/// many edges, where all fall, perhaps something larger: at most a quarter of the largest one, and negative.
inline double most_rise(const Polytope& p, std::uint32_t v, Vec3 row) {
  const auto rise = [&](std::uint32_t k) { return dot(row, p.ring_direction[k]); };
  const auto larger = [](double a, double b) { return a > b ? a : b; };
  const std::uint32_t end = p.ring_start[v + 1];
  std::uint32_t k = p.ring_start[v];
  if (const RingBounds* bounds = p.bounds(p.direction_bounds, v))
    return bounds->above_all(row, [&](std::uint32_t slot) { return rise(k + slot); });
  double most = -std::numeric_limits<double>::infinity(),
         also = most;  // two, so that comparisons need not wait for each other
  for (; k + 1 < end; k += 2) {
    most = larger(rise(k), most);
    also = larger(rise(k + 1), also);
  }
  return larger(also, larger(rise(end - 1), most));  // an odd last one, or one once more
}

}  // namespace dymsum::spatial
