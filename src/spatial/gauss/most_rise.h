// How far a solid's edges at a vertex rise at most.
#pragma once

#include <cstdint>
#include <limits>

#include "spatial/gauss/polytope.h"

namespace dymsum::spatial {

/// The largest product of `row` and a unit vector along an edge that leaves v, which has three or more.
inline double most_rise(const Polytope& p, std::uint32_t v, Vec3 row) {
  const auto rise = [&](std::uint32_t k) { return dot(row, p.ring_direction[k]); };
  const auto larger = [](double a, double b) { return a > b ? a : b; };
  const std::uint32_t end = p.ring_start[v + 1];
  std::uint32_t k = p.ring_start[v];
  double most = -std::numeric_limits<double>::infinity(),
         also = most;  // two, so that comparisons need not wait for each other
  for (; k + 1 < end; k += 2) {
    most = larger(rise(k), most);
    also = larger(rise(k + 1), also);
  }
  return larger(also, larger(rise(end - 1), most));  // an odd last one, or one once more
}

}  // namespace dymsum::spatial
