#include "planar/frame/rotating_sum.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "dymsum/rotating_sum.h"
#include "planar/motion/operand_pair.h"
#include "planar/operand/operand.h"
#include "planar/position/exact_source.h"

namespace dymsum::planar {
namespace {

/// Crossings that are known worse than this, times the span, are rounded from their exact positions. Any value is
/// right.
constexpr double kPoor = 0x1p-36;

}  // namespace

void TurnedRings::enter(const RotatingWindow& window) {
  window_ = &window;
  names_.assign(window.segments.size(), {{Contact::Kind::edge_of_p, kNone, kNone}, kNone, kNone});
}

const TurnedRings::Names& TurnedRings::names(std::uint32_t segment) {
  Names& names = names_[segment];
  if (names.contact.p != kNone) return names;
  const RotatingSegment& s = window_->segments[segment];
  const Operand &fixed = forms_.operand(0), &moving = forms_.operand(1);
  names.contact = swapped_ ? contact_of({1 - s.side, s.edge, s.vertex}, moving, fixed) : contact_of(s, fixed, moving);
  names.corner_p = fixed.vertex_index[s.end.p];
  names.corner_q = moving.vertex_index[s.end.q];
  if (swapped_) std::swap(names.corner_p, names.corner_q);
  return names;
}

TurnedRings::Rigid TurnedRings::to_sum(const Orientation& theta) const {
  const Lattice& l = *base_.lattice;
  const Heading world = Heading::of(theta.radians());
  const auto turn = [&](Point p) { return Point{world.c * p.x - world.s * p.y, world.s * p.x + world.c * p.y}; };
  const Point fixed = l.points[0]->offset, moving{l.points[1]->offset.x + l.unit * forms_.centre().x,
                                                  l.points[1]->offset.y + l.unit * forms_.centre().y};
  const Point turned = turn(moving_turns_ ? moving : fixed), still = moving_turns_ ? fixed : moving;
  const Heading by = moving_turns_ ? Heading{} : world;
  return {by.c, by.s, l.unit, {turned.x + still.x, turned.y + still.y}};
}

// Turning back mixes both coordinates. Below the range of ordinary doubles the bound rounds to nothing, and so may at
// most seven products by half a unit each: of the unit, and of the offset that turns.
double TurnedRings::input_error(double error) const {
  const Lattice& l = *base_.lattice;
  double offsets = std::abs(forms_.centre().x) * l.unit + std::abs(forms_.centre().y) * l.unit;
  for (const auto& points : l.points) offsets += std::abs(points->offset.x) + std::abs(points->offset.y);
  return (kMixed * error + kTurnedBack * forms_.span()) * l.unit + kTurnedOffset * offsets + exact::kSubnormal;
}

KeptRings TurnedRings::at(const Orientation& theta, const RotatingFrame& frame, RotatingLoops& loops,
                          const ExactSource& source, const std::function<SumRing()>& spare) {
  const Rigid rigid = to_sum(theta);
  const double poor = kPoor * forms_.span();
  const VertexOrder order(source, input_error(poor));
  std::optional<NearestPoint> nearest;  // made when first requested
  const RotatingFrame::Step* const steps = frame.steps().data();
  KeptRings kept;
  double error = 0;
  for (RotatingLoops::Loop& loop : loops.loops()) {
    if (!loop.kept) continue;
    // Returns the bound on what it puts.
    const auto put = [&](std::uint32_t k, SumVertex& to) {
      const RotatingFrame::Step& s = steps[k];
      const Names& in = names(s.segment);
      const bool end = s.to_crossing == RotatingFrame::kEnd;
      to.in = in.contact;
      to.out = names(steps[k + 1 == loop.last ? loop.first : k + 1].segment).contact;
      to.corner_p = end ? in.corner_p : SumVertex::kNone;
      to.corner_q = end ? in.corner_q : SumVertex::kNone;
      const RotatingFrame::Located z = frame.end_of(s);
      if (z.error <= poor) {
        to.at = rigid(z.at.x, z.at.y);
        return z.error;
      }
      if (!nearest) nearest.emplace(source);
      to.at = (*nearest)(to);
      return frame.point_error();
    };
    corners_.clear();
    for (std::uint32_t k = loop.first; k < loop.last; ++k)
      if (!steps[k].straight) corners_.push_back(k);
    SumRing ring = spare();
    error = std::max(error, write_ring(corners_, 0, order, put, ring).error);
    kept.rings.push_back(std::move(ring));
    kept.outer.push_back(loop.turning > 0);
    kept.loops.push_back(&loop);
  }
  kept.at_error = input_error(error);
  return kept;
}

}  // namespace dymsum::planar

namespace dymsum {
namespace {

// The pair has the smaller operand as operand 1.
Result<std::shared_ptr<const planar::OperandPair>> pair_of_forms(
    const Region& p, const Region& q, const MovingOptions& options,
    const std::shared_ptr<const planar::OperandPair>& base) {
  if (!planar::RotatingState::has_windows(*base) || !planar::RotatingState::p_is_smaller(*base)) return base;
  return planar::OperandPair::create(
      {planar::prepared_operand(q, 0, options.reflect_q), planar::prepared_operand(p, 1)}, {}, 1,
      planar::SumInternals::min_tier_bits(options));
}

}  // namespace

RotatingSum::RotatingSum(std::unique_ptr<State> state) : state_(std::move(state)) {}
RotatingSum::RotatingSum(RotatingSum&&) noexcept = default;
RotatingSum& RotatingSum::operator=(RotatingSum&&) noexcept = default;
RotatingSum::~RotatingSum() = default;

Result<RotatingSum> RotatingSum::create(const Region& p, const Region& q, const MovingOptions& options) {
  const auto base = planar::pair_of_regions(p, q, options);
  if (!base) return base.error();
  const auto forms_base = pair_of_forms(p, q, options, *base);
  if (!forms_base) return forms_base.error();
  auto state = std::make_unique<State>(*base, *forms_base, options);
  const Result<FrameChanges> first = state->begin([&] { return state->move_to(Orientation()); });
  if (!first) return first.error();
  return RotatingSum(std::move(state));
}

Result<FrameChanges> RotatingSum::set(const Orientation& theta) { return state_->move_to(theta); }
const Orientation& RotatingSum::orientation() const { return state_->orientation; }
const PlanarSum& RotatingSum::sum() const { return state_->sum; }
std::vector<std::uint64_t> RotatingSum::ring_ids() const { return state_->ring_ids; }
const FrameWork& RotatingSum::work() const { return state_->work; }

using namespace planar;

namespace {

constexpr double kMaskFrom = 100;    // segments from which a mask pays
constexpr double kCellsSwept = 1.1;  // a cell is so many times as wide as vertices move from the midpoint of a window
constexpr double kCellsPerRoot = 3.5, kMostCells = 256, kLeastCells = 8;
// Pairs that may meet abound beyond a sweep to either side of this fraction of the extent, divided by the root of the
// number of segments.
constexpr double kWidestSweep = 0.3;
// No window is tried for larger steps, as fractions of the widest one: it would sweep too far to pay within a few
// frames.
constexpr double kLargestFraction = 0.4;
// What pairs of boxes may cost before a window is given up, times a frame from scratch.
constexpr double kMostOfPairs = 3;
// Loops that are tested at the start of a window: with more of them it begins at the frame before.
constexpr std::size_t kFewLoops = 8;
// Windows that follow one another overlap by so many radians at least: more than doubles of angles err by.
constexpr double kSharedAngle = 0x1p-40;
// How far a window reaches in the direction of the motion, and in all: less than a radian from its midpoint, which is
// what a window of angles requires.
constexpr double kFarthestAhead = 1.5, kWidestOfAll = 1.98;

// What frames cost by what they looked at, fitted to frames and slices of the pairs of `./run bench cspace` and of
// random shapes. Of one from scratch, of operands with so many vertices together:
double cost_of_slice(const SumStats& s, std::size_t vertices) {
  return 2 + cost_of(0.08, vertices) + cost_of(0.03, s.reduced_segments) + cost_of(0.135, s.crossings) +
         cost_of(0.0025, s.pair_tests) + cost_of(1.5, s.collision_tests);
}

// The cost of two pieces whose boxes meet, when a window is built.
constexpr double kCostOfPair = 0.03;

double cost_of_window(const RotatingWindow& w) {
  return 12 + cost_of(0.011, w.all_segments) + cost_of(0.084, w.pieces.size()) + cost_of(kCostOfPair, w.pair_tests) +
         cost_of(0.0055, w.cells);
}

// `slice`: a frame from scratch.
double cost_of_frame(const FrameWork& work, const PlanarSum& sum, double slice) {
  return 1 + cost_of(0.04, sum.vertex_count()) + cost_of(0.004, work.pieces) + cost_of(0.005, work.candidates) +
         cost_of(0.05, sum.stats.crossings) + (work.exact_signs > 0 ? 0.5 * slice : 0) +
         cost_of(0.05 * slice, work.collision_tests);
}

}  // namespace

RotatingSum::State::State(std::shared_ptr<const OperandPair> base, std::shared_ptr<const OperandPair> forms_base,
                          const MovingOptions& options)
    : MovingSum(options), base_(std::move(base)), swapped_(p_is_smaller(*base_)) {
  if (!has_windows(*base_)) return;
  operands_ = std::make_shared<const TurnedOperands>(std::move(forms_base));
  grids_ = std::make_shared<Grids>();
  operands_->catalog.for_each(0, 0, [&](const WalkSegment&) { ++segments_; });
  loops_ = std::make_unique<RotatingLoops>(forms(), base_->connected, swapped_);
  rings_ = std::make_unique<TurnedRings>(*operands_->pair, forms(), swapped_, swapped_ == p_turns());
}

bool RotatingSum::State::has_windows(const OperandPair& base) {
  return base.regular && base.operands[0].size() > 0 && base.operands[1].size() > 0;
}

bool RotatingSum::State::p_is_smaller(const OperandPair& base) {
  const auto size = [&](int op) { return std::hypot(base.width[op], base.height[op]); };
  return size(0) < size(1) || (size(0) == size(1) && base.moved == 0);
}

PlacedPair RotatingSum::State::placed(const Move& move) const { return base_->placed(theta_of(move)); }

// What is known of the loops goes along.
void RotatingSum::State::window_changes(FrameWindow* next) {
  if (next == nullptr) return loops_->forget();
  const RotatingWindow& entered = static_cast<const TurnedWindow*>(next)->window;
  if (window() != nullptr) loops_->renumber(turned().window, entered);
  else loops_->forget();
  frame_.enter(entered);
  rings_->enter(entered);
}

double RotatingSum::State::extent() const { return std::max(forms().width(), forms().height()) + 2 * forms().reach(); }

double RotatingSum::State::widest_window() const {
  return forms().reach() > 0 ? 2 * kWidestSweep * extent() / (std::sqrt(std::max(segments_, 1.0)) * forms().reach())
                             : 1;
}

int RotatingSum::State::cells_for(double half) const {
  const double most = extent() / (kCellsSwept * half * forms().reach());
  const double cells = std::clamp(std::min(kCellsPerRoot * std::sqrt(segments_), most), kLeastCells, kMostCells);
  // Cells grow in steps of a root of two, so that few grids are made.
  return static_cast<int>(kLeastCells * std::exp2(0.5 * std::floor(2 * std::log2(cells / kLeastCells))));
}

MakeWindow RotatingSum::State::maker(double low, double high) {
  const double half = 0.5 * (high - low), midpoint = std::remainder(0.5 * (low + high), kTurn);
  const int cells = cells_for(half);
  const std::size_t most_pairs =
      chooses() ? static_cast<std::size_t>(kMostOfPairs * slice_cost_ / kCostOfPair) : ~std::size_t{0};
  return [operands = operands_, grids = grids_, cells, midpoint, half, mask = segments_ >= kMaskFrom,
          most_pairs](const base::StopToken& stop) -> std::unique_ptr<FrameWindow> {
    std::unique_ptr<RotationGrid>& grid = (*grids)[cells];
    if (!grid) grid = std::make_unique<RotationGrid>(operands->forms, cells);
    RotatingWindow next(*grid, operands->catalog, midpoint, half, mask, most_pairs, stop);
    if (!next.complete) return nullptr;
    return std::make_unique<TurnedWindow>(operands, std::move(next));
  };
}

// Where many loops would have to be tested the frame before lies inside, so that what is known of it serves.
double RotatingSum::State::reach_back(const Move& move) const {
  return loops_->loops().size() > kFewLoops && std::abs(move.step) < 0.5 ? 1.001 * std::abs(move.step) : 0;
}

// The window leaves nothing out between itself and the one before, for whoever comes back.
MakeWindow RotatingSum::State::window_for(const Move& move, const WindowController::Choice& reach) {
  auto [behind, ahead] = std::pair{reach.behind, reach.ahead};
  if (options.window > 0 && move.step < 0) std::swap(behind, ahead);
  double &towards = move.step >= 0 ? behind : ahead, &away = move.step >= 0 ? ahead : behind;
  away = std::min(away, kFarthestAhead);
  towards = std::max(towards, reach_back(move));
  if (window() != nullptr) {
    const double gap = std::abs(std::remainder(move.at - turned().end(move.step >= 0), kTurn)) + kSharedAngle;
    if (gap <= std::min(std::abs(move.step) + kSharedAngle, behind + ahead)) towards = std::max(towards, gap);
  }
  towards = std::min(towards, kWidestOfAll - away);
  return maker(move.at - behind, move.at + ahead);
}

MakeWindow RotatingSum::State::window_from(double end, const Move& move, double width) {
  const double back = std::max(reach_back(move), kSharedAngle);
  return move.step > 0 ? maker(end - back, end + width) : maker(end - width, end + back);
}

// The kept loops as rings in canonical order.
void RotatingSum::State::assemble(const Orientation& theta, NextFrame& next) {
  const RotatingWindow& window = turned().window;
  const RotatingFrame& frame = frame_;
  PlanarSum& sum = next.sum;
  exact_source(sum) = std::make_shared<FrameSource>(base_, theta);
  sum.stats.tier_bits = base_->lattice->tier_bits;
  sum.stats.reduced_segments = window.all_segments;
  sum.stats.live_segments = window.segments.size();
  sum.stats.crossings = frame.crossings().size();
  sum.stats.loops = loops_->loops().size();
  KeptRings kept = rings_->at(theta, frame, *loops_, *exact_source(sum), [this] { return spare_ring(); });
  position(kept, next);
}

// Nothing where doubles do not decide the frame.
std::optional<MovingSum::NextFrame> RotatingSum::State::window_frame(const Move& move, FrameWork& next_work) {
  const RotatingWindow& window = turned().window;
  const double angle = moving_angle(theta_of(move));
  next_work.pieces = window.pieces.size();
  next_work.candidates = window.candidates.size();
  next_work.window_low = window.midpoint - window.half;
  next_work.window_high = window.midpoint + window.half;
  next_work.peak_bytes = window.bytes() + frame_.bytes() + loops_->bytes() + rings_->bytes();
  NextFrame next;
  next.followed = loops_->known();
  if (frame_.compute(std::remainder(angle - window.midpoint, kTurn), Heading::of(angle))) {
    ExactFrame exact(base_, theta_of(move));
    loops_->update(frame_, exact, identities_, next_work, next.changes);
    assemble(theta_of(move), next);
    next_work.exact_signs += exact.all_signs();
    return next;
  }
  next_work.degenerate = true;
  loops_->forget();
  return std::nullopt;
}

double RotatingSum::State::cost_of(const FrameWork& done) {
  if (!done.rebuilt) return cost_of_frame(done, sum, slice_cost_);
  slice_cost_ = cost_of_slice(sum.stats, base_->operands[0].size() + base_->operands[1].size());
  return slice_cost_;
}

double RotatingSum::State::cost_of_window() const { return dymsum::cost_of_window(turned().window); }

Result<FrameChanges> RotatingSum::State::move_to(const Orientation& theta) {
  if (theta == orientation && exact_source(sum) != nullptr) {
    work = {};
    return FrameChanges{};
  }
  RotationMove to;
  to.theta = theta;
  to.at = moving_angle(theta);
  to.step = std::remainder(to.at - moving_angle(orientation), kTurn);
  to.widest = operands_ != nullptr ? widest_window() : 0;
  to.windows = operands_ != nullptr;
  to.builds = !chooses() || std::abs(to.step) <= kLargestFraction * to.widest;
  to.requested = options.window;
  Result<FrameChanges> changes = move(to);
  if (changes) orientation = theta;
  return changes;
}

}  // namespace dymsum
