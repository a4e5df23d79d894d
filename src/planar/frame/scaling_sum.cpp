#include "planar/frame/scaling_sum.h"

#include <algorithm>
#include <cmath>

#include "dymsum/scaling_sum.h"
#include "planar/convolution/convolution.h"
#include "planar/frame/scaling_events.h"
#include "planar/motion/operand_pair.h"
#include "planar/operand/lattice.h"
#include "planar/position/exact_source.h"
#include "planar/sum/minkowski_sum.h"

namespace dymsum::planar {
namespace {

// The map from the window's coordinates to those of the input.
struct ToInput {
  ToInput(const Window& window, const ExactFrame& frame) : span(window.span()) {
    const Lattice& l = *frame.base().lattice;
    grow = frame.blow_up(window.frame().moving);
    unit = l.unit;
    const double s = frame.value().approx;
    const PlacedPoints& moved = *l.points[frame.base().moved];
    const Point scaled{moved.offset.x * moved.factors.x, moved.offset.y * moved.factors.y};
    const Point& other = l.points[1 - frame.base().moved]->offset;
    origin = Two{scaled.x * s + other.x, scaled.y * s + other.y};
    reach = (std::abs(scaled.x) + std::abs(scaled.y)) * s + std::abs(other.x) + std::abs(other.y);
  }
  Two operator()(const Two& at) const { return both(grow) * at * both(unit) + origin; }
  double error(double of_point) const {
    return grow * (of_point + kKeptPosition * span) * unit * exact::kOutwards + kKeptOffsets * reach +
           exact::kSubnormal;
  }
  double span, grow = 1, unit = 1, reach = 0;
  Two origin{};
};

}  // namespace

// The position at which a ring of the last frame started, or 0.
std::size_t LoopRings::likely_start(const FrameLoop& loop) const {
  const auto led =
      std::find_if(loop.vertices.begin(), loop.vertices.end(), [&](std::uint32_t v) { return leads_[v] != 0; });
  return led == loop.vertices.end() ? 0 : static_cast<std::size_t>(led - loop.vertices.begin());
}

void LoopRings::lead(std::vector<std::uint32_t> leaders) {
  for (const std::uint32_t v : leaders_) leads_[v] = 0;
  for (const std::uint32_t v : leaders) leads_[v] = 1;
  leaders_ = std::move(leaders);
}

KeptRings LoopRings::at(double tau, const Window& window, const ExactFrame& frame, const ExactSource& source,
                        const std::function<SumRing()>& spare) {
  const ToInput to_input(window, frame);
  const double poor = kPoorPosition * window.span();
  const VertexOrder order(source, to_input.error(poor));
  const SumVertex* const vertices = loops_.vertices().data();
  const MovingPoint* const points = loops_.points().data();
  // Returns the bound on what it puts. By value: what it writes cannot be any of these.
  const auto put = [=, &source](std::uint32_t vertex, SumVertex& to) {
    to = vertices[vertex];
    const MovingPoint& v = points[vertex];
    if (v.error <= poor) {
      const Two at = to_input(v.at(tau));
      to.at = {at[0], at[1]};
      return v.error;
    }
    const ExactSource::Position p = source.position(to);
    to.at = {exact::round_to_double(p.x), exact::round_to_double(p.y)};
    return poor;
  };
  double error = 0;
  std::vector<std::uint32_t> leaders;
  leads_.resize(loops_.vertices().size(), 0);
  KeptRings kept;
  for (FrameLoop& loop : loops_.loops()) {
    if (!loop.kept) continue;
    if (loop.vertices.empty())
      for (const LoopStep& step : loop.steps)
        if (step.vertex != kNone) loop.vertices.push_back(step.vertex);
    SumRing ring = spare();
    const WrittenRing written = write_ring(loop.vertices, likely_start(loop), order, put, ring);
    leaders.push_back(written.leader);
    error = std::max(error, written.error);
    kept.rings.push_back(std::move(ring));
    kept.outer.push_back(loop.turning > 0);
    kept.loops.push_back(&loop);
  }
  lead(std::move(leaders));
  kept.at_error = to_input.error(error);
  return kept;
}

namespace {

std::vector<std::array<std::uint32_t, 2>> pairs_at(const Window& window, double tau) {
  std::vector<std::array<std::uint32_t, 2>> pairs = window.folds;
  pairs.insert(pairs.end(), window.touching.begin(), window.touching.end());
  for (const Candidate& c : window.candidates)
    if (!(tau <= c.out_low || tau >= c.out_high))
      pairs.push_back({window.pieces[c.a].segment, window.pieces[c.b].segment});
  for (auto& pair : pairs)
    if (pair[0] > pair[1]) std::swap(pair[0], pair[1]);
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace

std::unique_ptr<WindowFrames> window_frames(const WindowPlan& plan) {
  auto window = std::make_unique<Window>(*plan.base, *plan.convolution, plan.settings);
  if (window->abandoned) return nullptr;
  return std::make_unique<WindowFrames>(plan.family, plan.base, plan.low, plan.high, plan.convolution,
                                        std::move(window));
}

PlanarSum degenerate_frame(const Window& window, const ReducedConvolution& convolution, ExactFrame& frame,
                           Semantics semantics) {
  const double tau = frame.tau(window.frame().moving);
  BoundaryCandidates candidates{convolution, {}, window.live, pairs_at(window, tau), {}, frame.base().connected};
  for (const LiveSegment& s : window.segments) candidates.segments.push_back(s.walk);
  for (const Piece& p : window.pieces) {
    const double length = window.segments[p.segment].length(tau);
    if (p.head_cut) candidates.covered.push_back({p.segment, p.head.at(tau) / length});
    if (p.tail_cut) candidates.covered.push_back({p.segment, p.tail.at(tau) / length});
  }
  // A live segment without pieces is covered as a whole.
  for (std::uint32_t s = 0; s < window.segments.size(); ++s)
    if (window.segments[s].first_piece == window.segments[s].last_piece) candidates.covered.push_back({s, 0.5});
  CandidateSum found = sum_of_candidates(frame.placed(), candidates, frame.collision(), semantics);
  frame.exact_signs += found.exact_signs;
  return std::move(found.sum);
}

}  // namespace dymsum::planar

namespace dymsum {

ScalingSum::ScalingSum(std::unique_ptr<State> state) : state_(std::move(state)) {}
ScalingSum::ScalingSum(ScalingSum&&) noexcept = default;
ScalingSum& ScalingSum::operator=(ScalingSum&&) noexcept = default;
ScalingSum::~ScalingSum() = default;

Result<ScalingSum> ScalingSum::create(const Region& p, const Region& q, const MovingOptions& options) {
  Result<std::shared_ptr<const planar::OperandPair>> base = planar::pair_of_regions(p, q, options);
  if (!base) return base.error();
  auto state = std::make_unique<State>(std::move(base).value(), options);
  const Result<FrameChanges> first = state->begin([&] { return state->move_to(Scale(), Scale()); });
  if (!first) return first.error();
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

using namespace planar;

namespace {

constexpr double kWidestStep = 0.16, kBeyondBack = 0x1p-30;  // longer steps are not reached back over; beyond the end
// A window made ahead begins so much of its width before the last one ends, where it is entered.
constexpr double kShared = 0x1p-10;
// No window reaches beyond these: scales do not.
constexpr double kLowest = 0x1p-65, kHighest = 0x1p65;
// Exact signs for each piece of a window, from which where so much touches a frame from scratch is cheaper: its twins
// count once, and a mask proves most of what touches covered.
constexpr double kMostTouching = 1;
constexpr std::size_t kMostKnown = 32;  // scales at which something touches, the last ones
constexpr double kCheapWindow = 4000;   // some milliseconds to build: no window as cheap as that is abandoned

// What frames cost by what they looked at, fitted to frames of the pairs of `./run bench scaling`. Of one from scratch,
// or of the part of a degenerate one that goes through the static engine's arrangement:
double cost_of_sum(const PlanarSum& sum) {
  const SumStats& s = sum.stats;
  const double mask = 0.015 * s.mask_grid * s.mask_grid;
  return 2 + mask + cost_of(0.005, s.reduced_segments) + cost_of(0.31, s.crossings) + cost_of(0.08, s.exact_signs) +
         cost_of(0.08, sum.vertex_count()) + cost_of(2, s.collision_tests);
}

constexpr double kWindow = 45, kSegment = 0.06, kPairOfBoxes = 0.07, kPiece = 0.5;

// A window, without its first frame. `all`: segments of the convolution.
double cost_of_window(const Window& window, std::uint32_t all) {
  return kWindow + cost_of(kSegment, all) + cost_of(kPairOfBoxes, window.pair_tests) +
         cost_of(kPiece, window.pieces.size());
}

// How many boxes of pieces may meet in one that costs no more.
std::uint64_t pairs_of_window(double cost, std::uint32_t all) {
  return static_cast<std::uint64_t>(std::max(0.0, cost - kWindow - cost_of(kSegment, all)) / kPairOfBoxes);
}

double cost_of_frame(const FrameWork& work, const PlanarSum& sum) {
  const double repaired =
      cost_of(0.004, work.pieces) + cost_of(0.24, work.lists_changed) + cost_of(0.075, work.crossings_changed);
  return 0.5 + repaired + cost_of(0.01, sum.vertex_count()) + cost_of(8, work.collision_tests) +
         cost_of(0.06, work.exact_signs) + (work.degenerate ? cost_of_sum(sum) : 0);
}

}  // namespace

PlacedPair ScalingSum::State::placed(const Move& move) const {
  return base->placed(base->lattice_scale(scaling(move).x, scaling(move).y));
}

// The window has lists and loops at `entry` where it is made ahead, so that the frame that enters it is like any other.
MakeWindow ScalingSum::State::maker(const ScaleMove& move, double low, double high, double entry) {
  const std::uint32_t all = move.builder->convolution_for(low, high).size();
  const double most = chooses() ? controller_.most_expensive_building() : 0;
  const std::uint64_t pairs = most > 0 ? pairs_of_window(std::max(most, kCheapWindow), all) : UINT64_MAX;
  const bool ahead = makes_ahead();
  return [plan = move.builder->plan(low, high, entry, pairs), entry,
          ahead](const base::StopToken& stop) -> std::unique_ptr<FrameWindow> {
    WindowPlan stoppable = plan;
    stoppable.settings.stop = stop;
    std::unique_ptr<WindowFrames> frames = window_frames(stoppable);
    if (frames == nullptr || !ahead) return frames;
    ExactFrame frame(plan.base, scale_value(exact::exact_value(entry)));
    FrameWork work;
    frames->follow(frame, work);
    return frames;
  };
}

// It reaches back to the old position, for who comes back and for steps that go to and fro; but not to one where much
// touched, as where an operand is summed with itself at s = 1.
MakeWindow ScalingSum::State::window_for(const Move& move, const WindowController::Choice& reach) {
  const double back = sum.stats.degenerate_nodes > 0 ? 0 : std::min(std::abs(move.step), kWidestStep);
  const double behind = move.step > 0 ? std::max(reach.behind, back + kBeyondBack) : reach.behind,
               ahead = move.step < 0 ? std::max(reach.ahead, back + kBeyondBack) : reach.ahead;
  return maker(scaling(move), std::max(move.at * std::exp(-behind), kLowest),
               std::min(move.at * std::exp(ahead), kHighest), move.at);
}

MakeWindow ScalingSum::State::window_from(double end, const Move& move, double width) {
  const double sign = move.step > 0 ? 1 : -1, before = end * std::exp(-sign * kShared * width),
               behind = end * std::exp(sign * width);
  return maker(scaling(move), std::min(before, behind), std::max(before, behind), end);
}

// The kept loops at tau: rings in canonical order.
MovingSum::NextFrame ScalingSum::State::assemble(const ScaleMove& move, double tau, ExactFrame& frame) {
  NextFrame next;
  const auto source = std::make_shared<FrameSource>(move.swept, frame.at());
  exact_source(next.sum) = source;
  next.sum.stats.tier_bits = frame.has_lattice() ? frame.lattice().tier_bits : move.swept->lattice->tier_bits;
  next.sum.stats.reduced_segments = frames().convolution->size();
  next.sum.stats.live_segments = frames().window->segments.size();
  KeptRings kept = frames().rings.at(tau, *frames().window, frame, *source, [this] { return spare_ring(); });
  position(kept, next);
  next.followed = last_ == window();
  if (next.followed) frames().loops.follow(kept.loops, identities_, move.stays, next.changes);
  return next;
}

std::optional<MovingSum::NextFrame> ScalingSum::State::window_frame(const Move& move, FrameWork& next_work) {
  ExactFrame frame(scaling(move).swept, scaling(move).s);
  const Window& window = *frames().window;
  NextFrame next;
  if (frames().follow(frame, next_work)) {
    next = assemble(scaling(move), frame.tau(window.frame().moving), frame);
    last_ = &frames();
  } else {
    next_work.degenerate = true;
    last_ = nullptr;
    if (chooses() &&
        static_cast<double>(frame.exact_signs) > kMostTouching * static_cast<double>(window.pieces.size())) {
      next_work.exact_signs += frame.exact_signs;
      return std::nullopt;
    }
    next.sum = degenerate_frame(window, *frames().convolution, frame, options.semantics);
    next_work.loops_traced = next.sum.stats.loops;
  }
  next_work.exact_signs += frame.all_signs();
  if (frame.has_collision())
    next_work.collision_tests = std::max<std::uint64_t>(next_work.collision_tests, frame.collision().counts().tests);
  next_work.pieces = window.pieces.size();
  next_work.candidates = window.candidates.size();
  next_work.window_low = frames().low;
  next_work.window_high = frames().high;
  next_work.peak_bytes = frames().bytes();
  return next;
}

double ScalingSum::State::cost_of(const FrameWork& done) {
  return done.rebuilt ? cost_of_sum(sum) : cost_of_frame(done, sum);
}

double ScalingSum::State::cost_of_window() const {
  return dymsum::cost_of_window(*frames().window, frames().convolution->size());
}

// A motion that comes back there builds no window for it: a window has all that touches at this one scale among its
// pairs, and serves no frame there.
void ScalingSum::State::remember_touching(const Scale& x, const Scale& y) {
  const std::array<Scale, 2> at{x, y};
  if (std::find(touching_.begin(), touching_.end(), at) != touching_.end()) return;
  if (touching_.size() == kMostKnown) touching_.erase(touching_.begin());
  touching_.push_back(at);
}

RatioSweep* ScalingSum::State::ratio_sweep(const Factors& factors, bool make) {
  RatioSweep* const known = ratios_.find(factors);
  return known != nullptr || !make ? known : ratios_.make(*base, factors);
}

// Windows of one ratio are those of the uniform scales of the stretched operand. They are built from the second step of
// one ratio on, and entered again whatever was in between.
ScalingSum::State::ScaleMove ScalingSum::State::move_of(const Scale& x, const Scale& y) {
  ScaleMove to;
  to.x = scale_value(x);
  to.y = x == y ? to.x : scale_value(y);
  const Factors factors = factors_of(to.x, to.y);
  to.s = factors.x == ScaleValue{} ? to.x : to.y;
  to.stays = x == scale && y == scale_y;
  to.at = to.s.approx;
  to.builds = factors == factors_;
  to.step = to.builds ? std::log(to.s.approx / std::max(scale.approx(), scale_y.approx())) : 0;
  to.requested = std::log1p(options.window);
  const bool empty = base->operands[0].size() == 0 || base->operands[1].size() == 0;
  to.windows = options.mode != FrameMode::rebuild && base->regular && !empty;
  to.builder = &windows;
  to.swept = base;
  if (to.windows && !factors.uniform()) {
    RatioSweep* const sweep = ratio_sweep(factors, to.builds);
    to.windows = sweep != nullptr;
    if (sweep != nullptr) {
      to.family = sweep->family;
      to.builder = &sweep->windows;
      to.swept = sweep->base;
    }
  }
  const std::array<Scale, 2> at{x, y};
  to.windows &= !(chooses() && std::find(touching_.begin(), touching_.end(), at) != touching_.end());
  to.widest = to.builder->widest(to.s.approx);
  return to;
}

Result<FrameChanges> ScalingSum::State::move_to(const Scale& x, const Scale& y) {
  if (x == scale && y == scale_y && exact_source(sum) != nullptr) {
    work = {};
    return FrameChanges{};
  }
  const ScaleMove to = move_of(x, y);
  Result<FrameChanges> changes = move(to);
  if (!changes) return changes;
  if (work.rebuilt && sum.stats.degenerate_nodes > 0) remember_touching(x, y);
  scale = x;
  scale_y = y;
  factors_ = factors_of(to.x, to.y);
  return changes;
}

}  // namespace dymsum
