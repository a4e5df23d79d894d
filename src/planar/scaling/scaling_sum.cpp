#include "dymsum/scaling_sum.h"

#include "planar/operand/prepared_region.h"
#include "planar/scaling/scaling_state.h"

namespace dymsum {

using planar::OperandPair;
using planar::prepared_operand;

ScalingSum::ScalingSum(std::unique_ptr<State> state) : state_(std::move(state)) {}
ScalingSum::ScalingSum(ScalingSum&&) noexcept = default;
ScalingSum& ScalingSum::operator=(ScalingSum&&) noexcept = default;
ScalingSum::~ScalingSum() = default;

Result<ScalingSum> ScalingSum::create(const Region& p, const Region& q, const MovingOptions& options) {
  Result<std::shared_ptr<const OperandPair>> base =
      OperandPair::create({prepared_operand(p, 0), prepared_operand(q, 1, options.reflect_q)}, {},
                          options.moving == MovingOperand::p ? 0 : 1, planar::SumInternals::min_tier_bits(options));
  if (!base) return base.error();
  auto state = std::make_unique<State>(std::move(base).value(), options);
  const FrameMode mode = state->options.mode;
  state->options.mode = FrameMode::rebuild;
  Result<FrameChanges> first = state->move_to(Scale(), Scale());
  if (!first) return first.error();
  state->options.mode = mode;
  return ScalingSum(std::move(state));
}

Result<FrameChanges> ScalingSum::set(double s) {
  const Result<Scale> scale = Scale::of(s);
  if (!scale) return scale.error();
  return set(*scale);
}
Result<FrameChanges> ScalingSum::set(const Scale& s) { return state_->move_to(s, s); }
Result<FrameChanges> ScalingSum::set(const Scale& sx, const Scale& sy) { return state_->move_to(sx, sy); }

const Scale& ScalingSum::scale() const { return state_->scale; }
const PlanarSum& ScalingSum::sum() const { return state_->sum; }
std::vector<std::uint64_t> ScalingSum::ring_ids() const { return state_->ring_ids; }
const FrameWork& ScalingSum::work() const { return state_->work; }
std::uint64_t ScalingSum::combinatorial_hash() const {
  planar::LineHashes known;
  return state_->hash(known);
}

}  // namespace dymsum
