// Doubles near the corners of a level.
#pragma once

#include "shape/disc/disc_formulas.h"
#include "shape/disc/level.h"

namespace dymsum::shape {

/// A vector by a formula, each component within 2^-43 of `scale`: intervals first, the exact expression where these are
/// wider.
template <class Formula>
Point near_vector(const Formula& formula, const Level& level, double scale) {
  const Vector<exact::Interval> v = formula(level.near);
  const double width = std::max(v.x.high() - v.x.low(), v.y.high() - v.y.low());
  if (!v.x.is_whole() && !v.y.is_whole() && width <= 0x1p-43 * scale) return {v.x.midpoint(), v.y.midpoint()};
  const Vector<exact::RootExpression> w = formula(level.exact);
  return {exact::nearest_double(w.x), exact::nearest_double(w.y)};
}

class DiscPositions {
 public:
  DiscPositions(const Complex& complex, const Level& level);

  /// The disc of this level on an edge of the complex that reaches it: at its node where that is of this radius.
  CornerDisc disc_on(std::uint32_t edge) const;
  /// Its centre, within 2^-42 of the reach.
  Point centre(const CornerDisc& disc) const;
  /// The vector to the centre from a vertex that the disc touches, within 2^-43 of the radius.
  Point centre_from(const CornerDisc& disc, Point vertex) const;
  Vector<exact::RootExpression> exact_centre_from(const CornerDisc& disc, Point origin) const;
  /// The unit normal of an edge site towards its discs.
  Point normal(const Site& site) const;
  /// The vector from a disc's centre to where it touches a site, of length radius; and that position.
  Point towards(const CornerDisc& disc, const Site& site) const;
  Point contact(const CornerDisc& disc, const Site& site) const;

  /// The largest coordinate of the region, or the radius where that is larger.
  double reach() const { return reach_; }
  /// Positions of a set are within this in each coordinate: a centre is within 2^-42 of the reach, and a contact takes
  /// a few roundings more.
  double at_error() const { return 0x1p-41 * reach_; }
  const Complex& complex() const { return complex_; }
  const Level& level() const { return level_; }

 private:
  const Complex& complex_;
  const Level& level_;
  double reach_ = 0;
};

}  // namespace dymsum::shape
