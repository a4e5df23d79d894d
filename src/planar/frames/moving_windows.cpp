// Which window a moving sum is in: the one it was in, one that it has left, one that was made ahead.
#include "planar/frames/moving_sum.h"

namespace dymsum::planar {

// Whether there is one that covers the position.
bool MovingSum::enter_window(const Move& move) {
  const std::uint64_t family = move.family;
  if (window_ != nullptr && window_->serves(family, move.at)) return true;
  if (ahead_.ready()) take_window_ahead();
  std::unique_ptr<FrameWindow> next = made_ahead_ != nullptr && made_ahead_->serves(family, move.at)
                                          ? std::move(made_ahead_)
                                          : kept_.take(family, move.at);
  if (next == nullptr) return false;
  set_window(std::move(next), true);
  controller_.returned();
  return true;
}

void MovingSum::set_window(std::unique_ptr<FrameWindow> next, bool keep) {
  if (window_ == nullptr && next == nullptr) return;
  window_changes(next.get());
  if (next != nullptr) too_expensive_ahead_ = false;
  std::swap(window_, next);
  if (keep && next != nullptr && options.kept_window_bytes > 0) kept_.keep(std::move(next), options.kept_window_bytes);
}

void MovingSum::take_window_ahead() {
  made_ahead_ = ahead_.take();
  too_expensive_ahead_ = made_ahead_ == nullptr;
  if (too_expensive_ahead_) controller_.abandoned(step_ahead_);
}

void MovingSum::finish_window_ahead() {
  if (ahead_.busy()) take_window_ahead();
}

void MovingSum::start_ahead(MakeWindow make, double step) {
  step_ahead_ = step;
  ahead_.start(std::move(make));
}

// Behind the window that frames are in, in the direction of the last step.
void MovingSum::make_next_window(const Move& move) {
  if (window_ == nullptr || ahead_.busy() || too_expensive_ahead_ || move.step == 0) return;
  const double end = window_->end(move.step > 0);
  if (kept_.covers(move.family, end) || (made_ahead_ != nullptr && made_ahead_->serves(move.family, end))) return;
  start_ahead(window_from(end, move, controller_.width(move.step, move.widest)), move.step);
}

}  // namespace dymsum::planar
