// The directions along which the faces of a turned part lie: those of the axes that it had before it was turned.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "dymsum/mesh.h"
#include "spatial/mesh/vec3.h"

namespace dymsum::spatial {

/// Three directions of length about 1, with a positive determinant.
using FaceAxes = std::array<Vec3, 3>;

/// Directions so that as much area as possible lies in planes that two of them span. The first is the normal of the
/// faces with the most area that are parallel; the second that of those with the most area at a right angle to them, or
/// else the longest edge of theirs; the third is orthogonal to both. Where no faces are at a right angle to the first
/// and others are parallel by two families more, the planes of all three. Faces are parallel where
/// that moves none of their vertices by more than about `tolerance`. Nothing where no two faces, and no face of more
/// than three vertices, lie in parallel planes. In doubles. O(n log n).
std::optional<FaceAxes> face_axes(const MeshData& data, std::span<const std::uint32_t> faces, double tolerance);

/// Whether two of them are the same directions but for their order and their signs, to within `angle`.
bool same_axes(const FaceAxes& a, const FaceAxes& b, double angle);
bool have_common_axis(const FaceAxes& a, const FaceAxes& b, double angle);

}  // namespace dymsum::spatial
