#include "dymsum/planar_boolean.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/poll.h"
#include "base/scratch.h"
#include "base/within_memory.h"
#include "planar/arrangement/find_meetings.h"
#include "planar/boolean/boolean_boundary.h"
#include "planar/boolean/joined_inputs.h"
#include "planar/result/finish_sum.h"
#include "planar/sum/sum_engine.h"

namespace dymsum {
namespace {

using planar::BooleanTerms;

/// Every walk edge of P at the one vertex of Q.
planar::Soup soup_of(const planar::SumState& state, Scratch& scratch) {
  planar::Soup soup(*state.lattice, *state.p, *state.q, &scratch);
  soup.reserve(state.p->size());
  for (std::uint32_t e = 0; e < state.p->size(); ++e) soup.add({0, e, 0});
  return soup;
}

// The stages, one after the other. Returns the pieces without interior.
planar::PieceCandidates find_boundary(const BooleanTerms& terms, const planar::JoinedInputs& joined,
                                      const SumOptions& options, planar::SumState& state) {
  Poll poll(options.progress);
  Scratch scratch;
  const planar::Soup soup = soup_of(state, scratch);
  const planar::SegmentInputs segments = planar::segments_of(joined, *state.p);
  state.stats.reduced_segments = state.stats.live_segments = soup.size();
  poll.stage("crossings");
  planar::Meetings meetings = planar::every_meeting(soup, poll);
  state.stats.crossings = meetings.crossings.size();
  state.stats.pair_tests = meetings.pair_tests;
  state.stats.exact_signs = meetings.exact_signs;
  poll.stage("arrangement");
  const planar::SegmentGraph graph(soup, std::move(meetings));
  state.stats.exact_signs += graph.exact_orders();
  for (const planar::SegmentGraph::Node& node : graph.nodes())
    state.stats.degenerate_nodes += node.end.pair && node.passes > 2;
  poll.stage("windings");
  const planar::InputWindings windings(soup, graph, segments.input, terms.inputs.size(), poll);
  poll.stage("boundary");
  planar::BooleanBoundary found = planar::boolean_boundary(soup, graph, windings, segments, terms);
  state.boundary = std::move(found.boundary);
  state.stats.loops = state.boundary.rings.size();
  state.stats.peak_bytes = scratch.peak_bytes();
  poll(1);
  return std::move(found.pieces);
}

PlanarSum finished(planar::SumState&& state, const planar::PieceCandidates& pieces, Semantics semantics) {
  // What sums with a point have of lower dimension is what was found here.
  SumOptions open;
  open.semantics = Semantics::open;
  if (semantics == Semantics::regular) state.boundary.cracks.clear(), state.boundary.punctures.clear();
  PlanarSum result = planar::finish_sum(std::move(state), open);
  if (semantics == Semantics::closed)
    planar::merge_pieces(static_cast<const planar::SumSource&>(*exact_source(result)), {}, pieces, result.segments,
                         result.points);
  return result;
}

}  // namespace

Result<PlanarSum> planar::evaluate(BooleanTerms terms, const SumOptions& options) {
  const auto budget = base::budget_of(options.memory);
  return base::within_memory(budget, "the Boolean operation", [&]() -> Result<PlanarSum> {
    const planar::JoinedInputs joined = planar::joined_inputs(terms);
    PlanarSum result;
    if (!joined.region.own.parts.empty() || !joined.region.own.polylines.empty()) {
      planar::EngineRegion origin;
      origin.own.points.push_back({0, 0});
      Result<planar::SumState> placed =
          planar::placed_state(planar::make_operand(joined.region, 0), planar::make_operand(origin, 1),
                               planar::SumInternals::min_tier_bits(options));
      if (!placed) return placed.error();
      planar::SumState state = std::move(placed).value();
      try {
        const planar::PieceCandidates pieces = find_boundary(terms, joined, options, state);
        result = finished(std::move(state), pieces, options.semantics);
      } catch (const Cancelled&) {
        return cancelled();
      }
    }
    // A result of no rings has no positions, and is an operand without what made it.
    if (exact_source(result) != nullptr)
      exact_source(result) = std::make_shared<planar::BooleanSource>(exact_source(result), std::move(terms));
    return result;
  });
}

namespace {

/// One expression after the other, and what combines each with the ones before it.
Result<PlanarSum> combine(std::span<const PlanarOperand> sets, std::int32_t step, const SumOptions& options) {
  BooleanTerms all;
  for (std::size_t k = 0; k < sets.size(); ++k) {
    all.append(planar::terms_of(sets[k], options.semantics));
    if (k > 0) all.steps.push_back(step);
  }
  return planar::evaluate(std::move(all), options);
}

}  // namespace

Result<PlanarSum> united(std::span<const PlanarOperand> sets, const SumOptions& options) {
  return combine(sets, BooleanTerms::kOr, options);
}

Result<PlanarSum> intersection(std::span<const PlanarOperand> sets, const SumOptions& options) {
  if (sets.empty()) return Error{ErrorCode::out_of_range, "an intersection takes at least one set, not 0", {}};
  return combine(sets, BooleanTerms::kAnd, options);
}

Result<PlanarSum> united(const PlanarOperand& a, const PlanarOperand& b, const SumOptions& options) {
  return united(std::array{a, b}, options);
}

Result<PlanarSum> intersection(const PlanarOperand& a, const PlanarOperand& b, const SumOptions& options) {
  return intersection(std::array{a, b}, options);
}

Result<PlanarSum> difference(const PlanarOperand& a, const PlanarOperand& b, const SumOptions& options) {
  BooleanTerms terms;
  planar::append_difference(planar::terms_of(a, options.semantics), planar::terms_of(b, options.semantics), terms);
  return planar::evaluate(std::move(terms), options);
}

Result<PlanarSum> symmetric_difference(const PlanarOperand& a, const PlanarOperand& b, const SumOptions& options) {
  // Both are made from one reading of the operands, so that their inputs are the same.
  const BooleanTerms p = planar::terms_of(a, options.semantics), q = planar::terms_of(b, options.semantics);
  BooleanTerms terms;
  planar::append_difference(p, q, terms);
  planar::append_difference(q, p, terms);
  terms.steps.push_back(BooleanTerms::kOr);
  return planar::evaluate(std::move(terms), options);
}

Result<PlanarSum> filled(const RegionData& data, Fill fill, const SumOptions& options) {
  planar::RingSet set{{}, fill, {}, {}, {}};
  for (const Part& part : data.parts) {
    set.rings.push_back(part.outer);
    set.rings.insert(set.rings.end(), part.holes.begin(), part.holes.end());
  }
  for (const Ring& ring : set.rings)
    for (const Point& v : ring)
      if (!std::isfinite(v.x) || !std::isfinite(v.y)) {
        Error error{ErrorCode::not_finite, "a coordinate is not finite", {}};
        error.evidence.x = v.x;
        error.evidence.y = v.y;
        return error;
      }
  BooleanTerms terms{{std::make_shared<const planar::RingSet>(std::move(set))}, {0}};
  return planar::evaluate(std::move(terms), options);
}

std::string FillReport::to_string() const {
  const auto counted = [](std::size_t n, const char* one) {
    return std::to_string(n) + " " + one + (n == 1 ? "" : "s");
  };
  return counted(rings, "ring") + " filled to " + std::to_string(rings_now) + " at " + counted(crossings, "crossing") +
         "; " + rounding.to_string();
}

Result<FilledRegion> repair_with_fill(const RegionData& data, Fill fill) {
  const auto rings_of = [](const RegionData& region) {
    std::size_t n = region.parts.size();
    for (const Part& part : region.parts) n += part.holes.size();
    return n;
  };
  FilledRegion made;
  made.report.rings = made.report.rings_now = rings_of(data);
  if (Result<Region> valid = Region::create(data)) {
    made.region = std::move(valid).value();
    return made;
  }
  SumOptions options;
  options.semantics = Semantics::regular;
  const Result<PlanarSum> set = filled(data, fill, options);
  if (!set) return set.error();
  Result<SnapRounded> rounded = snap_rounded(*set);
  if (!rounded) return rounded.error();
  RegionData all = rounded->region.data();
  made.report.filled = true;
  made.report.rings_now = rings_of(all);
  made.report.crossings = set->stats.crossings + set->stats.degenerate_nodes;
  made.report.rounding = rounded->rounding;
  all.polylines.insert(all.polylines.end(), data.polylines.begin(), data.polylines.end());
  all.points.insert(all.points.end(), data.points.begin(), data.points.end());
  Result<Region> region = Region::create(std::move(all));
  if (!region) return region.error();
  made.region = std::move(region).value();
  return made;
}

}  // namespace dymsum
