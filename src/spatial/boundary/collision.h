// Whether P overlaps x - Q: whether a position x lies in the open sum.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "spatial/boundary/contact_cones.h"
#include "spatial/convolution/inner_cells.h"
#include "spatial/convolution/solid_operand.h"
#include "spatial/convolution/sum_space.h"
#include "spatial/mesh/box_tree.h"

namespace dymsum::spatial {

struct Feature;
struct FlagQuery;

class Collision {
 public:
  /// `inner` answers for positions deep inside; where it is given it has to live as long.
  Collision(const SumSpace& space, const SolidOperand& p, const SolidOperand& q, const InnerCells* inner = nullptr);

  /// Whether P meets x - Q. For positions at which the solids do not touch without overlapping, as for all off the
  /// facets of the convolution, that is whether they overlap. Exact.
  bool meets(const Flag& x) const;

  /// Whether the interiors of P and x - Q overlap, for any x, also where the solids touch; of thin parts: whether they
  /// meet the other one's interior. Exact.
  bool overlaps(const Flag& x) const;

  /// Whether they meet or touch, for any x and parts of any dimension. Exact.
  bool touches(const Flag& x) const;

  std::uint64_t tests() const { return tests_; }
  const SolidOperand& p() const { return p_; }
  const SolidOperand& q() const { return q_; }

 private:
  using Query = FlagQuery;
  struct Touch;
  /// Signs of the heights of two triangles' corners, each over the other one's plane.
  struct Heights {
    int a[3], c[3];
    bool apart() const;
  };
  bool pierced(const Query& query, std::uint32_t i, std::uint32_t j) const;
  bool pierced(const Query& query, std::uint32_t i, std::uint32_t j, const Heights& h) const;
  bool vertices_inside(const Query& query) const;
  bool provably_inside(const Query& query, DirectionSource::Of of, std::uint32_t v) const;
  void add_touches(const Query& query, std::uint32_t i, std::uint32_t j, const Heights& h,
                   std::vector<Touch>& touches) const;
  void touch_vertices(const Query& query, std::uint32_t i, std::uint32_t j, const Heights& h,
                      std::vector<Touch>& touches) const;
  void touch_edges(const Query& query, std::uint32_t i, std::uint32_t j, const Heights& h,
                   std::vector<Touch>& touches) const;
  std::optional<Feature> position(const Query& query, DirectionSource::Of of, std::uint32_t triangle,
                                  std::uint32_t vertex) const;
  bool segment_crosses(const Query& query, DirectionSource::Of of, std::uint32_t wedge, std::uint32_t triangle) const;
  bool segments_cross(const Query& query) const;
  std::vector<Touch> all_touches(const Query& query) const;
  void add_thin_touches(const Query& query, std::vector<Touch>& touches) const;
  void touch_end(const Query& query, DirectionSource::Of of, std::uint32_t vertex, std::uint32_t triangle,
                 std::vector<Touch>& touches) const;
  void touch_segment(const Query& query, DirectionSource::Of of, std::uint32_t wedge, std::uint32_t triangle,
                     std::vector<Touch>& touches) const;
  bool inside_segment(const Query& query, DirectionSource::Of of, std::uint32_t wedge, std::uint32_t vertex) const;
  bool edges_cross(const Query& query, DirectionSource e, DirectionSource g) const;
  bool thin_lines_meet(const Query& query) const;
  Heights heights(const Query& query, std::uint32_t i, std::uint32_t j) const;
  bool triangles_meet(const Query& query, std::uint32_t i, std::uint32_t j) const;
  bool vertex_inside(const Query& query, DirectionSource::Of of, std::uint32_t v) const;

  const SumSpace& space_;
  const SolidOperand &p_, &q_;
  BoxTree p_tree_, q_tree_;
  BoxTree p_segments_, q_segments_, p_points_, q_points_;  // in the order of the operands' lists
  std::array<std::vector<std::uint32_t>, 2> samples_;      // some vertices of P and of Q
  const InnerCells* inner_;
  mutable std::atomic<std::uint64_t> tests_{0};
};

// One position: sides of planes on which it lies, by doubles where they decide.

struct FlagQuery {
  const SumSpace& space;
  const Flag& flag;
  Approx at;

  /// Coordinates of x in exact doubles, without steps, are multiples of 1 over this: a power of two; 0 where x is not
  /// so.
  double per_unit;

  FlagQuery(const SumSpace& s, const Flag& x)
      : space(s),
        flag(x),
        at(s.approximate(x.at)),
        per_unit(x.direction == 0 && x.left == 0 && x.side == 0 ? steps_per_unit() : 0) {}

  double steps_per_unit() const {
    if (flag.at.kind == PointSource::Kind::sum) return 1;
    if (flag.at.kind != PointSource::Kind::position || at.radius != 0) return 0;
    double steps = 1;
    while (steps < 0x1p40 &&
           (is_fraction(at.at.x * steps) || is_fraction(at.at.y * steps) || is_fraction(at.at.z * steps)))
      steps *= 2;
    return steps < 0x1p40 ? steps : 0;
  }
  static bool is_fraction(double v) { return v != std::floor(v); }

  /// A box that x lies in.
  Box box() const {
    Box box;
    box.add(at.at);
    box.grow(at.radius + space.span() * 0x1p-50);
    return box;
  }

  /// Turned inside out: of reflected pairs those whose boxes overlap by more than touching ones do.
  Box core() const {
    Box box;
    box.add(at.at);
    box.grow(-(at.radius + space.span() * 0x1p-20));
    return box;
  }

  /// The side of the plane on which x lies.
  int side(const PlaneSource& plane, Vec3 u, Vec3 v) const {
    const double r = space.sum_radius();
    const Vec3 n = cross(u, v), gap = at.at - space.approx(plane.at);
    const double U = sum_of_sizes(u) + 4 * r, V = sum_of_sizes(v) + 4 * r, W = sum_of_sizes(gap) + at.radius + 4 * r;
    const double value = dot(n, gap);
    if (per_unit != 0 && space.computed_exactly(U, V, W * per_unit))
      return value == 0 ? 0 : (value > 0) != plane.reversed ? 1 : -1;
    const double error =
        U * V * W * 0x1p-48 + 8 * r * (U * V + V * W + U * W) + U * V * (at.radius + space.span() * 0x1p-52);
    if (value > error || value < -error) return (value > 0) != plane.reversed ? 1 : -1;
    return space.exact_side(plane, flag);
  }
};

/// A position at which P and x - Q touch, and the features that do.
struct Collision::Touch {
  Feature p, q;
  friend auto operator<=>(const Touch&, const Touch&) = default;
};

/// An axis that does not lie in the plane of two directions; -1 where they are parallel.
inline int axis_across(const SumSpace& space, DirectionSource u, DirectionSource v) {
  for (std::uint32_t axis = 0; axis < 3; ++axis)
    if (space.det(u, v, {DirectionSource::Of::axis, axis, 0}) != 0) return static_cast<int>(axis);
  return -1;
}
inline Vec3 axis_vector(int axis) { return {axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0}; }

// Thin parts of both operands that can cross each other, so that a small motion does not part them.

/// A plate of one operand, and a plate or a segment of the other one that is not parallel to it.
struct ThinCrossing {
  std::uint32_t p = 0, q = 0;  ///< faces of the operands' meshes
};

/// The first one, or nothing: then the sum of all thin parts of P and Q has no interior. Exact. O(m + n) for m and n
/// plates, O(m k) for m plates and k segments of the other operand.
std::optional<ThinCrossing> find_thin_crossing(const SumSpace& space, const SolidOperand& p, const SolidOperand& q);

/// Thrown where the open sum is requested: such parts have none.
struct NoOpenSum {
  ThinCrossing parts;
};

}  // namespace dymsum::spatial
