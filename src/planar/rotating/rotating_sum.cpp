#include "dymsum/rotating_sum.h"

#include "planar/rotating/rotating_state.h"

namespace dymsum {

RotatingSum::RotatingSum(std::unique_ptr<State> state) : state_(std::move(state)) {}
RotatingSum::RotatingSum(RotatingSum&&) noexcept = default;
RotatingSum& RotatingSum::operator=(RotatingSum&&) noexcept = default;
RotatingSum::~RotatingSum() = default;

Result<RotatingSum> RotatingSum::create(const Region& p, const Region& q, const MovingOptions& options) {
  Result<std::unique_ptr<State>> state = State::create(p, q, options);
  if (!state) return state.error();
  (*state)->options.mode = FrameMode::rebuild;
  Result<FrameChanges> first = (*state)->move_to(Orientation());
  if (!first) return first.error();
  (*state)->options.mode = options.mode;
  return RotatingSum(std::move(state).value());
}

Result<FrameChanges> RotatingSum::set(const Orientation& theta) { return state_->move_to(theta); }
const Orientation& RotatingSum::orientation() const { return state_->orientation; }
const PlanarSum& RotatingSum::sum() const { return state_->sum; }
std::vector<std::uint64_t> RotatingSum::ring_ids() const { return state_->ring_ids; }
const FrameWork& RotatingSum::work() const { return state_->work; }

}  // namespace dymsum
