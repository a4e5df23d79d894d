// An order of rotations in which neighbours are near.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dymsum/rotation.h"

namespace dymsum::spatial {

/// The numbers of the rotations along a Hilbert curve through each of the four cubes of quaternions with the same
/// largest component.
std::vector<std::uint32_t> pose_order(std::span<const Rotation> poses);

}  // namespace dymsum::spatial
