#include "planar/result/finish_sum.h"

#include <algorithm>

#include "base/stopwatch.h"
#include "planar/boundary/boundary.h"
#include "planar/result/part_nesting.h"
#include "planar/result/sum_pieces.h"
#include "planar/result/sum_source.h"

namespace dymsum::planar {

PlanarSum finish_sum(SumState&& state, const SumOptions& options) {
  PlanarSum sum;
  StageClock clock(state.stats, timed(state));
  RawBoundary& raw = state.boundary;
  PieceCandidates lower;
  if (options.semantics == Semantics::closed) lower = lower_dimensional_candidates(*state.lattice, *state.p, *state.q);
  const auto source = std::make_shared<SumSource>(state.lattice, std::move(state.p), std::move(state.q));
  exact_source(sum) = source;
  sum.parts = group_rings(std::move(raw.rings), raw.outer, *source, raw.at_error);
  canonicalize(sum.parts, *source, raw.at_error);
  merge_pieces(*source, {}, {std::move(raw.cracks), std::move(raw.punctures)}, sum.tight_segments, sum.tight_points);
  merge_pieces(*source, sum.parts, lower, sum.segments, sum.points);
  if (state.trace) {
    for (const SumVertex& v : sum.tight_points) state.trace->tight_points.push_back(v.at);
    for (const SumSegment& s : sum.tight_segments) state.trace->tight_segments.push_back({s.from.at, s.to.at});
  }
  clock.done("output");
  sum.at_error = raw.at_error;
  // Where pieces are cut off, their ends are rounded even if all other positions are exact.
  if (!sum.segments.empty() || !sum.tight_segments.empty())
    sum.at_error = std::max(sum.at_error, rounding_error(*state.lattice));
  sum.stats = std::move(state.stats);
  if (state.trace) sum.trace = std::move(*state.trace);
  return sum;
}

}  // namespace dymsum::planar
