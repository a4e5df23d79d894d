// The grid on which the vertices of sets are integers, where no doubles hold them.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "exact/big.h"
#include "spatial/convolution/operand_signs.h"
#include "spatial/sum/exact_set.h"

namespace dymsum::spatial {

/// Coordinates are multiples of 2^exponent / scale, scale odd; doubles see them in units of 2^shift / scale, in which
/// sizes are what they are, up to a factor of two.
struct CommonGrid {
  exact::BigInteger scale = 1;
  std::optional<int> exponent;  ///< nothing where all coordinates are 0

  int shift() const { return static_cast<int>(msb(scale)); }
  /// The exponent of the multiples, as doubles see them.
  int unit() const { return exponent.value_or(0) - shift(); }
};

/// The coarsest one for all sets. Error out_of_range, with a vertex, where its scale needs more than kMostGridBits
/// bits.
Result<CommonGrid> common_grid(std::span<const ExactSet* const> sets);

/// The vertices of a set on it. Error out_of_range, with a vertex, where one needs more than kMostGridBits bits.
Result<std::vector<ExactVertex>> vertices_on(const CommonGrid& grid, const ExactSet& set);

}  // namespace dymsum::spatial
