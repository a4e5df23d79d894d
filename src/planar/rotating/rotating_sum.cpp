#include "dymsum/rotating_sum.h"

#include "planar/frames/region_pair.h"
#include "planar/operand/prepared_region.h"
#include "planar/position/exact_source.h"
#include "planar/rotating/rotating_state.h"

namespace dymsum {
namespace {

// With the smaller operand as operand 1.
Result<std::shared_ptr<const planar::OperandPair>> pair_of_forms(
    const Region& p, const Region& q, const MovingOptions& options,
    const std::shared_ptr<const planar::OperandPair>& base) {
  if (!planar::RotatingState::has_windows(*base) || !planar::RotatingState::p_is_smaller(*base)) return base;
  return planar::OperandPair::create(
      {planar::prepared_operand(q, 0, options.reflect_q), planar::prepared_operand(p, 1)}, {}, 1,
      planar::SumInternals::min_tier_bits(options));
}

}  // namespace

RotatingSum::RotatingSum(std::unique_ptr<State> state) : state_(std::move(state)) {}
RotatingSum::RotatingSum(RotatingSum&&) noexcept = default;
RotatingSum& RotatingSum::operator=(RotatingSum&&) noexcept = default;
RotatingSum::~RotatingSum() = default;

Result<RotatingSum> RotatingSum::create(const Region& p, const Region& q, const MovingOptions& options) {
  const auto base = planar::pair_of_regions(p, q, options);
  if (!base) return base.error();
  const auto forms_base = pair_of_forms(p, q, options, *base);
  if (!forms_base) return forms_base.error();
  auto state = std::make_unique<State>(*base, *forms_base, options);
  state->options.mode = FrameMode::rebuild;
  Result<FrameChanges> first = state->move_to(Orientation());
  if (!first) return first.error();
  state->options.mode = options.mode;
  return RotatingSum(std::move(state));
}

Result<FrameChanges> RotatingSum::set(const Orientation& theta) { return state_->move_to(theta); }
const Orientation& RotatingSum::orientation() const { return state_->orientation; }
const PlanarSum& RotatingSum::sum() const { return state_->sum; }
std::vector<std::uint64_t> RotatingSum::ring_ids() const { return state_->ring_ids; }
const FrameWork& RotatingSum::work() const { return state_->work; }

}  // namespace dymsum
