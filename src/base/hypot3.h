// The length of a vector in space.
#pragma once

#include <algorithm>
#include <cmath>

namespace dymsum::base {

/// The length std::hypot(x, y, z), which some standard libraries compute without care for overflow, and each with
/// roundings of its own: here the same everywhere.
inline double hypot3(double x, double y, double z) {
  const double most = std::max({std::abs(x), std::abs(y), std::abs(z)});
  if (!(most > 0)) return 0;
  return most * std::sqrt((x / most) * (x / most) + (y / most) * (y / most) + (z / most) * (z / most));
}

}  // namespace dymsum::base
