#include "planar/frame/controller.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dymsum::planar {
namespace {

constexpr double kWidest = 1.0;  // a window covers at most so much ahead
constexpr double kFrames = 2;    // and at least this many steps
constexpr double kSteps = kFrames + 0.5,
                 kWidestSteps = 2.5;  // where those are so much wider than windows should be, none is tried
constexpr double kMostFrames = 160;
constexpr double kLargestStep = 0.16;                  // beyond it no window has been seen to pay
constexpr double kShortStep = 0.02, kScattered = 0.3;  // a first step that is longer counts as one of so much
// A longer step belongs to a motion where it is like the one before, or leads back: scattered positions do neither.
constexpr double kAlike = 1.1, kBack = 1.001;
constexpr double kNarrowest = 1e-6;  // any width is right
constexpr double kTooExpensive =
    1.15;  // windows are left above so much of a frame from scratch: most of their frames are far cheaper
constexpr double kMostOfWindow = 12, kMostOfFrame = 2;  // times a frame from scratch
constexpr double kMostOfBuilding = 8;  // times a frame from scratch: no window that costs more has been seen to pay
constexpr std::uint64_t kLongestRest = 256;
constexpr double kHysteresis = 0.05;  // relative gain below which the width stays

}  // namespace

void WindowController::close_window() {
  if (served_ == 0) return;
  const double cost = spent_ / static_cast<double>(served_);
  // Climb towards the cheapest width; turn round when it got more expensive by more than frames differ anyway.
  if (last_cost_ > 0 && cost > last_cost_ * (1 + kHysteresis)) factor_ = 1 / factor_;
  if (last_cost_ == 0 || std::abs(cost - last_cost_) > kHysteresis * last_cost_)
    frames_ahead_ = std::clamp(frames_ahead_ * factor_, kFrames, kMostFrames);
  last_cost_ = cost;
  spent_ = 0;
  served_ = 0;
}

void WindowController::rebuilt(double cost) {
  // What is cheaper counts at once, what is more expensive slowly.
  static_cost_ = static_cost_ == 0 || cost < static_cost_ ? cost : 0.9 * static_cost_ + 0.1 * cost;
  if (rest_ > 0) --rest_;
}

bool WindowController::give_up(double cost) {
  if (cost <= static_cost_ || static_cost_ == 0) {
    expensive_ = 0;
    return false;
  }
  if (++expensive_ < 3) return false;
  expensive_ = 0;
  return true;
}

// One frame with many collision tests says little about the next ones.
void WindowController::built(double cost) {
  spent_ = static_cost_ > 0 ? std::min(cost, kMostOfWindow * static_cost_) : cost;
  served_ = 1;
  counts_ = true;
}

void WindowController::abandoned(double step) {
  frames_ahead_ = std::max(kFrames, frames_ahead_ / 2);
  rest(step);
}

// `lost`: so many frames from scratch would have been made in the time that windows took besides.
void WindowController::rest(double step, double lost) {
  const double size = std::abs(step);
  bad_step_ = bad_step_ == 0 ? size : std::min(bad_step_, size);
  rest_ = std::max(backoff_, std::min(kLongestRest, static_cast<std::uint64_t>(payback_ * lost)));
  backoff_ = std::min<std::uint64_t>(2 * backoff_, kLongestRest);
}

double WindowController::most_expensive_building() const { return kMostOfBuilding * static_cost_; }

void WindowController::returned() {
  close_window();
  counts_ = false;
}

void WindowController::updated(double cost) {
  if (!counts_) return;
  spent_ += static_cost_ > 0 ? std::min(cost, kMostOfFrame * static_cost_) : cost;
  ++served_;
}

double WindowController::width(double step, double widest) const {
  const double size = std::abs(step);
  return std::clamp(std::min(frames_ahead_ * size, std::max(widest, kSteps * size)), kNarrowest, kWidest);
}

WindowController::Choice WindowController::choose(double step, double widest, FrameMode mode, double window) {
  const double size = std::abs(step);
  if (mode == FrameMode::rebuild) return {};
  if (window > 0) return {true, 0.1 * window, window};
  if (size == 0 && mode == FrameMode::automatic) return {};  // nobody knows where the motion goes
  // Large steps are remembered for a while: among random jumps a small one is no sweep. Of the first one nobody knows.
  recent_ = recent_ == 0 && size > kShortStep ? std::max(size, kScattered) : std::max(size, 0.8 * recent_);
  const double last = std::exchange(last_step_, step), alike = step * last > 0 ? kAlike : kBack;
  const bool scattered = size > kShortStep && !(size < alike * std::abs(last) && std::abs(last) < alike * size);
  const std::uint64_t served = served_;
  close_window();
  if (mode == FrameMode::automatic) {
    // A window that cost more a frame than computing from scratch: leave it for a while, or until steps get much
    // smaller.
    if (served > 0 && last_cost_ > kTooExpensive * static_cost_) {
      rest(step, static_cast<double>(served) * (last_cost_ / static_cost_ - 1));
    } else if (served > 0) {
      bad_step_ = 0;
      backoff_ = 8;
    }
    if (recent_ > kLargestStep || scattered || kSteps * size > kWidestSteps * widest) return {};
    // Once in a while a window would not clearly win: a fresh frame tells what it would have cost.
    if (served > 0 && last_cost_ > 0.7 * static_cost_ && ++windows_since_ % 4 == 0) return {};
    if (rest_ > 0 && size > 0.5 * bad_step_) return {};
  }
  if (last_cost_ == 0) frames_ahead_ = std::clamp(first_width_ / size, kFrames, frames_ahead_);
  const double ahead = width(step, widest), behind = std::max(0.02 * size, kNarrowest);
  return step >= 0 ? Choice{true, std::min(behind, ahead), ahead} : Choice{true, ahead, std::min(behind, ahead)};
}

}  // namespace dymsum::planar
