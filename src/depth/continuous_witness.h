// A position at which two solids touch.
#pragma once

#include <memory>
#include <optional>

#include "depth/continuous_surface.h"
#include "spatial/mesh/box_tree.h"

namespace dymsum::depth {

/// A solid and a tree of its faces' boxes.
struct WitnessSolid {
  ContinuousSurface surface;
  spatial::BoxTree faces;
};
/// Coordinates are turned, then times `sense`, 1 or -1, in the boxes alone.
WitnessSolid witness_solid(ContinuousSurface surface, const spatial::Mat3& turn, double sense);

/// P, and Q as it is before it is turned, with the boxes of -Q turned.
struct WitnessSolids {
  std::shared_ptr<const WitnessSolid> p, q;
  spatial::Mat3 turn{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};  ///< of Q
  double size = 0;                                                  ///< of coordinates

  Vec3 turned(std::uint32_t q_vertex) const { return turn * q->surface.at[q_vertex]; }
};

/// A position of both boundaries, and features that hold it up to rounding.
struct Witness {
  Vec3 at;
  SolidContact contact;
};

/// A position where Q at x, a position of the sum's boundary, touches P: by the features that the sum's face names, if
/// they do touch there; else, as faces of several pairs may have been put together to one, by faces that come near each
/// other, named by the smallest features there. Nothing where rounding hides it. O(log n + k) for k pairs of faces that
/// come within rounding of each other.
std::optional<Witness> touching_position(const WitnessSolids& solids, const SolidContact& named, Vec3 x);

}  // namespace dymsum::depth
