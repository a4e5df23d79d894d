// The units in which the vertices of sets are short numbers, where no doubles hold them: integers over a common
// denominator that is short, or fractions with denominators of their own.
#pragma once

#include <span>
#include <vector>

#include "exact/big.h"
#include "spatial/convolution/operand_signs.h"
#include "spatial/sum/exact_set.h"

namespace dymsum::spatial {

/// Coordinates are integers in units of 2^exponent / scale, scale odd; or, where that would make them long, fractions
/// in units of 2^exponent, and the scale is 1. Doubles see them in units of 2^shift / scale, in which sizes are what
/// they are, up to a factor of two.
struct CommonGrid {
  exact::BigInteger scale = 1;
  int exponent = 0;

  int shift() const { return static_cast<int>(msb(scale)); }
  /// The exponent of the units, as doubles see them.
  int unit() const { return exponent - shift(); }
};

/// The coarsest one for all sets; fractions where integers need more than `most_bits` bits.
CommonGrid common_grid(std::span<const ExactSet* const> sets, int most_bits = kMostCommonBits);

/// The vertices of a set on it.
std::vector<ExactVertex> vertices_on(const CommonGrid& grid, const ExactSet& set);

}  // namespace dymsum::spatial
