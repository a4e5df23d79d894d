#include "planar/frames/region_pair.h"

#include <cmath>

#include "planar/operand/prepared_region.h"
#include "planar/position/exact_source.h"

namespace dymsum::planar {

Result<std::shared_ptr<const OperandPair>> pair_of_regions(const Region& p, const Region& q,
                                                           const PairOptions& options) {
  return OperandPair::create({prepared_operand(p, 0), prepared_operand(q, 1, options.reflect_q)}, options.further,
                             options.moved, options.min_tier_bits, options.spread);
}

Result<std::shared_ptr<const OperandPair>> pair_of_regions(const Region& p, const Region& q,
                                                           const MovingOptions& options) {
  if (!(options.window >= 0) || std::isinf(options.window))
    return Error{ErrorCode::out_of_range, "how far windows reach ahead is a finite number of at least 0", {}};
  if (options.threads < 0) return Error{ErrorCode::out_of_range, "there are at least 0 threads", {}};
  return pair_of_regions(p, q,
                         PairOptions{.moved = options.moving == MovingOperand::p ? 0U : 1U,
                                     .reflect_q = options.reflect_q,
                                     .min_tier_bits = SumInternals::min_tier_bits(options)});
}

}  // namespace dymsum::planar
