#include "planar/scaling/scaling_state.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "planar/boundary/boundary.h"
#include "planar/position/vertex_order.h"
#include "planar/result/finish_sum.h"
#include "planar/scaling/degenerate_frame.h"
#include "planar/scaling/fill_lattice.h"
#include "planar/scaling/frame_cost.h"

namespace dymsum {

using namespace planar;
using exact::BigRational;

namespace {

double now_ms() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

bool has_holes(const Operand& o) { return o.loops.size() > o.components.size(); }

// Finer than the static engine's grid: a mask is paid for once a window. Where segments abound building dominates.
int cells_for(double n) {
  const double per_root = n < 4000 ? 4 : 2.5;
  return std::clamp(static_cast<int>(per_root * std::sqrt(n)), 8, 1024);
}

constexpr std::uint32_t kMaskFrom = 300;  // segments from which a mask pays

constexpr double kCheapWindow = 4000;  // some milliseconds to build: no window as cheap as that is abandoned

// What building a window counts when frames are compared: less than whole, as it makes few frames late and all the
// others faster.
constexpr double kLate = 0.65;

}  // namespace

ReducedConvolution& ScalingSum::State::convolution_for(double low, double high) {
  if (convolution_ != nullptr && low >= fill_low_ && high <= fill_high_) return *convolution_;
  const bool holes = has_holes(base->operands[0]) || has_holes(base->operands[1]);
  fill_low_ = holes ? low / 1.5 : 0;
  fill_high_ = holes ? high * 1.5 : INFINITY;
  if (!holes) {
    convolution_ = std::make_shared<ReducedConvolution>(*base->lattice, base->operands[0], base->operands[1]);
    return *convolution_;
  }
  const ScaleValue a = scale_value(exact::exact_value(fill_low_)), b = scale_value(exact::exact_value(fill_high_));
  const auto at_low = base->lattice_at(base->lattice_scale(a, a)),
             at_high = base->lattice_at(base->lattice_scale(b, b));
  const FillLattice fill(*base->lattice, *at_low, *at_high, base->scaled);
  convolution_ = std::make_shared<ReducedConvolution>(fill, base->operands[0], base->operands[1]);
  return *convolution_;
}

const ExactForms& ScalingSum::State::forms() const {
  if (forms_ == nullptr) forms_ = std::make_unique<ExactForms>(*base);
  return *forms_;
}

std::uint64_t ScalingSum::State::hash(LineHashes& known) const {
  for (std::size_t op = 0; op < 2; ++op) {
    known.edges[op].fill(base->operands[op].edge_number);
    known.vertices[op].fill(base->operands[op].vertex_number);
  }
  // Lines instead of contacts: where segments coincide at every scale, any of them may be named.
  const auto segment = [&](const Contact& c) {
    const bool of_p = c.kind == Contact::Kind::edge_of_p;
    const std::size_t op = of_p ? 0 : 1;
    const Operand &o = base->operands[op], &other = base->operands[1 - op];
    return Segment{o.edge(known.edges[op][of_p ? c.p : c.q]), other.source[known.vertices[1 - op][of_p ? c.q : c.p]]};
  };
  const auto line = [&](const Contact& c) {
    const auto [it, fresh] = known.lines.try_emplace(key(c), 0);
    if (fresh) it->second = forms().line_hash(segment(c));
    return it->second;
  };
  std::uint64_t total = sum.parts.size();
  for (const SumRing* ring : rings_of(sum)) {
    std::uint64_t h = ring->vertices.size();
    for (const SumVertex& v : ring->vertices) h += mixed(line(v.in), line(v.out));
    total += mixed(h, 1);
  }
  for (const SumSegment& s : sum.tight_segments) total += mixed(line(s.from.in), 2);
  total += 3 * sum.tight_points.size() + 5 * sum.segments.size() + 7 * sum.points.size();
  return total;
}

void ScalingSum::State::drop_window() {
  leads_.clear();
  leaders_.clear();
  loops_.reset();
  lists_.reset();
  window_.reset();
  loops_known_ = false;
}

WindowSettings ScalingSum::State::settings_for(const BigRational& low, const BigRational& high, double at) const {
  WindowSettings settings;
  // The operand that is smaller here moves.
  const std::uint32_t k = base->scaled;
  const auto size = [&](std::uint32_t op) { return std::max(base->width[op], base->height[op]); };
  const bool scaled_moves = size(k) * at <= size(1 - k);
  settings.frame.moving = scaled_moves ? k : 1 - k;
  // A little wider than asked for, so that rounding cannot leave anything out.
  const double a = exact::round_to_double(scaled_moves ? low : BigRational(1 / high));
  const double b = exact::round_to_double(scaled_moves ? high : BigRational(1 / low));
  settings.frame.tau0 = a * exact::kInwards;
  settings.frame.tau1 = b * exact::kOutwards;
  settings.frame.centre_x = base->width[settings.frame.moving] / 2;
  settings.frame.centre_y = base->height[settings.frame.moving] / 2;
  settings.shrink = shrink;
  return settings;
}

// The width at which the ends of the moving operand sweep kSweep cells: beyond it masks lose more than longer windows
// gain.
double ScalingSum::State::widest_window(double s) const {
  constexpr double kSweep = 4.5;
  const std::uint32_t k = base->scaled;
  const auto size = [&](std::uint32_t op) { return std::max(base->width[op], base->height[op]) * (op == k ? s : 1); };
  const double cells = convolution_ == nullptr ? 64 : cells_for(convolution_->size());
  const double moving = std::min(size(0), size(1)), cell = (size(0) + size(1)) / cells;
  return moving > 0 ? kSweep * cell / (0.5 * moving) : 1;
}

std::unique_ptr<Window> ScalingSum::State::window_between(const BigRational& low, const BigRational& high,
                                                          bool covers) {
  const double a = exact::round_to_double(low), b = exact::round_to_double(high);
  ReducedConvolution& convolution = convolution_for(a * (1 - 0x1p-30), b * (1 + 0x1p-30));
  WindowSettings settings = settings_for(low, high, a);
  settings.cells = cells_for(convolution.size());
  settings.mask = convolution.size() >= kMaskFrom;
  settings.covers = covers;
  return std::make_unique<Window>(*base, convolution, settings);
}

bool ScalingSum::State::build_window(const ScaleValue& s, double behind, double ahead) {
  const double low = s.approx * std::exp(-behind), high = s.approx * std::exp(ahead);
  ReducedConvolution& convolution = convolution_for(low, high);
  WindowSettings settings = settings_for(exact::exact_value(low), exact::exact_value(high), s.approx);
  const double n = convolution.size();
  settings.cells = cells_for(n);
  settings.mask = n >= kMaskFrom;
  drop_window();
  const double dearest =
      options.mode == FrameMode::automatic && options.window == 0 ? controller_.dearest_building() : 0;
  if (dearest > 0) settings.most_pairs = pairs_of_window(std::max(dearest, kCheapWindow), convolution.size());
  window_ = std::make_unique<Window>(*base, convolution, settings);
  if (window_->abandoned) {
    window_.reset();
    return false;
  }
  window_convolution_ = convolution_;
  lists_ = std::make_unique<PieceLists>(*window_);
  loops_ = std::make_unique<FrameLoops>(*lists_);
  low_ = low;
  high_ = high;
  return true;
}

Result<ScalingSum::State::NextFrame> ScalingSum::State::rebuilt_frame(const ScaleValue& x, const ScaleValue& y,
                                                                      FrameWork& work) {
  work.rebuilt = true;
  SumOptions sum_options;
  sum_options.semantics = options.semantics;
  sum_options.progress = options.progress;
  SumState state;
  state.lattice = base->lattice_at(base->lattice_scale(x, y));
  state.p = base->operand_at(0, *state.lattice);
  state.q = base->operand_at(1, *state.lattice);
  state.stats.tier_bits = state.lattice->tier_bits;
  Result<SumState> computed = compute_boundary(std::move(state), sum_options);
  if (!computed) return computed.error();
  NextFrame next;
  next.sum = finish_sum(std::move(computed).value(), sum_options);
  work.exact_signs = next.sum.stats.exact_signs;
  work.collision_tests = next.sum.stats.collision_tests;
  work.loops_traced = next.sum.stats.loops;
  return next;
}

// The kept loops at tau as rings, each starting at its smallest vertex; sets what the sum says about its positions.
ScalingSum::State::KeptRings ScalingSum::State::kept_rings(double tau, FramePlace& place, const PairSource& source,
                                                           PlanarSum& next) {
  const Lattice& l = *base->lattice;
  const double grow = place.blow_up(window_->frame().moving), unit = l.unit, s = place.value().approx;
  const std::uint32_t k = base->scaled;
  const double ox = l.points[k]->offset.x * s + l.points[1 - k]->offset.x,
               oy = l.points[k]->offset.y * s + l.points[1 - k]->offset.y;
  const double reach = (std::abs(l.points[k]->offset.x) + std::abs(l.points[k]->offset.y)) * s +
                       std::abs(l.points[1 - k]->offset.x) + std::abs(l.points[1 - k]->offset.y);
  const double span = window_->span(), poor = 0x1p-38 * span;
  // Times the span: evaluation (3), the blow-up and the last sum; times the offsets: the scale, products and sums.
  constexpr double kKept = exact::rounding_bound(6, 16), kOffsets = exact::rounding_bound(5, 8);
  const auto input_error = [&](double of_point) {
    return grow * (of_point + kKept * span) * unit * exact::kOutwards + kOffsets * reach;
  };
  const VertexOrder order(source, input_error(poor));
  const SumVertex* const vertices = loops_->vertices().data();
  const MovingPoint* const points = loops_->points().data();
  double error = 0;
  // Returns the bound on what it puts.
  const Two origin{ox, oy};
  const auto put = [=, &source](std::uint32_t vertex, SumVertex& to) {
    to = vertices[vertex];
    const MovingPoint& v = points[vertex];
    if (v.error <= poor) {
      const Two at = both(grow) * v.at(tau) * both(unit) + origin;
      to.at = {at[0], at[1]};
      return v.error;
    }
    const ExactSource::Position p = source.position(to);
    to.at = {exact::round_to_double(p.x), exact::round_to_double(p.y)};
    return poor;
  };
  // Rings start at their smallest vertices, most often those of the frame before.
  std::vector<std::uint32_t> leaders;
  leads_.resize(loops_->vertices().size(), 0);
  const auto ring_of = [&](FrameLoop& loop) {
    if (loop.vertices.empty())
      for (const LoopStep& step : loop.steps)
        if (step.vertex != kNone) loop.vertices.push_back(step.vertex);
    const std::size_t n = loop.vertices.size();
    SumRing ring;
    if (!spare_rings_.empty()) {
      ring = std::move(spare_rings_.back());
      spare_rings_.pop_back();
    }
    ring.vertices.resize(n);
    const auto led =
        std::find_if(loop.vertices.begin(), loop.vertices.end(), [&](std::uint32_t v) { return leads_[v] != 0; });
    const std::size_t start = led == loop.vertices.end() ? 0 : static_cast<std::size_t>(led - loop.vertices.begin());
    SumVertex* const first = ring.vertices.data();
    SumVertex *to = first, *least = first;
    std::uint32_t leader = kNone;
    double worst = 0;
    const auto put_all = [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i, ++to) {
        worst = std::max(worst, put(loop.vertices[i], *to));
        if (leader != kNone && (order.certainly_right(*to, *least) || order.compare(*to, *least) >= 0)) continue;
        least = to;
        leader = loop.vertices[i];
      }
    };
    put_all(start, n);
    put_all(0, start);
    error = std::max(error, worst);
    std::rotate(first, least, to);
    leaders.push_back(leader);
    return ring;
  };
  KeptRings kept;
  for (FrameLoop& loop : loops_->loops()) {
    if (!loop.kept) continue;
    kept.rings.push_back(ring_of(loop));
    kept.outer.push_back(loop.turning > 0);
    kept.loops.push_back(&loop);
  }
  for (const std::uint32_t v : leaders_) leads_[v] = 0;
  for (const std::uint32_t v : leaders) leads_[v] = 1;
  leaders_ = std::move(leaders);
  next.at_error = input_error(error);
  return kept;
}

// The kept loops at tau: rings in canonical order.
ScalingSum::State::NextFrame ScalingSum::State::assemble(double tau, FramePlace& place) {
  NextFrame next;
  const auto source = std::make_shared<PairSource>(base, place.scale());
  exact_source(next.sum) = source;
  next.sum.stats.tier_bits = place.has_lattice() ? place.lattice().tier_bits : base->lattice->tier_bits;
  next.sum.stats.reduced_segments = window_convolution_->size();
  next.sum.stats.live_segments = window_->segments.size();
  next.followed = loops_known_;
  KeptRings kept = kept_rings(tau, place, *source, next.sum);
  for (const std::size_t i : place_rings(std::move(kept.rings), kept.outer, next.sum))
    next.loops.push_back(kept.loops[i]);
  return next;
}

ScalingSum::State::NextFrame ScalingSum::State::window_frame(const ScaleValue& s, FrameWork& work) {
  FramePlace place(base, s);
  const double tau = place.tau(window_->frame().moving);
  bool generic = lists_->repair(tau, place, work);
  NextFrame next;
  generic = generic && loops_->update(tau, place, !loops_known_, work);
  if (!generic) {
    work.degenerate = true;
    SumOptions sum_options;
    sum_options.semantics = options.semantics;
    SumState state = degenerate_frame(*window_, *window_convolution_, place, options.semantics);
    work.loops_traced = state.stats.loops;
    next.sum = finish_sum(std::move(state), sum_options);
    loops_known_ = false;
    loops_->loops().clear();
  } else {
    next = assemble(tau, place);
    loops_known_ = true;
  }
  if (place.has_collision())
    work.collision_tests = std::max<std::uint64_t>(work.collision_tests, place.collision().counts().tests);
  work.exact_signs += place.exact_signs;
  if (place.has_collision()) work.exact_signs += place.collision().counts().exact;
  work.pieces = window_->pieces.size();
  work.candidates = window_->candidates.size();
  work.window_low = low_;
  work.window_high = high_;
  work.peak_bytes = window_->bytes() + lists_->bytes() + loops_->bytes();
  return next;
}

// Identities between two frames of one window, from what the loops remember.
std::vector<std::uint64_t> ScalingSum::State::follow_rings(const NextFrame& next, bool same_place,
                                                           FrameChanges& changes) {
  std::vector<std::uint64_t> ids;
  for (FrameLoop* loop : next.loops) {
    const std::uint32_t size = loop->corners;
    if (loop->ring == 0) {
      loop->ring = identities_.fresh();
      changes.rings.push_back({RingChange::Kind::appeared, loop->ring, size, 0});
    } else if (loop->fresh && !(loop->vertices_before == size && loop->vertices_shared == size)) {
      changes.rings.push_back({RingChange::Kind::reshaped, loop->ring, size - loop->vertices_shared,
                               loop->vertices_before - loop->vertices_shared});
    } else if (!same_place) {
      changes.rings.push_back({RingChange::Kind::moved, loop->ring, 0, 0});
    }
    ids.push_back(loop->ring);
  }
  for (const auto& [ring, vertices] : loops_->ended())
    changes.rings.push_back({RingChange::Kind::disappeared, ring, 0, vertices});
  return ids;
}

FrameChanges ScalingSum::State::take(NextFrame next, bool same_place) {
  FrameChanges changes;
  std::vector<std::uint64_t> ids = next.followed ? follow_rings(next, same_place, changes)
                                                 : identities_.match(sum, ring_ids, next.sum, same_place, changes);
  if (!next.followed)
    for (std::size_t i = 0; i < next.loops.size(); ++i) next.loops[i]->ring = ids[i];
  finish_changes(sum, next.sum, changes);
  spare_rings_.clear();
  if (!next.loops.empty()) {
    for (SumPart& part : sum.parts) {
      spare_rings_.push_back(std::move(part.outer));
      for (SumRing& hole : part.holes) spare_rings_.push_back(std::move(hole));
    }
    std::reverse(spare_rings_.begin(), spare_rings_.end());
  }
  sum = std::move(next.sum);
  ring_ids = std::move(ids);
  return changes;
}

Result<FrameChanges> ScalingSum::State::move_to(const Scale& x, const Scale& y) {
  const double start = now_ms();
  const ScaleValue sx = scale_value(x), sy = x == y ? sx : scale_value(y);
  FrameWork next_work;
  std::optional<NextFrame> next;
  const bool empty = base->operands[0].size() == 0 || base->operands[1].size() == 0;
  const bool uniform = x == y, windowable = uniform && base->regular && !empty && scale == scale_y;
  const bool inside = windowable && window_ != nullptr && sx.approx > low_ && sx.approx < high_;
  const double step = std::log(sx.approx / scale.approx());
  bool built = false;
  if (inside && options.mode != FrameMode::rebuild) {
    next = window_frame(sx, next_work);
  } else if (windowable) {
    const WindowController::Choice choice =
        controller_.choose(step, widest_window(sx.approx), options.mode, std::log1p(options.window));
    if (choice.window) {
      if (options.progress && !options.progress("window", 0))
        return Error{ErrorCode::cancelled, "stopped on request", {}};
      built = build_window(sx, choice.behind, choice.ahead);
      if (built) next = window_frame(sx, next_work);
      else controller_.abandoned(step);
      next_work.new_window = built;
    }
  }
  if (!next) {
    Result<NextFrame> rebuilt = rebuilt_frame(sx, sy, next_work);
    if (!rebuilt) return rebuilt.error();
    drop_window();
    next = std::move(rebuilt).value();
  }
  FrameChanges changes = take(*std::move(next), x == scale && y == scale_y);
  scale = x;
  scale_y = y;
  next_work.ms = now_ms() - start;
  const double cost = next_work.rebuilt ? cost_of_sum(sum) : cost_of_frame(next_work, sum);
  if (next_work.rebuilt) controller_.rebuilt(cost);
  else if (built) controller_.built(cost + kLate * cost_of_window(*window_, window_convolution_->size()));
  else {
    controller_.updated(cost);
    if (options.mode == FrameMode::automatic && options.window == 0 && controller_.give_up(cost)) drop_window();
  }
  work = next_work;
  return changes;
}

}  // namespace dymsum
