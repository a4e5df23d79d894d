#include "planar/sum/winding.h"

#include "base/memory_budget.h"
#include "base/poll.h"
#include "planar/arrangement/find_meetings.h"
#include "planar/arrangement/segment_graph.h"
#include "planar/boundary/boundary.h"
#include "planar/boundary/collision.h"
#include "planar/boundary/winding_boundary.h"
#include "planar/convolution/convolution.h"
#include "planar/result/planar_sum.h"

namespace dymsum::planar {
namespace {

std::uint64_t kinetic_size(const SumState& state) {
  std::uint64_t size = 0;
  for_each_kinetic_turn(*state.lattice, *state.p, *state.q, [&](const KineticTurn& turn) { size += turn.count; });
  return size;
}

Tracing trace_convolution(SumState& state, bool parallelograms, Scratch* scratch) {
  base::HeldMemory listed;
  listed.add(kinetic_size(state) * sizeof(KineticSegment));
  Tracing tracing(*state.lattice, *state.p, *state.q, scratch);
  for (const KineticSegment& s : kinetic_convolution(*state.lattice, *state.p, *state.q)) tracing.add(s.walk, s.sign);
  state.stats.reduced_segments = tracing.soup.size();
  if (parallelograms)
    for (const WalkSegment& w : parallelogram_sides(*state.lattice, *state.p, *state.q)) tracing.add(w, 1);
  state.stats.live_segments = tracing.soup.size();
  state.stats.peak_bytes =
      tracing.soup.segments.capacity() * sizeof(SoupSegment) + tracing.soup.boxes.capacity() * sizeof(SoupBox);
  return tracing;
}

Meetings meetings_of(const Soup& soup, SumStats& stats, const Poll& poll) {
  Meetings meetings = all_meetings(soup, nullptr, poll);
  stats.crossings = meetings.crossings.size();
  stats.pair_tests = meetings.pair_tests;
  stats.exact_signs += meetings.exact_signs;
  return meetings;
}

SegmentGraph graph_of(const Soup& soup, Meetings meetings, SumStats& stats) {
  SegmentGraph graph(soup, std::move(meetings));
  stats.exact_signs += graph.exact_orders();
  for (const SegmentGraph::Node& v : graph.nodes()) stats.degenerate_nodes += v.passes > 2;
  return graph;
}

void add_tight_features(const Tracing& tracing, const SegmentGraph& graph, const std::vector<Sides>& sides,
                        SumState& state, double& error) {
  Collision collision(*state.lattice, *state.p, *state.q, false);
  find_tight_features(tracing, graph, sides, collision, state.boundary, error);
  state.stats.collision_tests = collision.counts().tests;
  state.stats.filtered_signs += collision.counts().signs.filtered();
  state.stats.exact_signs += collision.counts().signs.exact();
}

}  // namespace

void run_winding(const SumOptions& options, SumState& state, Poll& poll) {
  StageClock clock(state.stats, true);
  const auto done = [&] {
    clock.done(poll.stage());
    poll(1);
  };
  const bool parallelograms = makes_parallelograms(options.semantics, *state.p, *state.q);
  poll.stage("convolution");
  Scratch scratch;
  base::HeldMemory held;
  const Tracing tracing = trace_convolution(state, parallelograms, &scratch);
  const Soup& soup = tracing.soup;
  done();

  poll.stage("crossings");
  Meetings meetings = meetings_of(soup, state.stats, poll);
  done();

  poll.stage("arrangement");
  const SegmentGraph graph = graph_of(soup, std::move(meetings), state.stats);
  done();

  poll.stage("windings");
  // Beside its sides an edge may be one of a ring, with a vertex.
  held.add(graph.edges().size() * (sizeof(Sides) + sizeof(BoundaryEdge) + sizeof(SumVertex)));
  const std::vector<Sides> sides = find_windings(tracing, graph);
  done();

  poll.stage("loops");
  const GraphRings boundary = winding_rings(tracing, graph, sides);
  const std::vector<BoundaryEdges> rings = boundary.rings();
  state.stats.loops = rings.size();
  double error = soup.point_error;
  for (const BoundaryEdges& ring : rings)
    state.boundary.add(boundary.ring(ring, error), boundary.counter_clockwise(ring));
  if (state.trace) trace_windings(soup, graph, rings, *state.trace);
  done();

  poll.stage("tight");
  if (options.semantics != Semantics::regular && !parallelograms)
    add_tight_features(tracing, graph, sides, state, error);
  state.boundary.at_error = input_error(*state.lattice, error);
  state.stats.peak_bytes += graph.bytes();
  done();
}

}  // namespace dymsum::planar
