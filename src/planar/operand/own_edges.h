// The edges of one operand by themselves: vectors and exact signs that need no lattice with another operand.
#pragma once

#include <cmath>
#include <cstdint>

#include "exact/int.h"
#include "exact/orient.h"
#include "exact/signs.h"
#include "planar/operand/fraction_points.h"
#include "planar/operand/lattice_build.h"

namespace dymsum::planar {

/// Edges between source vertices that are neither scaled nor turned. Signs are of the points as given, in integers of
/// at most 53 bits where these hold them, else by the exact predicates of doubles, or those of fractions.
class OwnEdges {
 public:
  explicit OwnEdges(const PlacedPoints& points)
      : input_(points.input.data()),
        x_(points.x.data()),
        y_(points.y.data()),
        fractions_(points.fractions.get()),
        unit_(points.unit),
        per_unit_(power_of_two(-points.unit)) {
    const int shift = points.unit - points.exponent;
    if (fractions_ == nullptr && points.bits(points.exponent) <= 53 && std::abs(shift) <= 1000)
      per_double_ = power_of_two(shift);
  }

  /// Each component rounded once, in the units of the points; zero only where it is.
  Point vector(std::uint32_t from, std::uint32_t to) const {
    if (fractions_ != nullptr) return fractions_->vector(from, to, unit_);
    const Point d = direction(from, to);
    return {with_sign_of(d.x, d.x * per_unit_), with_sign_of(d.y, d.y * per_unit_)};
  }
  /// The direction in input units, or those of the edge's own fractions: no rounding underflows.
  Point direction(std::uint32_t from, std::uint32_t to) const {
    if (fractions_ != nullptr) return fractions_->direction(from, to);
    const Point a = input_[from], b = input_[to];
    return {b.x - a.x, b.y - a.y};
  }
  /// The sign of d x e, of d . e for edge vectors.
  int cross(const Edge& d, const Edge& e) const {
    if (fractions_ != nullptr) return fractions_->cross(d, e);
    if (per_double_ == 0) return exact::cross_sign(input_[d.from], input_[d.to], input_[e.from], input_[e.to]);
    return exact::sign_of_cross(along(x_, d), along(y_, d), along(x_, e), along(y_, e));
  }
  int dot(const Edge& d, const Edge& e) const {
    if (fractions_ != nullptr) return fractions_->dot(d, e);
    if (per_double_ == 0) return exact::dot_sign(input_[d.from], input_[d.to], input_[e.from], input_[e.to]);
    return exact::sign_of_dot(along(x_, d), along(y_, d), along(x_, e), along(y_, e));
  }

 private:
  exact::Int<54> along(const double* coordinates, const Edge& e) const {
    return integer(coordinates[e.to]) - integer(coordinates[e.from]);
  }
  // The integer has at most 53 bits: no step of making the double was rounded.
  exact::Int<53> integer(double coordinate) const {
    return exact::Int<53>::from_int64(static_cast<std::int64_t>(coordinate * per_double_));
  }

  const Point* input_;
  const double *x_, *y_;
  const FractionPoints* fractions_;
  int unit_;
  double per_unit_, per_double_ = 0;
};

}  // namespace dymsum::planar
