#include "planar/frame/moving_sum.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "base/memory_budget.h"
#include "base/poll.h"
#include "planar/sum/minkowski_sum.h"

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

namespace {

// A window for which memory does not suffice is none, as one that would cost too much.
std::unique_ptr<FrameWindow> made(const MakeWindow& make) {
  try {
    return make({});
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}

// Kept windows leave room for those that frames are in.
MovingOptions within_limit(MovingOptions options) {
  if (options.memory != 0) options.kept_window_bytes = std::min(options.kept_window_bytes, options.memory / 4);
  return options;
}

}  // namespace

MovingSum::MovingSum(MovingOptions given)
    : options(within_limit(std::move(given))), budget_(base::budget_of(options.memory)) {}

Result<FrameChanges> MovingSum::move(const Move& to) {
  return base::within_memory(budget_, "the sum in motion", [&] { return frame_at(to); });
}

Result<FrameChanges> MovingSum::frame_at(const Move& move) {
  const Stopwatch watch;
  FrameWork next_work;
  const Result<bool> in_window = open_window(move, next_work);
  if (!in_window) return in_window.error();
  std::optional<NextFrame> next;
  if (*in_window) next = window_frame(move, next_work);
  if (!next) {
    Result<NextFrame> rebuilt = rebuilt_frame(move, next_work);
    if (!rebuilt) return rebuilt.error();
    if (!*in_window) set_window(nullptr, true);
    next = std::move(rebuilt).value();
  }
  FrameChanges changes = take(*std::move(next), move);
  next_work.ms = watch.ms();
  charge(next_work);
  work = next_work;
  if (move.windows && makes_ahead()) make_next_window(move);
  return changes;
}

// Whether the current window, perhaps a new one, covers the new position.
Result<bool> MovingSum::open_window(const Move& move, FrameWork& next_work) {
  if (!move.windows || options.mode == FrameMode::rebuild) return false;
  if (enter_window(move)) return true;
  if (!move.builds || (makes_ahead() && ahead_.busy())) return false;
  const WindowController::Choice reach = controller_.choose(move.step, move.widest, options.mode, move.requested);
  if (!reach.window) return false;
  if (options.progress && !options.progress("window", 0)) return cancelled();
  MakeWindow make = window_for(move, reach);
  if (makes_ahead()) {
    start_ahead(std::move(make), move.step);
    return false;
  }
  std::unique_ptr<FrameWindow> next = made(make);
  next_work.new_window = next != nullptr;
  if (next_work.new_window) set_window(std::move(next), true);
  else controller_.abandoned(move.step);
  return next_work.new_window;
}

Result<MovingSum::NextFrame> MovingSum::rebuilt_frame(const Move& move, FrameWork& next_work) const {
  next_work.rebuilt = true;
  SumOptions sum_options;
  sum_options.semantics = options.semantics;
  sum_options.progress = options.progress;
  Result<PlanarSum> computed = placed_sum(placed(move), sum_options);
  if (!computed) return computed.error();
  NextFrame next;
  next.sum = std::move(computed).value();
  next_work.exact_signs = next.sum.stats.exact_signs;
  next_work.collision_tests = next.sum.stats.collision_tests;
  next_work.loops_traced = next.sum.stats.loops;
  return next;
}

void MovingSum::position(KeptRings& kept, NextFrame& next) {
  next.sum.at_error = kept.at_error;
  std::vector<LoopStatus*> in_order;
  for (const std::size_t i : place_rings(std::move(kept.rings), kept.outer, next.sum))
    in_order.push_back(kept.loops[i]);
  for (LoopStatus* loop : in_order) next.identities.push_back(&loop->ring);
  kept.loops = std::move(in_order);
}

FrameChanges MovingSum::take(NextFrame next, const Move& move) {
  std::vector<std::uint64_t> ids;
  if (next.followed) {
    for (const std::uint64_t* id : next.identities) ids.push_back(*id);
  } else {
    ids = identities_.match(sum, ring_ids, next.sum, move.stays, next.changes);
    for (std::size_t i = 0; i < next.identities.size(); ++i) *next.identities[i] = ids[i];
  }
  finish_changes(sum, next.sum, next.changes);
  spare_rings_.clear();
  if (!next.identities.empty()) {
    for (SumPart& part : sum.parts) {
      spare_rings_.push_back(std::move(part.outer));
      for (SumRing& hole : part.holes) spare_rings_.push_back(std::move(hole));
    }
    std::reverse(spare_rings_.begin(), spare_rings_.end());
  }
  sum = std::move(next.sum);
  ring_ids = std::move(ids);
  return std::move(next.changes);
}

SumRing MovingSum::spare_ring() {
  if (spare_rings_.empty()) return {};
  SumRing ring = std::move(spare_rings_.back());
  spare_rings_.pop_back();
  return ring;
}

void MovingSum::charge(const FrameWork& done) {
  const double cost = cost_of(done);
  if (done.new_window) {
    controller_.built(cost + cost_of_window());
  } else if (window_ == nullptr) {
    controller_.rebuilt(cost);
  } else {
    controller_.updated(cost);
    if (chooses() && controller_.give_up(cost)) set_window(nullptr, false);
  }
}

// The window is the one that the last frame was in, one that it has left, or one that was made ahead. Whether there is
// one that covers the position.
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
