// The pose of a region: rotated and scaled, exactly.
#pragma once

#include <array>

#include "dymsum/orientation.h"
#include "dymsum/scale.h"

namespace dymsum {

/// A rotation and scales of a polygon about the origin: x -> rotation (diag(scale) x). Exact and of any size; short
/// rotations (Orientation::nearest with an error) make exact signs cheap.
struct PlanarPose {
  Orientation rotation;
  std::array<Scale, 2> scale;
  friend bool operator==(const PlanarPose&, const PlanarPose&) = default;
};

}  // namespace dymsum
