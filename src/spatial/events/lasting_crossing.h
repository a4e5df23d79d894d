// Two borders that cross at all scales, in one plane: where their crossing is at both ends of a window, in doubles.
#pragma once

#include <array>

#include "spatial/events/moving_facets.h"

namespace dymsum::spatial {

/// The crossing's position is a linear function of the scale: what holds at both ends of a window of the sides of a
/// hyperplane holds between them.
struct LastingCrossing {
  bool misses = false;  ///< surely beyond an end of a border at all scales of the window
  bool known = false;   ///< the positions are
  std::array<Vec3, 2> at;
  std::array<double, 2> scale{};
  double blur = 0;  ///< of every coordinate

  /// Whether the crossing surely stays on one side of a hyperplane.
  bool stays_beside(const PlaneRow& row) const;
};

/// Of borders in one plane that are not parallel, at scales from `low` to `high`.
LastingCrossing lasting_crossing_of(const MovingFacets& all, const MovingBorder& one, const MovingBorder& other,
                                    double low, double high);

}  // namespace dymsum::spatial
