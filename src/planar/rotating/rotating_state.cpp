#include "planar/rotating/rotating_state.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "planar/operand/prepared_region.h"

namespace dymsum {

using namespace planar;

namespace {

double now_ms() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// What frames cost by what they looked at, in about microseconds: unlike time it is the same in every run, so that
// every run makes the same choices. Fitted to frames and slices of the pairs of `./run bench cspace` and of random
// shapes.
double cost_of_slice(const SumStats& s) {
  const auto of = [](double each, std::uint64_t n) { return each * static_cast<double>(n); };
  return 12 + of(0.085, s.reduced_segments) + of(0.11, s.crossings) + of(0.5, s.collision_tests);
}

double cost_of_window(const RotatingWindow& w) {
  const auto of = [](double each, std::uint64_t n) { return each * static_cast<double>(n); };
  return 6 + of(0.1, w.all_segments) + of(0.1, w.pieces.size()) + of(0.035, w.pair_tests);
}

double cost_of_frame(const FrameWork& work, const PlanarSum& sum, double slice) {
  const auto of = [](double each, std::uint64_t n) { return each * static_cast<double>(n); };
  return 1 + of(0.008, sum.vertex_count()) + of(0.008, work.pieces) + of(0.009, work.candidates) +
         of(0.025, sum.stats.crossings) + (work.exact_signs > 0 ? 0.5 * slice : 0) +
         of(0.05 * slice, work.collision_tests);
}

// In the choice of a width windows count by half: they are what makes few frames late, wide ones are what makes all
// others slower.
constexpr double kLate = 0.5;
/// Turning (x, y) mixes errors of both coordinates: by |cos| + |sin| <= sqrt(2).
constexpr double kMixed = 1.5;
/// Of the rest of turning a position back, times the span: cos and sin, sqrt(2) 16, and six operations; and of turning
/// the offsets, whose sums carry 2.
constexpr double kTurnedBack = exact::rounding_bound(23 + 9, 128), kTurnedOffset = exact::rounding_bound(23 + 9, 64);
/// Positions that are known worse than this, times the span, make the frame be computed from scratch. Any value is
/// right.
constexpr double kPoor = 0x1p-36;
/// Of two doubles of angles and their difference; a window's ends are left that much early.
constexpr double kAngleGap = exact::rounding_bound(2 * 12 + 4, 512);

constexpr double kMaskFrom = 100;    // segments from which a mask pays
constexpr double kCellsSwept = 1.1;  // a cell is so many times as wide as vertices move from the middle of a window
// Beyond a sweep either way of this share of the extent, divided by the root of the number of segments, pairs that may
// meet abound.
constexpr double kWidest = 1.0 / 7;

int cells_for(double n) { return std::clamp(static_cast<int>(6 * std::sqrt(n)), 8, 256); }

}  // namespace

Result<std::unique_ptr<planar::RotatingState>> RotatingSum::State::create(const Region& p, const Region& q,
                                                                          const RotatingOptions& options) {
  const bool p_turns = options.turning == TurningOperand::p;
  auto base = OperandPair::create({prepared_operand(p, 0), prepared_operand(q, 1, options.reflect_q)}, {},
                                  p_turns ? 0 : 1, planar::SumInternals::min_tier_bits(options));
  if (!base) return base.error();
  auto state = std::make_unique<State>();
  state->options = options;
  state->base_ = *base;
  const OperandPair& b = **base;
  if (!b.regular || b.operands[0].size() == 0 || b.operands[1].size() == 0) return state;
  const auto size = [&](int op) { return std::hypot(b.width[op], b.height[op]); };
  state->swapped_ = size(0) < size(1) || (size(0) == size(1) && p_turns);
  auto forms = state->swapped_
                   ? OperandPair::create({prepared_operand(q, 0, options.reflect_q), prepared_operand(p, 1)}, {}, 1,
                                         planar::SumInternals::min_tier_bits(options))
                   : base;
  if (!forms) return forms.error();
  state->forms_base_ = *forms;
  state->forms_ = std::make_unique<TurningForms>(**forms);
  state->catalog_ = std::make_unique<TurnCatalog>(*state->forms_);
  state->catalog_->for_each(0, 0, [&](const WalkSegment&) { ++state->segments_; });
  state->loops_ = std::make_unique<RotatingLoops>(*state->forms_, b.connected, state->swapped_);
  return state;
}

void RotatingSum::State::drop_window() {
  frame_.reset();
  window_.reset();
  if (loops_) loops_->forget();
}

double RotatingSum::State::widest_window() const {
  const double extent = std::max(forms_->width(), forms_->height()) + 2 * forms_->reach();
  return forms_->reach() > 0 ? 2 * kWidest * extent / (std::sqrt(std::max(segments_, 1.0)) * forms_->reach()) : 1;
}

void RotatingSum::State::build_window(double low, double high) {
  const double half = 0.5 * (high - low), extent = std::max(forms_->width(), forms_->height()) + 2 * forms_->reach();
  const double most = std::min(1024.0, extent / (kCellsSwept * half * forms_->reach()));
  const int cells = std::max(8, std::min(cells_for(segments_), static_cast<int>(most)));
  if (grid_ == nullptr || grid_->cells != cells) grid_ = std::make_unique<TurnGrid>(*forms_, cells);
  auto window = std::make_unique<RotatingWindow>(*grid_, *catalog_, 0.5 * (low + high), half, segments_ >= kMaskFrom);
  if (window_ != nullptr) loops_->renumber(*window_, *window);
  window_ = std::move(window);
  frame_ = std::make_unique<RotatingFrame>(*window_);
  names_.assign(window_->segments.size(), {{Contact::Kind::edge_of_p, kNone, kNone}, kNone, kNone});
}

Result<RotatingSum::State::NextFrame> RotatingSum::State::rebuilt_frame(const Orientation& theta,
                                                                        FrameWork& next_work) {
  next_work.rebuilt = true;
  SumOptions sum_options;
  sum_options.semantics = options.semantics;
  sum_options.progress = options.progress;
  Result<PlanarSum> fresh = sum_at(*base_, theta, sum_options);
  if (!fresh) return fresh.error();
  NextFrame next;
  next.sum = std::move(fresh).value();
  next_work.exact_signs = next.sum.stats.exact_signs;
  next_work.collision_tests = next.sum.stats.collision_tests;
  next_work.loops_traced = next.sum.stats.loops;
  return next;
}

const RotatingSum::State::Names& RotatingSum::State::names(std::uint32_t segment) {
  Names& names = names_[segment];
  if (names.contact.p != kNone) return names;
  const TurnSegment& s = window_->segments[segment];
  const Operand &fixed = forms_->operand(0), &moving = forms_->operand(1), &o = s.walk.side == 0 ? fixed : moving,
                &other = s.walk.side == 0 ? moving : fixed;
  const std::uint32_t edge = o.edge_number[s.walk.edge], at = other.vertex_number[s.walk.vertex];
  const bool of_p = (s.walk.side == 0) != swapped_;
  names.contact = of_p ? Contact{Contact::Kind::edge_of_p, edge, at} : Contact{Contact::Kind::edge_of_q, at, edge};
  names.corner_p = fixed.vertex_number[s.end.p];
  names.corner_q = moving.vertex_number[s.end.q];
  if (swapped_) std::swap(names.corner_p, names.corner_q);
  return names;
}

RotatingSum::State::Rigid RotatingSum::State::to_sum(const Orientation& theta) const {
  const Lattice& l = *forms_base_->lattice;
  const Heading world = Heading::of(theta.radians());
  const auto turn = [&](Point p) { return Point{world.c * p.x - world.s * p.y, world.s * p.x + world.c * p.y}; };
  const Point fixed = l.points[0]->offset, moving{l.points[1]->offset.x + l.unit * forms_->centre().x,
                                                  l.points[1]->offset.y + l.unit * forms_->centre().y};
  const bool moving_turns = swapped_ == p_turns();
  const Point turned = turn(moving_turns ? moving : fixed), still = moving_turns ? fixed : moving;
  const double c = moving_turns ? l.unit : l.unit * world.c, s = moving_turns ? 0 : l.unit * world.s;
  return {c, -s, s, c, {turned.x + still.x, turned.y + still.y}};
}

// The steps of a kept loop that end at vertices and their places, from the leftmost on: doubles mostly know where a
// ring begins. False where a position is known too badly.
bool RotatingSum::State::place_ring(const RotatingLoops::Loop& loop, const Rigid& rigid, double& error) {
  const double poor = kPoor * forms_->span(), point_error = frame_->point_error();
  const RotatingFrame::Step* steps = frame_->steps().data();
  const Rigid to_sum = rigid;
  steps_.resize(loop.vertices);
  places_.resize(loop.vertices);
  std::size_t n = 0, first = 0;
  double leftmost = INFINITY, worst = point_error;
  for (std::uint32_t k = loop.first; k < loop.last; ++k) {
    const RotatingFrame::Step& s = steps[k];
    if (s.straight) continue;
    double x, y;
    if (s.to_crossing == RotatingFrame::kEnd) {
      const Point at = frame_->place(window_->segments[s.segment].end);
      x = at.x;
      y = at.y;
    } else {
      const RotatingFrame::Located z = frame_->end_of(s);
      worst = std::max(worst, z.error);
      x = z.at.x;
      y = z.at.y;
    }
    const double u = to_sum.xx * x + to_sum.xy * y + to_sum.by.x;
    places_[n] = {u, to_sum.yx * x + to_sum.yy * y + to_sum.by.y};
    first = u < leftmost ? n : first;
    leftmost = std::min(u, leftmost);
    steps_[n++] = k;
  }
  error = std::max(error, worst);
  std::rotate(steps_.begin(), steps_.begin() + static_cast<std::ptrdiff_t>(first), steps_.end());
  std::rotate(places_.begin(), places_.begin() + static_cast<std::ptrdiff_t>(first), places_.end());
  return worst <= poor;
}

SumRing RotatingSum::State::ring(const RotatingLoops::Loop& loop) {
  SumRing ring;
  ring.vertices.resize(steps_.size());
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const std::uint32_t k = steps_[i];
    const RotatingFrame::Step &s = frame_->steps()[k], &next = frame_->steps()[k + 1 == loop.last ? loop.first : k + 1];
    const Names& in = names(s.segment);
    SumVertex& v = ring.vertices[i];
    v.at = places_[i];
    v.in = in.contact;
    v.out = names(next.segment).contact;
    if (s.to_crossing != RotatingFrame::kEnd) continue;
    v.corner_p = in.corner_p;
    v.corner_q = in.corner_q;
  }
  return ring;
}

// The kept loops as rings, in input coordinates. False where a position is known too badly.
bool RotatingSum::State::assemble(const Orientation& theta, NextFrame& next) {
  PlanarSum& sum = next.sum;
  exact_source(sum) = std::make_shared<TurnedSource>(base_, theta);
  sum.stats.tier_bits = base_->lattice->tier_bits;
  sum.stats.reduced_segments = window_->all_segments;
  sum.stats.live_segments = window_->segments.size();
  sum.stats.crossings = frame_->crossings().size();
  sum.stats.loops = loops_->loops().size();
  std::vector<SumRing> rings;
  std::vector<std::uint8_t> outer;
  const Rigid rigid = to_sum(theta);
  double error = 0;
  for (const RotatingLoops::Loop& loop : loops_->loops()) {
    if (!loop.kept) continue;
    if (!place_ring(loop, rigid, error)) return false;
    rings.push_back(ring(loop));
    outer.push_back(loop.turning > 0);
  }
  // Turning back mixes both coordinates.
  const Lattice& l = *forms_base_->lattice;
  double offsets = std::abs(forms_->centre().x) * l.unit + std::abs(forms_->centre().y) * l.unit;
  for (const auto& points : l.points) offsets += std::abs(points->offset.x) + std::abs(points->offset.y);
  sum.at_error = (kMixed * error + kTurnedBack * forms_->span()) * l.unit + kTurnedOffset * offsets;
  const VertexOrder order(*exact_source(sum), sum.at_error);
  for (SumRing& ring : rings)
    if (const std::size_t first = smallest_vertex(ring.vertices, order, sum.at_error); first != 0)
      std::rotate(ring.vertices.begin(), ring.vertices.begin() + static_cast<std::ptrdiff_t>(first),
                  ring.vertices.end());
  std::vector<std::uint64_t> kept_ids;
  for (const RotatingLoops::Loop& loop : loops_->loops())
    if (loop.kept) kept_ids.push_back(loop.ring);
  const std::vector<std::size_t> numbers = place_rings(std::move(rings), outer, sum);
  if (!next.followed) {
    next.ids = identities_.match(this->sum, ring_ids, sum, false, next.changes);
    for (std::size_t i = 0; i < numbers.size(); ++i) kept_ids[numbers[i]] = next.ids[i];
    loops_->name(kept_ids);
  } else {
    for (const std::size_t i : numbers) next.ids.push_back(kept_ids[i]);
  }
  return true;
}

std::optional<RotatingSum::State::NextFrame> RotatingSum::State::window_frame(const Orientation& theta,
                                                                              FrameWork& next_work) {
  const double angle = moving_angle(theta);
  next_work.pieces = window_->pieces.size();
  next_work.candidates = window_->meetings.size();
  next_work.window_low = window_->middle - window_->half;
  next_work.window_high = window_->middle + window_->half;
  next_work.peak_bytes = window_->bytes() + loops_->bytes();
  if (!frame_->compute(std::remainder(angle - window_->middle, kTurn), Heading::of(angle))) return std::nullopt;
  NextFrame next;
  RotatingPlace place(base_, theta);
  next.followed = loops_->known();
  next.updated = true;
  loops_->update(*frame_, place, identities_, next_work, next.changes);
  if (!assemble(theta, next)) return std::nullopt;
  next_work.exact_signs += place.exact_signs();
  return next;
}

Result<FrameChanges> RotatingSum::State::move_to(const Orientation& theta) {
  const double begin = now_ms();
  if (theta == orientation && exact_source(sum) != nullptr) {
    work = {};
    return FrameChanges{};
  }
  FrameWork next_work;
  std::optional<NextFrame> next;
  bool built = false;
  if (loops_ != nullptr && options.mode != FrameMode::rebuild) {
    const double angle = moving_angle(theta), before = moving_angle(orientation),
                 step = std::remainder(angle - before, kTurn);
    // Doubles of angles err.
    if (window_ == nullptr || std::abs(std::remainder(angle - window_->middle, kTurn)) > window_->half - kAngleGap) {
      WindowController::Choice choice = controller_.choose(step, widest_window(), options.mode, options.window);
      if (options.window > 0 && step < 0) std::swap(choice.behind, choice.ahead);
      if (choice.window) {
        if (options.progress && !options.progress("window", 0))
          return Error{ErrorCode::cancelled, "stopped on request", {}};
        // The frame before lies inside, so that what is known of it serves.
        const double back = loops_->known() && std::abs(step) < 0.5 ? 1.001 * std::abs(step) : 0;
        const double behind = step >= 0 ? std::max(choice.behind, back) : choice.behind,
                     ahead = step >= 0 ? choice.ahead : std::max(choice.ahead, back);
        build_window(angle - behind, angle + ahead);
        next_work.new_window = built = true;
      } else {
        drop_window();
      }
    }
    if (window_ != nullptr) {
      next = window_frame(theta, next_work);
      next_work.degenerate = !next;
    }
  }
  if (!next) {
    Result<NextFrame> rebuilt = rebuilt_frame(theta, next_work);
    if (!rebuilt) return rebuilt.error();
    if (loops_ != nullptr) loops_->forget();
    next = std::move(rebuilt).value();
    next->ids = identities_.match(sum, ring_ids, next->sum, false, next->changes);
  }
  finish_changes(sum, next->sum, next->changes);
  sum = std::move(next->sum);
  ring_ids = std::move(next->ids);
  orientation = theta;
  next_work.ms = now_ms() - begin;
  if (next_work.rebuilt) slice_cost_ = cost_of_slice(sum.stats);
  const double cost = (next_work.rebuilt ? slice_cost_ : 0) +
                      (window_ != nullptr && !next_work.rebuilt ? cost_of_frame(next_work, sum, slice_cost_) : 0);
  if (built) controller_.built(cost + cost_of_window(*window_), kLate * cost_of_window(*window_));
  else if (window_ == nullptr) controller_.rebuilt(cost);
  else {
    controller_.updated(cost);
    if (options.mode == FrameMode::automatic && options.window == 0 && controller_.give_up(cost)) drop_window();
  }
  work = next_work;
  return std::move(next->changes);
}

}  // namespace dymsum
