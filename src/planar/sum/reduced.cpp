#include "planar/sum/reduced.h"

#include <optional>
#include <utility>

#include "base/memory_budget.h"
#include "base/stopwatch.h"
#include "planar/arrangement/arrangement.h"
#include "planar/arrangement/find_meetings.h"
#include "planar/arrangement/live_pieces.h"
#include "planar/boundary/boundary.h"
#include "planar/boundary/tight_features.h"
#include "planar/convolution/parallelogram_sides.h"
#include "planar/result/trace_stages.h"
#include "planar/sum/live_segments.h"
#include "planar/sum/reduced_chain.h"

namespace dymsum::planar {
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
