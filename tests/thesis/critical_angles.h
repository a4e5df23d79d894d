// When the Gauss maps of two solids meet while P turns about a fixed axis: every angle at which a normal of one lies on
// an arc of the other.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "exact/rounding_bound.h"
#include "spatial/gauss/polytope.h"
#include "thesis/quadratic_root.h"

namespace dymsum::spatial {

/// P rotated by the quaternion (u, v d) with d the axis: the sign of (op, f, h) as a form in (u : v), t = v / u =
/// tan(theta / 2) / |d|. With x the edge, n the normal and s = -1 for op = 0 (P's coordinates see Q turn back), s = 1
/// for op = 1:
///   n . N x = u^2 (n . x) + 2 s u v n . (d x x) + v^2 (2 (n . d)(d . x) - |d|^2 (n . x)).
class RotationForms {
 public:
  RotationForms(const Polytope& p, const Polytope& q, std::array<std::int64_t, 3> axis);

  const Polytope& poly(int op) const { return *poly_[op]; }
  const std::array<std::int64_t, 3>& axis() const { return axis_; }
  Vec3 unit_axis() const { return unit_; }
  double axis_length() const { return length_; }
  exact::Quadratic form(int op, std::uint32_t f, HalfEdge h) const;
  /// theta of a root in [0, 2 pi], within kAngleError.
  double angle(const exact::QuadraticRoot& root) const;
  // Twice the arc tangent of a quotient: components of the root (16 each) and the axis's length in a product (3) turn
  // it by half of that, itself it errs by 4; whole turns (3), and the sum with one (4).
  static constexpr double kAngleError = exact::rounding_bound(16 + 16 + 3 + 2 * 4 + 3 + 4, 128);

 private:
  std::array<const Polytope*, 2> poly_;
  std::array<std::int64_t, 3> axis_;
  Vec3 unit_;
  double length_ = 0;
};

/// The normal of face f of operand op lies on the arc of an edge of the other one: a root, of this slope, of the form
/// of (op, f, 2 edge).
struct RotationEvent {
  double angle = 0;  ///< within RotationForms::kAngleError
  std::uint32_t face = 0, edge = 0;
  std::int8_t op = 0, slope = 0;

  exact::QuadraticRoot root(const RotationForms& forms) const;
};

struct RotationEventCounts {
  std::uint64_t pairs = 0, persistent = 0, meetings = 0, exact_pairs = 0, exact_orders = 0;
};

/// One event per angle, ascending in [0, 2 pi). A pair whose form vanishes identically has no events: where it matters
/// (the normal enters or leaves the arc) other pairs see it. Calls on_face(done, all) now and then and stops, with
/// nothing, when it answers false. O(m n) for m and n features.
std::optional<std::vector<RotationEvent>> find_rotation_events(
    const RotationForms& forms, RotationEventCounts& counts,
    const std::function<bool(std::size_t, std::size_t)>& on_face);

}  // namespace dymsum::spatial
