// Where two solids touch.
#pragma once

#include <memory>
#include <optional>

#include "depth/continuous_surface.h"

namespace dymsum::depth {

/// P, and Q as it is before it is turned.
struct WitnessSolids {
  std::shared_ptr<const ContinuousSurface> p, q;
  spatial::Mat3 turn{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};  ///< of Q

  Vec3 turned(std::uint32_t q_vertex) const { return turn * q->at[q_vertex]; }
  /// Whether a position is on both boundaries, Q being at x, up to rounding.
  bool touches(Vec3 w, Vec3 x, double slack) const;
};

/// A position of both boundaries where Q is at x, a position of the sum's boundary: by the features that its face
/// names, or, where faces of several pairs were put together, by all vertices, then all edges. O(n) mostly, else O(m
/// n). Nothing where rounding hides it.
std::optional<Vec3> touching_position(const WitnessSolids& solids, const SolidContact& contact, Vec3 x);

}  // namespace dymsum::depth
