// Regions as the operand pair of a moving sum.
#pragma once

#include "dymsum/frames.h"
#include "planar/frames/operand_pair.h"

namespace dymsum::planar {

struct PairOptions {
  std::uint32_t moved = 0;                         ///< operand
  bool reflect_q = false;                          ///< P (+) -Q
  std::array<std::vector<Point>, 2> further = {};  ///< source vertices that belong to no walk
  int min_tier_bits = 0;
  Spread spread = Spread::narrow;
};

/// P as operand 0, Q as operand 1. Errors: unsupported_operand; out_of_range for options.
Result<std::shared_ptr<const OperandPair>> pair_of_regions(const Region& p, const Region& q,
                                                           const PairOptions& options = {});
Result<std::shared_ptr<const OperandPair>> pair_of_regions(const Region& p, const Region& q,
                                                           const MovingOptions& options);

}  // namespace dymsum::planar
