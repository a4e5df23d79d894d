// Sums of regions and of results.
#include <optional>

#include "planar/operand/prepared_region.h"
#include "planar/result/finish_sum.h"
#include "planar/result/result_region.h"
#include "planar/sum/sum_engine.h"
#include "planar/sum/taken_operand.h"

namespace dymsum {

std::shared_ptr<const planar::Operand> planar::taken_operand(const PlanarOperand& operand, std::uint32_t op,
                                                             bool reflected) {
  if (const Region* const* region = std::get_if<const Region*>(&operand.set()))
    return prepared_operand(**region, op, reflected);
  return make_operand(region_of_result(*std::get<const PlanarSum*>(operand.set())), op, reflected);
}

namespace {

Result<PlanarSum> sum_of(const PlanarOperand& p, const PlanarOperand& q, bool reflected, const SumOptions& options) {
  Result<planar::SumState> state =
      planar::compute_boundary(planar::taken_operand(p, 0), planar::taken_operand(q, 1, reflected), options);
  if (!state) return state.error();
  return planar::finish_sum(std::move(state).value(), options);
}

}  // namespace

Result<PlanarSum> minkowski_sum(const PlanarOperand& p, const PlanarOperand& q, const SumOptions& options) {
  return sum_of(p, q, false, options);
}

Result<PlanarSum> nfp(const PlanarOperand& a, const PlanarOperand& b, const SumOptions& options) {
  return sum_of(a, b, true, options);
}

Result<PlanarSum> minkowski_sum(std::span<const PlanarOperand> sets, const SumOptions& options) {
  if (sets.empty()) return Error{ErrorCode::out_of_range, "a sum takes at least one set, not 0", {}};
  const Result<Region> origin = Region::create({{}, {}, {Point{0, 0}}});
  if (sets.size() == 1) return minkowski_sum(sets[0], *origin, options);
  SumOptions between = options;
  between.semantics = Semantics::closed;
  between.trace = false;
  std::optional<PlanarSum> sum;
  for (std::size_t k = 1; k < sets.size(); ++k) {
    const PlanarOperand& first = k == 1 ? sets[0] : PlanarOperand(*sum);
    Result<PlanarSum> next = minkowski_sum(first, sets[k], k + 1 == sets.size() ? options : between);
    if (!next) return next;
    sum = std::move(next).value();
  }
  return *std::move(sum);
}

}  // namespace dymsum
