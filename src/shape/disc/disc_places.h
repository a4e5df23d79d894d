// Doubles near the corners of a level.
#pragma once

#include "shape/disc/disc_formulas.h"
#include "shape/disc/level.h"

namespace dymsum::shape {

/// A vector by a formula: intervals first, the exact expression where these are wider than 2^-48 of it.
template <class Formula>
Point near_vector(const Formula& formula, const Level& level) {
  const Vector<exact::Interval> v = formula(level.near);
  const double width = std::max(v.x.high() - v.x.low(), v.y.high() - v.y.low());
  const double size = std::max(std::abs(v.x.middle()), std::abs(v.y.middle()));
  if (!v.x.is_whole() && !v.y.is_whole() && width <= 0x1p-48 * size) return {v.x.middle(), v.y.middle()};
  const Vector<exact::RootExpression> w = formula(level.exact);
  return {exact::nearest_double(w.x), exact::nearest_double(w.y)};
}

class DiscPlaces {
 public:
  DiscPlaces(const Complex& complex, const Level& level) : complex_(complex), level_(level) {}

  /// The disc of this level on an edge of the complex that reaches it: at its node where that is of this radius.
  CornerDisc disc_on(std::uint32_t edge) const;
  /// Its centre; relative to a point, with the relative accuracy of the vector.
  Point centre(const CornerDisc& disc) const;
  Point centre_from(const CornerDisc& disc, Point origin) const;
  Vector<exact::RootExpression> exact_centre_from(const CornerDisc& disc, Point origin) const;
  /// The unit normal of an edge site towards its discs.
  Point normal(const Site& site) const;
  /// From a disc's centre to where it touches a site, of length radius; and that place.
  Point towards(const CornerDisc& disc, const Site& site) const;
  Point contact(const CornerDisc& disc, const Site& site) const;

  const Complex& complex() const { return complex_; }
  const Level& level() const { return level_; }

 private:
  const Complex& complex_;
  const Level& level_;
};

}  // namespace dymsum::shape
