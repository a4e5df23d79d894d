// Random regions of several parts at decimal distances: points that would be one, or in line, differ by rounding, so
// that signs are tiny without being zero.
#pragma once

#include <cstdint>
#include <random>

#include "dymsum/region.h"

namespace dymsum::oracles {

/// `parts` rings of 3 to `most` vertices out of [-reach, reach]^2, in a row with 2.2 reach between them, every
/// coordinate times `unit`; some have a hole. Rings never touch.
inline Region decimal_parts(std::mt19937_64& random, int reach, int most, int parts, double unit = 1) {
  const auto whole = [&] {
    return static_cast<double>(static_cast<int>(random() % static_cast<unsigned>(2 * reach + 1)) - reach);
  };
  RegionData data;
  const auto add = [&](RegionData more, std::size_t expected, std::size_t holes) {
    const Result<Repaired> repaired = repair(more);
    if (!repaired || !repaired->region.touching_points().empty() || repaired->region.parts().size() != expected)
      return false;
    std::size_t found = 0;
    for (const Part& part : repaired->region.parts()) found += part.holes.size();
    if (found != holes) return false;
    data = std::move(more);
    return true;
  };
  std::size_t holes = 0;
  while (data.parts.size() < static_cast<std::size_t>(parts)) {
    RegionData more = data;
    const double dx = 2.2 * reach * static_cast<double>(data.parts.size());
    const auto ring = [&](int n) {
      Ring made;
      for (int i = 0; i < n; ++i) made.push_back({unit * (whole() + dx), unit * whole()});
      return made;
    };
    more.parts.push_back({ring(3 + static_cast<int>(random() % static_cast<unsigned>(most - 2))), {}});
    if (!add(more, more.parts.size(), holes)) continue;
    if (random() % 3 != 0) continue;
    more.parts.back().holes.push_back(ring(3));
    if (add(more, more.parts.size(), holes + 1)) ++holes;
  }
  return repair(data).value().region;
}

/// The region within a frame whose free inside reaches from -low to high in x and from -low to low in y, if that keeps
/// clear of it; else the region.
inline Region framed(const Region& region, double low, double high) {
  RegionData data = region.data();
  const double out = 2 * high + low;
  data.parts.push_back(
      {{{-out, -out}, {out, -out}, {out, out}, {-out, out}}, {{{-low, -low}, {-low, low}, {high, low}, {high, -low}}}});
  Result<Region> made = Region::create(std::move(data));
  return made && made->touching_points().empty() ? *made : region;
}

}  // namespace dymsum::oracles
