// One position: sides of planes on which it lies, by doubles where they decide.
#pragma once

#include <cmath>
#include <optional>

#include "spatial/boundary/collision.h"
#include "spatial/boundary/contact_cones.h"

namespace dymsum::spatial {

inline double sum_of_sizes(Vec3 v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

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

}  // namespace dymsum::spatial
