// The sides of the box that a sum is cut to, and of a larger one, in which everything near it is known.
#pragma once

#include <array>
#include <vector>

#include "planar/local/near_segments.h"
#include "planar/local/posed_regions.h"

namespace dymsum::planar {

/// A line x = value or y = value. Beyond all sums it cuts nothing.
struct LocalWall {
  int axis = 0;
  double value = 0;   ///< in input coordinates
  double scaled = 0;  ///< rounded
  bool beyond = false;
  BigPlace exact;         ///< its coordinate, for both axes
  base::DoublePair pair;  ///< the same
};

class LocalWalls {
 public:
  LocalWalls(const PosedRegions& posed, const PlanarBox& box, const PlanarBox& reach);

  const std::array<LocalWall, 8>& all() const { return walls_; }  ///< low x, high x, low y, high y; the larger box's
  /// The larger box, in scaled doubles.
  ScaledBox reach() const { return {walls_[4].scaled, walls_[6].scaled, walls_[5].scaled, walls_[7].scaled}; }

 private:
  std::array<LocalWall, 8> walls_;
};

/// A box about the box: a 32nd larger, or by more than doubles err in what is found with them.
PlanarBox larger_box(const PlanarBox& box, double extent);

}  // namespace dymsum::planar
