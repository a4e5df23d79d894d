// The exact area bounded by rings of rational positions.
#pragma once

#include <vector>

#include "dymsum/rational.h"
#include "planar/position/position_signs.h"

namespace dymsum::planar {

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

}  // namespace dymsum::planar
