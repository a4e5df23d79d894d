// Which window a scaling sum is in: the one it is in, one that it has left, one that was made ahead.
#include <algorithm>
#include <cmath>

#include "planar/scaling/scaling_state.h"

namespace dymsum {

using namespace planar;

namespace {

// A window made ahead begins so much of its width before the last one ends, where it is entered.
constexpr double kShared = 0x1p-10;

}  // namespace

void ScalingSum::State::leave_window() {
  last_ = nullptr;
  if (frames_ != nullptr && options.kept_window_bytes > 0) kept_.keep(std::move(frames_), options.kept_window_bytes);
  frames_.reset();
}

// The window that covers the new position, if there is one.
void ScalingSum::State::enter_window() {
  const double s = x_.approx;
  if (frames_ != nullptr && frames_->covers(s)) return;
  if (ahead_.ready()) take_window_ahead();
  std::unique_ptr<WindowFrames> next =
      made_ahead_ != nullptr && made_ahead_->covers(s) ? std::move(made_ahead_) : kept_.take(s);
  if (next == nullptr) return;
  leave_window();
  frames_ = std::move(next);
  too_expensive_ahead_ = false;
  controller_.returned();
}

void ScalingSum::State::take_window_ahead() {
  made_ahead_ = ahead_.take();
  too_expensive_ahead_ = made_ahead_ == nullptr;
  if (too_expensive_ahead_) controller_.abandoned(step_ahead_);
}

void ScalingSum::State::finish_window_ahead() {
  if (ahead_.busy()) take_window_ahead();
}

bool ScalingSum::State::awaits_window(const Move&) const { return makes_ahead() && ahead_.busy(); }

bool ScalingSum::State::build_elsewhere(const Move& move, const WindowController::Choice& reach) {
  if (!makes_ahead()) return false;
  start_ahead(plan_from(move, reach), x_.approx, move.step);
  return true;
}

void ScalingSum::State::start_ahead(WindowPlan plan, double entry, double step) {
  step_ahead_ = step;
  ahead_.start(std::move(plan), base, exact::exact_value(entry));
}

// Behind the window that frames are in, in the direction of the last step.
void ScalingSum::State::make_next_window(double step, double widest) {
  if (frames_ == nullptr || ahead_.busy() || too_expensive_ahead_ || step == 0) return;
  const double end = step > 0 ? frames_->high : frames_->low, width = controller_.width(step, widest);
  const double sign = step > 0 ? 1 : -1, before = end * std::exp(-sign * kShared * width),
               behind = end * std::exp(sign * width);
  if (kept_.covers(end) || (made_ahead_ != nullptr && made_ahead_->covers(end))) return;
  start_ahead(plan(std::min(before, behind), std::max(before, behind), end), end, step);
}

}  // namespace dymsum
