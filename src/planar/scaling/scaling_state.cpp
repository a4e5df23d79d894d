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

constexpr double kCheapWindow = 4000;  // some milliseconds to build: no window as cheap as that is abandoned

}  // namespace

PlacedPair ScalingSum::State::placed() const {
  return base->placed_on_lattice(base->lattice_at(base->lattice_scale(x_, y_)));
}

bool ScalingSum::State::build_window(const Move&, const WindowController::Choice& reach) {
  const double low = x_.approx * std::exp(-reach.behind), high = x_.approx * std::exp(reach.ahead);
  drop_window();
  const std::uint32_t all = windows.convolution_for(low, high).size();
  const double most = chooses() ? controller_.most_expensive_building() : 0;
  const std::uint64_t most_pairs = most > 0 ? pairs_of_window(std::max(most, kCheapWindow), all) : UINT64_MAX;
  std::unique_ptr<Window> window = windows.frames(low, high, x_.approx, most_pairs);
  if (window->abandoned) return false;
  frames_.reset(new Frames{low, high, windows.convolution(), std::move(window)});
  return true;
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
  next.followed = frames_->known;
  if (next.followed) frames_->loops.follow(in_order, identities_, stays, next.changes);
  return next;
}

std::optional<MovingSum::NextFrame> ScalingSum::State::window_frame(const Move& move, FrameWork& next_work) {
  auto& [low, high, convolution, window, lists, loops, rings, known] = *frames_;
  ExactFrame frame(base, x_);
  const double tau = frame.tau(window->frame().moving);
  NextFrame next;
  if (lists.repair(tau, frame, next_work) && loops.update(tau, frame, !known, next_work)) {
    next = assemble(tau, frame, move.stays);
    known = true;
  } else {
    next_work.degenerate = true;
    next.sum = degenerate_frame(*window, *convolution, frame, options.semantics);
    next_work.loops_traced = next.sum.stats.loops;
    known = false;
    loops.loops().clear();
  }
  next_work.exact_signs += frame.exact_signs;
  if (frame.has_collision()) {
    const auto& counts = frame.collision().counts();
    next_work.collision_tests = std::max<std::uint64_t>(next_work.collision_tests, counts.tests);
    next_work.exact_signs += counts.exact;
  }
  next_work.pieces = window->pieces.size();
  next_work.candidates = window->candidates.size();
  next_work.window_low = low;
  next_work.window_high = high;
  next_work.peak_bytes = window->bytes() + lists.bytes() + loops.bytes();
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
  to.inside = frames_ != nullptr && x_.approx > frames_->low && x_.approx < frames_->high;
  to.stays = x == scale && y == scale_y;
  to.step = std::log(x_.approx / scale.approx());
  to.widest = windows.widest(x_.approx);
  to.asked = std::log1p(options.window);
  Result<FrameChanges> changes = move(to);
  if (!changes) return changes;
  scale = x;
  scale_y = y;
  return changes;
}

}  // namespace dymsum
