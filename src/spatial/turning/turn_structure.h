// The structure of a sum while an operand turns: faces by the planes that move as one, how they meet, what is tight.
#pragma once

#include "spatial/turning/turn_forms.h"

namespace dymsum::spatial {

/// What makes two sums topologically different.
struct SolidTopology {
  std::size_t shells = 0, tight_faces = 0, tight_segments = 0, tight_points = 0;
  std::int64_t euler = 0;  ///< of the boundary: 2 for each shell, less 2 for each tunnel
  friend bool operator==(const SolidTopology&, const SolidTopology&) = default;
};
SolidTopology topology_of(const SpatialSum& sum);

/// Independent of positions and of the order of vertices. A face is named by its plane as a function of the angle: two
/// pairs of features whose planes are one at all angles have one name, as walls along the axis have.
std::uint64_t structure_hash(const TurningPair& pair, const SpatialSum& sum);

}  // namespace dymsum::spatial
