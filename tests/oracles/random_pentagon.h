// Regions of five free doubles about a position: nothing of theirs is exact on a small grid.
#pragma once

#include <cmath>
#include <numbers>
#include <utility>

#include "dymsum/region.h"
#include "oracles/random.h"

namespace dymsum::oracles {

inline Region random_pentagon(Random& random, double x, double y, double size) {
  RegionData data;
  data.parts.emplace_back();
  for (int k = 0; k < 5; ++k) {
    const double angle = 2 * std::numbers::pi * (k + 0.4 * random.signed_unit()) / 5;
    data.parts[0].outer.push_back({x + size * std::cos(angle), y + size * std::sin(angle)});
  }
  return Region::create(std::move(data)).value();
}

}  // namespace dymsum::oracles
