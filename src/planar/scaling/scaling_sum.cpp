#include "dymsum/scaling_sum.h"

#include "planar/frames/region_pair.h"
#include "planar/scaling/line_hashes.h"
#include "planar/scaling/scaling_state.h"

namespace dymsum {

ScalingSum::ScalingSum(std::unique_ptr<State> state) : state_(std::move(state)) {}
ScalingSum::ScalingSum(ScalingSum&&) noexcept = default;
ScalingSum& ScalingSum::operator=(ScalingSum&&) noexcept = default;
ScalingSum::~ScalingSum() = default;

Result<ScalingSum> ScalingSum::create(const Region& p, const Region& q, const MovingOptions& options) {
  Result<std::shared_ptr<const planar::OperandPair>> base = planar::pair_of_regions(p, q, options);
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
std::uint64_t ScalingSum::combinatorial_hash() const { return planar::LineHashes(state_->base).of(state_->sum); }

}  // namespace dymsum
