#include "planar/sum/reduced.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <utility>

#include "base/doubles.h"
#include "base/memory_budget.h"
#include "base/poll.h"
#include "planar/arrangement/arrangement.h"
#include "planar/arrangement/crossings.h"
#include "planar/arrangement/find_meetings.h"
#include "planar/arrangement/live_pieces.h"
#include "planar/boundary/boundary.h"
#include "planar/convolution/convolution.h"
#include "planar/result/planar_sum.h"

namespace dymsum::planar {
namespace {

// Segments that a convolution holds twice.

/// Segments by their ends. Sums of operands with common edge vectors, above all P + P, hold most segments twice; one is
/// enough.
class SameSegments {
 public:
  explicit SameSegments(const Soup& soup) : soup_(soup), slots_(soup.memory) {}
  void reserve(std::size_t n) {
    slots_.assign(std::bit_ceil(2 * n + 1), kNone);
    shift_ = 64 - std::countr_zero(slots_.size());
  }

  // The earlier segment with exactly the same ends, or kNone; then s is remembered.
  std::uint32_t find_or_add(std::uint32_t s) {
    const SoupBox& b = soup_.boxes[s];
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = hash(b) >> shift_;
    for (; slots_[at] != kNone; at = (at + 1) & mask) {
      const std::uint32_t t = slots_[at];
      const SoupBox& c = soup_.boxes[t];
      if (b.ax == c.ax && b.ay == c.ay && b.bx == c.bx && b.by == c.by &&
          (soup_.exact_sums() || (soup_.lattice.same(soup_.exact(soup_.start(s)), soup_.exact(soup_.start(t))) &&
                                  soup_.lattice.same(soup_.exact(soup_.end(s)), soup_.exact(soup_.end(t))))))
        return t;
    }
    slots_[at] = s;
    return kNone;
  }

 private:
  // Its high bits count: doubles that hold small integers end in zeros.
  static std::uint64_t hash(const SoupBox& b) {
    const auto bits = [](double v) { return base::bit_cast<std::uint64_t>(v); };
    return bits(b.ax) * 0x9e3779b97f4a7c15 + bits(b.ay) * 0xc2b2ae3d27d4eb4f + bits(b.bx) * 0x165667b19e3779f9 +
           bits(b.by) * 0x27d4eb2f165667c5;
  }
  const Soup& soup_;
  Array<std::uint32_t> slots_;
  int shift_ = 0;
};

}  // namespace

ReducedChain::ReducedChain(const Soup& soup, const ReducedConvolution& convolution, Array<std::uint32_t> live,
                           std::uint32_t reduced)
    : Chain(soup.memory), soup_(soup), convolution_(convolution), live_(std::move(live)) {
  first_unchained_ = reduced;
  next_.resize(soup.size(), kNone);
  fill_next();
}

void ReducedChain::fill_next() {
  const std::uint32_t n = convolution_.size(), reduced = first_unchained_;
  if (live_.empty()) {
    convolution_.fill_next({next_.data(), reduced});
  } else if (reduced > n / 3) {
    Array<std::uint32_t> next(n, soup_.memory);
    convolution_.fill_next(next);
    // The first id of a segment made it; segments are in the order of these ids.
    for (std::uint32_t id = 0, s = 0; s < reduced; ++id)
      if (live_[id] == s) next_[s++] = live(next[id]);
  } else {
    for (std::uint32_t s = 0; s < reduced; ++s) {
      const SoupSegment& g = soup_.segments[s];
      next_[s] = live(convolution_.next({g.side(), g.edge(), g.vertex}));
    }
  }
}

void ReducedChain::incident(WalkPair v, Array<Incidence>& out) const {
  const Operand &p = *soup_.operands[0], &q = *soup_.operands[1];
  add(convolution_.find(0, v.p, v.q), true, out);
  add(convolution_.find(1, v.q, v.p), true, out);
  add(convolution_.find(0, p.prev[v.p], v.q), false, out);
  add(convolution_.find(1, q.prev[v.q], v.p), false, out);
  for (std::uint32_t s = first_unchained_; s < soup_.size(); ++s) {
    if (soup_.start(s) == v) out.push_back({s, true});
    if (soup_.end(s) == v) out.push_back({s, false});
  }
}

namespace {

// The cells that edges of one operand reach, wherever a vertex of the other moves them.
class EdgeCells {
 public:
  EdgeCells(const InteriorMask& mask, std::size_t most_edges, Scratch* memory) : mask_(mask), bounds_(memory) {
    bounds_.reserve(most_edges);
  }

  void of(const Operand& o) {
    // A float errs by at most kReach, as there are fewer than 2048 rows and columns: half a unit in the last place of
    // 1024 and more.
    constexpr double reach = 3 * kReach;
    static_assert(1024 * exact::kFloatRoundoff <= kReach);
    const double per_cell = mask_.grid().per_cell;
    bounds_.clear();
    for (const EdgeBox& b : o.boxes)
      bounds_.push_back({static_cast<float>(std::min(b.ay, b.by) * per_cell - reach),
                         static_cast<float>(std::min(b.ax, b.bx) * per_cell - reach),
                         static_cast<float>(std::max(b.ay, b.by) * per_cell + reach),
                         static_cast<float>(std::max(b.ax, b.bx) * per_cell + reach)});
  }
  /// Whether all cells that an edge reaches are covered when it is moved by so many rows and columns.
  bool covered(std::uint32_t edge, double row, double column) const {
    const std::array<double, 4> at{row, column, row, column};
    std::array<int, 4> cell;
    for (std::size_t k = 0; k < 4; ++k) cell[k] = static_cast<int>(bounds_[edge][k] + at[k]);
    return !mask_.any_live(cell[0], cell[1], cell[2], cell[3]);
  }

 private:
  // Low row, low column, high row, high column. Without clamps: coordinates lie in [0, span], and the grid reaches
  // farther than that by more than a cell.
  using Bounds = std::array<float, 4>;
  const InteriorMask& mask_;
  Array<Bounds> bounds_;
};

}  // namespace

void add_all(const ReducedConvolution& convolution, Soup& soup) {
  std::size_t i = soup.size();
  soup.segments.resize(i + convolution.size());
  soup.boxes.resize(soup.segments.size());
  SoupSegment* segment = soup.segments.data() + i;
  SoupBox* to = soup.boxes.data() + i;
  convolution.for_each_turn([&](std::uint32_t side, std::uint32_t v, std::span<const std::uint32_t> edges,
                                std::uint32_t lo, std::uint32_t count) {
    const EdgeBox* const own = soup.operands[side]->boxes.data();
    const double vx = soup.operands[1 - side]->x[v], vy = soup.operands[1 - side]->y[v];
    const std::uint32_t *at = edges.data() + lo, *const end = edges.data() + edges.size(), label = side << 31;
    for (SoupBox* const last = to + count; to != last; ++to) {
      const std::uint32_t e = *at;
      *segment++ = {label | e, v};
      *to = moved(own[e], vx, vy);
      if (++at == end) at = edges.data();
    }
  });
}

Array<std::uint32_t> add_live(const ReducedConvolution& convolution, const InteriorMask* mask, Twins twins, Soup& soup,
                              const Poll& poll) {
  const std::uint32_t n = convolution.size();
  Array<std::uint32_t> live(n, kNone, soup.memory);
  SameSegments same(soup);
  if (twins == Twins::merged) same.reserve(n);
  soup.reserve(std::min<std::size_t>(n, 256));
  std::optional<EdgeCells> cells;
  if (mask != nullptr)
    cells.emplace(*mask, std::max(soup.operands[0]->boxes.size(), soup.operands[1]->boxes.size()), soup.memory);
  const double per_cell = mask != nullptr ? mask->grid().per_cell : 0;
  std::uint32_t side_of_cells = 2;
  std::uint32_t* to = live.data();
  std::size_t queried = 0;  // when poll was
  convolution.for_each_turn([&](std::uint32_t side, std::uint32_t v, std::span<const std::uint32_t> edges,
                                std::uint32_t lo, std::uint32_t count) {
    if (const auto done = static_cast<std::size_t>(to - live.data()); done - queried > 10000) {
      queried = done;
      poll(static_cast<double>(done) / n);
    }
    const Operand &o = *soup.operands[side], &other = *soup.operands[1 - side];
    const EdgeBox* own = o.boxes.data();
    const double vx = other.x[v], vy = other.y[v];
    if (cells && side_of_cells != side) {
      cells->of(o);
      side_of_cells = side;
    }
    const double row = vy * per_cell, column = vx * per_cell;
    for (std::uint32_t k = 0, at = lo; k < count; ++k, at = at + 1 == edges.size() ? 0 : at + 1, ++to) {
      const std::uint32_t e = edges[at];
      if (cells && cells->covered(e, row, column)) continue;
      const SoupBox b = moved(own[e], vx, vy);
      if (soup.size() == soup.segments.capacity()) soup.reserve(std::min<std::size_t>(n, 2 * soup.size()));
      *to = static_cast<std::uint32_t>(soup.size());
      soup.add({side, e, v}, b);
      if (twins == Twins::kept) continue;
      if (const std::uint32_t twin = same.find_or_add(*to); twin != kNone) {
        *to = twin;
        soup.drop_last();
      }
    }
  });
  return live;
}

namespace {

// What the steps share.
struct Run {
  Run(const SumOptions& options, SumState& state, Poll& poll)
      : options(options), state(state), poll(poll), clock(state.stats, timed(state)) {}

  const SumOptions& options;
  SumState& state;
  Poll& poll;
  StageClock<SumStats> clock;
  Scratch scratch;
  base::HeldMemory rings;
  const Lattice& lattice = *state.lattice;
  const Operand &p = *state.p, &q = *state.q;
  SumStats& stats = state.stats;
  const bool fast = options.engine == Engine::fast;
  const bool parallelograms = makes_parallelograms(options.semantics, p, q);
};

// Segments in a soup; of those of the convolution, which come first, only live ones.
struct Segments {
  Soup soup;
  Array<std::uint32_t> live;  // id -> segment; empty: the id
  std::uint32_t reduced = 0;  // segments of the convolution
  std::optional<Refined> refined;
};

std::optional<InteriorMask> make_mask(Run& run, std::uint32_t segments, Refine when) {
  constexpr std::size_t kMask = 400;  // below this many a mask does not pay
  std::optional<InteriorMask> mask;
  if (!run.fast || (segments < kMask && (segments == 0 || when != Refine::always))) return mask;
  if (run.lattice.wide) return mask;  // a mask measures edges in doubles
  run.poll.stage("mask");
  run.stats.mask_grid = grid_size(segments);
  mask.emplace(run.p, run.q, run.stats.mask_grid);
  run.clock.done("mask");
  return mask;
}

Segments make_segments(Run& run, const ReducedConvolution& convolution, const InteriorMask* mask) {
  constexpr std::size_t kMerge = 24;  // below this many meeting twins cost less than finding them
  run.poll.stage("segments");
  Segments out{Soup(run.lattice, run.p, run.q, &run.scratch), Array<std::uint32_t>(&run.scratch), 0, std::nullopt};
  const bool merge =
      run.fast && convolution.size() >= kMerge && convolution.parallel_edges() * 8 > run.p.size() + run.q.size();
  if (mask != nullptr || merge)
    out.live = add_live(convolution, mask, merge ? Twins::merged : Twins::kept, out.soup, run.poll);
  else add_all(convolution, out.soup);
  run.clock.done("convolution");
  return out;
}

// Leaves out more than the mask does, where it pays. Sides of parallelograms are in no cell.
void refine_segments(Run& run, InteriorMask& mask, Segments& segments, Refine when) {
  if (run.parallelograms) return;
  run.poll.stage("refinement");
  segments.refined = refine(run.p, run.q, mask, segments.soup, segments.live, when, run.poll);
  if (!segments.refined) return;
  if (segments.refined->fine) run.stats.mask_grid *= kBrick;
  run.clock.done("refinement");
}

ReducedChain make_chain(Run& run, const ReducedConvolution& convolution, Segments& segments) {
  segments.reduced = static_cast<std::uint32_t>(segments.soup.size());
  if (run.parallelograms)
    for (const WalkSegment& side : parallelogram_sides(run.lattice, run.p, run.q)) segments.soup.add(side);
  run.stats.live_segments = segments.soup.size();
  return ReducedChain(segments.soup, convolution, std::move(segments.live), segments.reduced);
}

MarkedMeetings find_meetings(Run& run, Segments& segments, const ReducedChain& chain, const KnownCover& cover) {
  run.poll.stage("crossings");
  MarkedMeetings found = [&]() -> MarkedMeetings {
    if (!run.fast) return {all_meetings(segments.soup, &chain, run.poll), Array<CoveredMark>(&run.scratch)};
    if (!segments.refined) return open_meetings(segments.soup, chain, cover, run.poll);
    return {piece_meetings(segments.soup, chain, segments.refined->live.pieces, *cover.fine, run.poll),
            std::move(segments.refined->live.marks)};
  }();
  run.stats.crossings = found.meetings.crossings.size();
  run.stats.cell_entries = found.meetings.cell_entries;
  run.stats.pair_tests = found.meetings.pair_tests;
  run.stats.exact_signs += found.meetings.exact_signs;
  run.clock.done("crossings");
  return found;
}

// One component each, at least one of them with interior: then the open sum is connected.
bool is_connected(const Run& run) {
  const auto &p = run.p.components, &q = run.q.components;
  return run.fast && !run.parallelograms && p.size() == 1 && q.size() == 1 &&
         (p[0].dimension == 2 || q[0].dimension == 2);
}

SortedLoops sort_loops(Run& run, const Soup& soup, const Arrangement& arrangement, Collision& collision,
                       const KnownCover& cover) {
  run.poll.stage("loops");
  Array<BoundaryLoop> loops = find_loops(soup, arrangement, &run.poll);
  run.stats.loops = loops.size();
  run.clock.done("loops");
  run.poll.stage("collision");
  SortedLoops sorted =
      verify_loops(soup, arrangement, std::move(loops), collision, is_connected(run), cover, &run.poll);
  run.clock.done("collision");
  return sorted;
}

void add_boundary(Run& run, const Soup& soup, const Arrangement& arrangement, Collision& collision,
                  SortedLoops sorted) {
  RawBoundary& boundary = run.state.boundary;
  double grid_error = soup.point_error;
  if (run.options.semantics != Semantics::regular && !run.parallelograms)
    find_tight_features(soup, arrangement, sorted.kept, collision, boundary, grid_error, &run.poll);
  run.clock.done("tight");
  const Array<BoundaryLoop> rings = simple_rings(soup, arrangement, std::move(sorted.kept));
  for (const BoundaryLoop& ring : rings) run.rings.add(ring.steps.size() * sizeof(SumVertex));
  for (const BoundaryLoop& ring : rings) boundary.add(make_ring(soup, arrangement, ring, grid_error), ring.turning > 0);
  boundary.at_error = input_error(run.lattice, grid_error);
  boundary.may_touch = arrangement.degenerate_nodes() > 0;
}

void count_work(Run& run, const Collision& collision, const KnownCover& cover) {
  run.stats.collision_tests = collision.counts().tests;
  run.stats.filtered_signs += collision.counts().signs.filtered();
  run.stats.exact_signs += collision.counts().signs.exact();
  run.stats.peak_bytes = run.scratch.peak_bytes() + (cover.mask != nullptr ? cover.mask->bytes() : 0) +
                         (cover.fine != nullptr ? cover.fine->bytes() : 0);
}

}  // namespace

// The numbers are those of the steps in docs/design/planar-sum.md.
void run_reduced(const SumOptions& options, SumState& state, Refine when, Poll& poll) {
  Run run(options, state, poll);

  // 4. Reduced convolution.
  poll.stage("convolution");
  const ReducedConvolution convolution(run.lattice, run.p, run.q, &run.scratch);
  run.stats.reduced_segments = convolution.size();
  run.clock.done("directions");

  // 5. Interior mask.
  std::optional<InteriorMask> mask = make_mask(run, convolution.size(), when);

  // 6. Live segments.
  Segments segments = make_segments(run, convolution, mask ? &*mask : nullptr);
  if (mask) refine_segments(run, *mask, segments, when);
  const KnownCover cover{mask ? &*mask : nullptr, segments.refined ? &segments.refined->cells : nullptr};
  const ReducedChain chain = make_chain(run, convolution, segments);
  run.clock.done("chains");

  // 7. Crossings and touches.
  const Soup& soup = segments.soup;
  MarkedMeetings found = find_meetings(run, segments, chain, cover);

  // 8. Order along segments, kill rule, vertex routine.
  poll.stage("arrangement");
  const Arrangement arrangement(soup, std::move(found.meetings), chain, found.marks, &poll);
  run.stats.degenerate_nodes = arrangement.degenerate_nodes();
  run.stats.exact_signs += arrangement.exact_orders();
  run.clock.done("arrangement");

  // 9. Cycles, collision tests.
  Collision collision(run.lattice, run.p, run.q, run.fast);
  collision.with_parallelograms = run.parallelograms;
  SortedLoops sorted = sort_loops(run, soup, arrangement, collision, cover);
  if (state.trace) trace_stages(soup, cover.mask, arrangement, sorted, convolution, *state.trace);

  // 10. Tight candidates, rings. (Parts, pieces and their order: finish_sum.)
  add_boundary(run, soup, arrangement, collision, std::move(sorted));
  count_work(run, collision, cover);
  run.clock.done("rings");
  poll(1);
}

}  // namespace dymsum::planar
