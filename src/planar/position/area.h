// Areas of sums from the exact positions of their vertices: exactly, and the nearest double.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "dymsum/planar_sum.h"
#include "dymsum/rational.h"
#include "exact/big.h"
#include "planar/position/exact_source.h"

namespace dymsum::planar {

// The exact area bounded by rings of rational positions.

/// numerator / denominator in lowest terms, denominator > 0. Two integers rather than a BigRational: that would look
/// for common factors again, by a binary gcd of quadratic cost.
struct ExactArea {
  exact::BigInteger numerator = 0, denominator = 1;

  Rational to_rational() const;
  /// Correctly rounded.
  double to_double() const;
};

/// Half the sum of the cross products along all rings: counter-clockwise rings count positive, clockwise ones negative.
/// Cost for n vertices of b bits: O(M(n b) log n), M Boost's multiplication, and a few divisions of n b bits.
ExactArea exact_area(const std::vector<std::vector<Position>>& rings);
/// Positions in lowest terms cost least.
ExactArea exact_area(std::vector<std::vector<Homogeneous>> rings);

// The area of a sum, rounded once, without the common denominator of all its vertices.

/// Both ends hold the exact area between them; equal: they are the exact area.
using AreaRange = std::pair<exact::BigRational, exact::BigRational>;

/// Calls decide(range) for narrower and narrower ranges until it returns true, which it has to when both ends are
/// equal: first positions as pairs of doubles, at a few operations a vertex; then multiples of a power of two, 2^-256
/// and 2^-1024 of the largest coordinate; then the exact fraction, at the cost of exact_area. A rounding to d bits is
/// not decided by the first range only where the area is within about n 2^-94 extent^2 of a position where the rounding
/// changes.
void narrow_area(const PlanarSum& sum, const std::function<bool(const AreaRange&)>& decide);

/// The nearest double.
double nearest_area(const PlanarSum& sum);

/// The fraction, where the denominators of the vertices that are no powers of two have no more than `bits` bits
/// together.
std::optional<Rational> area_within(const PlanarSum& sum, std::size_t bits);

/// The exact fraction.
Rational area_fraction(const PlanarSum& sum);

}  // namespace dymsum::planar
