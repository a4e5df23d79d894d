#include "planar/sum/placed_sum.h"

#include "planar/arrangement/crossings.h"
#include "planar/boundary/boundary.h"
#include "planar/boundary/tight_features.h"
#include "planar/result/finish_sum.h"
#include "planar/sum/reduced_chain.h"
#include "planar/sum/sum_engine.h"

namespace dymsum::planar {
namespace {

// The true loops of the arrangement, with what is tight beside them.
RawBoundary boundary_of(const Soup& soup, const Arrangement& arrangement, SortedLoops loops, Collision& collision,
                        Semantics semantics) {
  RawBoundary boundary;
  double grid_error = soup.point_error;
  if (semantics != Semantics::regular)
    find_tight_features(soup, arrangement, loops.kept, collision, boundary, grid_error);
  for (const BoundaryLoop& ring : simple_rings(soup, arrangement, std::move(loops.kept)))
    boundary.add(make_ring(soup, arrangement, ring, grid_error), ring.turning > 0);
  boundary.at_error = input_error(soup.lattice, grid_error);
  return boundary;
}

}  // namespace

Result<PlanarSum> placed_sum(PlacedPair placed, const SumOptions& options) {
  Result<SumState> computed = compute_boundary(std::move(placed), options);
  if (!computed) return computed.error();
  return finish_sum(std::move(computed).value(), options);
}

CandidateSum sum_of_candidates(PlacedPair placed, const BoundaryCandidates& candidates, Collision& collision,
                               Semantics semantics) {
  SumState state(std::move(placed));
  Scratch scratch;
  Soup soup(*state.lattice, *state.p, *state.q, &scratch);
  for (const WalkSegment& s : candidates.segments) soup.add(s, soup.box(s));
  Array<std::uint32_t> live(candidates.segment_of.begin(), candidates.segment_of.end(), &scratch);
  const ReducedChain chain(soup, candidates.convolution, std::move(live), soup.size());
  Array<CoveredMark> marks(&scratch);
  for (const auto& [segment, fraction] : candidates.covered) marks.push_back({segment, fraction});

  Meetings meetings(&scratch);
  CrossingFinder finder(soup, meetings, &chain);
  finder.pairs(candidates.pairs);
  state.stats.crossings = meetings.crossings.size();
  state.stats.pair_tests = meetings.pair_tests;
  CandidateSum found;
  found.exact_signs = meetings.exact_signs;
  const Arrangement arrangement(soup, std::move(meetings), chain, marks);
  state.stats.degenerate_nodes = arrangement.degenerate_nodes();
  found.exact_signs += arrangement.exact_orders();

  Array<BoundaryLoop> loops = find_loops(soup, arrangement);
  state.stats.loops = loops.size();
  SortedLoops sorted = verify_loops(soup, arrangement, std::move(loops), collision, candidates.connected);
  state.boundary = boundary_of(soup, arrangement, std::move(sorted), collision, semantics);
  SumOptions options;
  options.semantics = semantics;
  found.sum = finish_sum(std::move(state), options);
  return found;
}

}  // namespace dymsum::planar
