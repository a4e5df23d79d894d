#include "planar/scaling/scaling_state.h"

#include <algorithm>
#include <cmath>

#include "planar/convolution/convolution.h"
#include "planar/scaling/degenerate_frame.h"
#include "planar/scaling/frame_cost.h"
#include "planar/scaling/scaled_source.h"

namespace dymsum {

using namespace planar;

namespace {

constexpr double kWidestStep = 0.16, kBeyond = 0x1p-30;  // longer steps are not reached back over; beyond the end
constexpr double kCheapWindow = 4000;  // some milliseconds to build: no window as cheap as that is abandoned

}  // namespace

PlacedPair ScalingSum::State::placed() const {
  return base->placed_on_lattice(base->lattice_at(base->lattice_scale(x_, y_)));
}

WindowPlan ScalingSum::State::plan(double low, double high, double at) {
  const std::uint32_t all = windows.convolution_for(low, high).size();
  const double most = chooses() ? controller_.most_expensive_building() : 0;
  return windows.plan(low, high, at, most > 0 ? pairs_of_window(std::max(most, kCheapWindow), all) : UINT64_MAX);
}

// It reaches back to the old position, for who comes back and for steps that go to and fro; but not to one where much
// touched, as where an operand is summed with itself at s = 1.
WindowPlan ScalingSum::State::plan_from(const Move& move, const WindowController::Choice& reach) {
  const double at = x_.approx, back = sum.stats.degenerate_nodes > 0 ? 0 : std::min(std::abs(move.step), kWidestStep);
  const double behind = move.step > 0 ? std::max(reach.behind, back + kBeyond) : reach.behind,
               ahead = move.step < 0 ? std::max(reach.ahead, back + kBeyond) : reach.ahead;
  return plan(at * std::exp(-behind), at * std::exp(ahead), at);
}

bool ScalingSum::State::build_window(const Move& move, const WindowController::Choice& reach) {
  leave_window();
  frames_ = window_frames(*base, plan_from(move, reach));
  return frames_ != nullptr;
}

// The kept loops at tau: rings in canonical order.
MovingSum::NextFrame ScalingSum::State::assemble(double tau, ExactFrame& frame, bool stays) {
  NextFrame next;
  const auto source = std::make_shared<ScaledSource>(base, frame.scale());
  exact_source(next.sum) = source;
  next.sum.stats.tier_bits = frame.has_lattice() ? frame.lattice().tier_bits : base->lattice->tier_bits;
  next.sum.stats.reduced_segments = frames_->convolution->size();
  next.sum.stats.live_segments = frames_->window->segments.size();
  LoopRings::Rings kept = frames_->rings.at(tau, *frames_->window, frame, *source, [this] { return spare_ring(); });
  next.sum.at_error = kept.at_error;
  std::vector<FrameLoop*> in_order;
  for (const std::size_t i : place_rings(std::move(kept.rings), kept.outer, next.sum)) {
    in_order.push_back(kept.loops[i]);
    next.identities.push_back(&kept.loops[i]->ring);
  }
  next.followed = last_ == frames_.get();
  if (next.followed) frames_->loops.follow(in_order, identities_, stays, next.changes);
  return next;
}

std::optional<MovingSum::NextFrame> ScalingSum::State::window_frame(const Move& move, FrameWork& next_work) {
  ExactFrame frame(base, x_);
  const Window& window = *frames_->window;
  NextFrame next;
  if (frames_->follow(frame, next_work)) {
    next = assemble(frame.tau(window.frame().moving), frame, move.stays);
    last_ = frames_.get();
  } else {
    next_work.degenerate = true;
    next.sum = degenerate_frame(window, *frames_->convolution, frame, options.semantics);
    next_work.loops_traced = next.sum.stats.loops;
    last_ = nullptr;
  }
  next_work.exact_signs += frame.exact_signs;
  if (frame.has_collision()) {
    const auto& counts = frame.collision().counts();
    next_work.collision_tests = std::max<std::uint64_t>(next_work.collision_tests, counts.tests);
    next_work.exact_signs += counts.exact;
  }
  next_work.pieces = window.pieces.size();
  next_work.candidates = window.candidates.size();
  next_work.window_low = frames_->low;
  next_work.window_high = frames_->high;
  next_work.peak_bytes = frames_->bytes();
  return next;
}

double ScalingSum::State::cost_of(const FrameWork& done) {
  return done.rebuilt ? cost_of_sum(sum) : cost_of_frame(done, sum);
}

MovingSum::WindowCost ScalingSum::State::cost_of_window() const {
  return {planar::cost_of_window(*frames_->window, frames_->convolution->size()), 0};
}

Result<FrameChanges> ScalingSum::State::move_to(const Scale& x, const Scale& y) {
  if (x == scale && y == scale_y && exact_source(sum) != nullptr) {
    work = {};
    return FrameChanges{};
  }
  x_ = scale_value(x);
  y_ = x == y ? x_ : scale_value(y);
  const bool empty = base->operands[0].size() == 0 || base->operands[1].size() == 0;
  Move to;
  to.windows = x == y && scale == scale_y && base->regular && !empty;
  to.stays = x == scale && y == scale_y;
  to.step = std::log(x_.approx / scale.approx());
  to.widest = windows.widest(x_.approx);
  to.asked = std::log1p(options.window);
  if (to.windows && options.mode != FrameMode::rebuild) enter_window();
  to.inside = frames_ != nullptr && frames_->covers(x_.approx);
  Result<FrameChanges> changes = move(to);
  if (!changes) return changes;
  if (work.rebuilt) last_ = nullptr;
  if (to.windows && makes_ahead()) make_next_window(to.step, to.widest);
  scale = x;
  scale_y = y;
  return changes;
}

}  // namespace dymsum
