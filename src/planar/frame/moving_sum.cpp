#include "planar/frame/moving_sum.h"

#include <algorithm>
#include <new>
#include <utility>

#include "base/poll.h"
#include "base/stopwatch.h"
#include "base/within_memory.h"
#include "planar/sum/placed_sum.h"

namespace dymsum::planar {

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
