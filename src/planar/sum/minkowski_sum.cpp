#include "planar/sum/minkowski_sum.h"

#include <array>
#include <cstddef>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>

#include "base/memory_budget.h"
#include "base/poll.h"
#include "dymsum/planar_sum.h"
#include "exact/rounding_bound.h"
#include "planar/arrangement/crossings.h"
#include "planar/boundary/boundary.h"
#include "planar/convolution/convolution.h"
#include "planar/operand/operand.h"
#include "planar/region/region.h"
#include "planar/result/planar_sum.h"
#include "planar/result/result_region.h"
#include "planar/sum/reduced.h"
#include "planar/sum/winding.h"

namespace dymsum::planar {
namespace {

// Convex operands: see convex_boundary.
bool run_convex(const SumOptions& options, SumState& state, Poll& poll) {
  if (options.engine != Engine::fast || options.trace) return false;
  StageClock clock(state.stats, timed(state));
  std::optional<SumRing> ring = convex_boundary(*state.lattice, *state.p, *state.q);
  if (!ring) return false;
  state.stats.reduced_segments = state.p->loops[0].last + state.q->loops[0].last;
  state.stats.live_segments = state.stats.reduced_segments;
  state.stats.loops = 1;
  state.boundary.at_error = input_error(*state.lattice, sum_error(*state.lattice));
  state.boundary.add(*std::move(ring), true);
  clock.done("convolution");
  poll.stage("convolution");
  poll(1);
  return true;
}

void run_engine(const SumOptions& options, SumState& state, Refine refine, Poll& poll) {
  if (state.p->size() == 0 || state.q->size() == 0) return;
  if (run_convex(options, state, poll)) return;
  if (options.engine == Engine::winding) run_winding(options, state, poll);
  else run_reduced(options, state, refine, poll);
}

std::string text(std::uint64_t n) { return std::to_string(n); }

std::string sum_of_sizes(const SumState& state) {
  return "the sum of " + text(state.p->size()) + " and " + text(state.q->size()) + " vertices";
}

// The stage of an engine, and what it had found.
std::string standing(const SumState& state, std::string_view stage) {
  std::string where;
  if (!stage.empty()) where += " in the stage '" + std::string(stage) + "'";
  if (state.stats.reduced_segments > 0) where += ", " + text(state.stats.reduced_segments) + " segments";
  if (state.stats.live_segments > 0) where += ", " + text(state.stats.live_segments) + " of them to be intersected";
  if (state.stats.crossings > 0) where += ", " + text(state.stats.crossings) + " crossings";
  return where;
}

Error no_room(ErrorCode code, const SumState& state, std::string_view stage, std::string_view reason) {
  return {code, sum_of_sizes(state) + " is too large: " + std::string(reason) + standing(state, stage), {}};
}

Error over_limit(const SumState& state, std::string_view stage, const base::OverMemory& over) {
  Error error = base::over_memory(sum_of_sizes(state), over);
  error.message += ";" + standing(state, stage);
  return error;
}

Result<void> run(SumState& state, const SumOptions& options, Refine refine) {
  if (options.trace) state.trace = std::make_unique<PlanarTrace>();
  Poll poll(options.progress);
  const base::UseBudget use(base::budget_of(options.memory));
  try {
    run_engine(options, state, refine, poll);
  } catch (const Cancelled&) {
    return cancelled();
  } catch (const base::OverMemory& over) {
    if (options.memory == 0) throw;  // the limit of a larger computation
    return over_limit(state, poll.stage(), over);
  } catch (const std::bad_alloc&) {
    return no_room(ErrorCode::out_of_memory, state, poll.stage(), "out of memory");
  } catch (const std::length_error& more) {
    return no_room(ErrorCode::unsupported_operand, state, poll.stage(), more.what());
  }
  return {};
}

}  // namespace

Result<SumState> placed_state(std::shared_ptr<const Operand> p, std::shared_ptr<const Operand> q, int min_tier_bits) {
  SumState state;
  state.p = std::move(p);
  state.q = std::move(q);
  StageClock clock(state.stats, timed(state));
  for (const Operand* o : {state.p.get(), state.q.get()})
    if (std::optional<Error> error = too_large(*o)) return *std::move(error);
  state.lattice = make_lattice(state.p->points, state.q->points, min_tier_bits);
  state.p = placed_on(*state.lattice, std::move(state.p));
  state.q = placed_on(*state.lattice, std::move(state.q));
  state.stats.tier_bits = state.lattice->tier_bits;
  clock.done("operands");
  return state;
}

Result<SumState> compute_boundary(std::shared_ptr<const Operand> p, std::shared_ptr<const Operand> q,
                                  const SumOptions& options, Refine refine) {
  Result<SumState> placed = placed_state(std::move(p), std::move(q), SumInternals::min_tier_bits(options));
  if (!placed) return placed;
  SumState state = std::move(placed).value();
  if (const Result<void> done = run(state, options, refine); !done) return done.error();
  return state;
}

Result<SumState> compute_boundary(PlacedPair placed, const SumOptions& options) {
  SumState state(std::move(placed));
  if (const Result<void> done = run(state, options, Refine::where_it_pays); !done) return done.error();
  return state;
}

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

namespace {

// The error of the difference of two extents is this times the sum of both operands' sizes: coordinates (3), their
// differences, what is left and the error taken off, 3 + 1 + 1 + 1 roundings of one extent and 3 + 1 + 1 of the other.
constexpr double kExtents = exact::rounding_bound(11, 128);

// The largest holes tell mostly, by their rounded extents.
bool all_filled(const Lattice& lattice, const Operand& holed, const Operand& other) {
  if (holed.loops.size() == 1) return true;
  const Component &c = holed.components[0], &d = other.components[0];
  const PlacedPoints &a = *lattice.points[holed.op], &b = *lattice.points[other.op];
  const double error = kExtents * (a.width + a.height + b.width + b.height);
  const Loop &widest = holed.loops[c.widest_hole], &tallest = holed.loops[c.tallest_hole], &outer = other.loops[0];
  if (a.x[widest.max_x] - a.x[widest.min_x] < b.x[outer.max_x] - b.x[outer.min_x] - error) return true;
  if (a.y[tallest.max_y] - a.y[tallest.min_y] < b.y[outer.max_y] - b.y[outer.min_y] - error) return true;
  for (std::size_t l = 1; l < holed.loops.size(); ++l)
    if (!hole_is_filled(lattice, holed, holed.loops[l], other, d)) return false;
  return true;
}

}  // namespace

std::optional<SumRing> convex_boundary(const Lattice& lattice, const Operand& p, const Operand& q) {
  for (const Operand* o : {&p, &q})
    if (o->components.size() != 1 || !o->components[0].convex) return std::nullopt;
  if (!all_filled(lattice, p, q) || !all_filled(lattice, q, p)) return std::nullopt;
  const DirectionList& of_p = p.directions[p.component_directions[0][1]];
  const DirectionList& of_q = q.directions[q.component_directions[0][1]];
  const std::size_t n = of_p.edges.size(), m = of_q.edges.size();
  // The next edges of P and Q start at vertices i and j.
  std::uint32_t i = of_p.edges[0], j = of_q.edges[0];
  const auto edge_of_p = [&] { return contact_of({0, i, j}, p, q); };
  const auto edge_of_q = [&] { return contact_of({1, j, i}, p, q); };
  SumRing ring;
  ring.vertices.reserve(n + m);
  Contact last;
  for (std::size_t a = 0, b = 0; a < n || b < m;) {
    const int order = a == n   ? 1
                      : b == m ? -1
                               : compare_directions(lattice, of_p.keys[a], p.edge(i), of_q.keys[b], q.edge(j));
    SumVertex& v = ring.vertices.emplace_back();
    v.in = last;
    v.out = order <= 0 ? edge_of_p() : edge_of_q();
    v.corner_p = p.vertex_index[i];
    v.corner_q = q.vertex_index[j];
    v.at = lattice.to_input(p.x[i] + q.x[j], p.y[i] + q.y[j]);
    last = v.out;
    if (order <= 0) {
      i = p.next[i];
      ++a;
    }
    // Parallel edges run on in one another: the turns are half-open at opposite ends, so P's comes first.
    if (order == 0) last = edge_of_q();
    if (order >= 0) {
      j = q.next[j];
      ++b;
    }
  }
  ring.vertices.front().in = last;
  return ring;
}

}  // namespace dymsum::planar

namespace dymsum {
namespace {

using planar::EngineRegion;
using planar::Operand;
using planar::separate_touching;

Result<PlanarSum> sum_of(std::shared_ptr<const Operand> p, std::shared_ptr<const Operand> q,
                         const SumOptions& options) {
  Result<planar::SumState> state = planar::compute_boundary(std::move(p), std::move(q), options);
  if (!state.ok()) return state.error();
  return planar::finish_sum(std::move(state).value(), options);
}

EngineRegion engine_region(const Region& r) { return separate_touching(r.data(), r.touching_points()); }

std::array<std::uint32_t, 3> group_sizes(const RegionData& r) {
  std::array<std::uint32_t, 3> count{};
  for (const Part& part : r.parts) {
    count[0] += static_cast<std::uint32_t>(part.outer.size());
    for (const Ring& hole : part.holes) count[0] += static_cast<std::uint32_t>(hole.size());
  }
  for (const Polyline& line : r.polylines) count[1] += static_cast<std::uint32_t>(line.size());
  count[2] = static_cast<std::uint32_t>(r.points.size());
  return count;
}

// All regions as one. Region data are numbered parts first, then polylines, then points, so the groups are joined one
// by one.
EngineRegion join(const std::vector<Region>& regions) {
  EngineRegion all;
  for (int group = 0; group < 3; ++group) {
    std::uint32_t first_number = 0;
    for (const Region& region : regions) {
      const EngineRegion r = engine_region(region);
      all.touching |= r.touching;
      const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
      if (group == 0) append(all.own.parts, r.data().parts);
      if (group == 1) append(all.own.polylines, r.data().polylines);
      if (group == 2) append(all.own.points, r.data().points);
      const auto sizes = group_sizes(r.data());
      std::uint32_t at = group == 0 ? 0 : group == 1 ? sizes[0] : sizes[0] + sizes[1];
      for (std::uint32_t k = 0; k < sizes[group]; ++k, ++at) {
        all.vertex_indices.push_back(first_number + r.vertex_index(at));
        all.edge_indices.push_back(first_number + r.edge_index(at));
      }
      first_number += static_cast<std::uint32_t>(region.vertex_count());
    }
  }
  return all;
}

}  // namespace

Result<PlanarSum> minkowski_sum(const Region& p, const Region& q, const SumOptions& options) {
  return sum_of(planar::prepared_operand(p, 0), planar::prepared_operand(q, 1), options);
}

Result<PlanarSum> nfp(const Region& a, const Region& b, const SumOptions& options) {
  return sum_of(planar::prepared_operand(a, 0), planar::prepared_operand(b, 1, true), options);
}

Result<PlanarSum> union_of(const std::vector<Region>& regions, const SumOptions& options) {
  const RegionData origin{{}, {}, {Point{0, 0}}};
  return sum_of(planar::make_operand(join(regions), 0), planar::make_operand(separate_touching(origin, {}), 1),
                options);
}

// Sums of regions and of results.

std::shared_ptr<const planar::Operand> planar::taken_operand(const PlanarOperand& operand, std::uint32_t op,
                                                             bool reflected) {
  if (const Region* const* region = std::get_if<const Region*>(&operand.set()))
    return prepared_operand(**region, op, reflected);
  return make_operand(region_of_result(*std::get<const PlanarSum*>(operand.set())), op, reflected);
}

namespace {

Result<PlanarSum> sum_of(const PlanarOperand& p, const PlanarOperand& q, bool reflected, const SumOptions& options) {
  Result<planar::SumState> state =
      planar::compute_boundary(planar::taken_operand(p, 0), planar::taken_operand(q, 1, reflected), options);
  if (!state) return state.error();
  return planar::finish_sum(std::move(state).value(), options);
}

}  // namespace

Result<PlanarSum> minkowski_sum(const PlanarOperand& p, const PlanarOperand& q, const SumOptions& options) {
  return sum_of(p, q, false, options);
}

Result<PlanarSum> nfp(const PlanarOperand& a, const PlanarOperand& b, const SumOptions& options) {
  return sum_of(a, b, true, options);
}

Result<PlanarSum> minkowski_sum(std::span<const PlanarOperand> sets, const SumOptions& options) {
  if (sets.empty()) return Error{ErrorCode::out_of_range, "a sum takes at least one set, not 0", {}};
  const Result<Region> origin = Region::create({{}, {}, {Point{0, 0}}});
  if (sets.size() == 1) return minkowski_sum(sets[0], *origin, options);
  SumOptions between = options;
  between.semantics = Semantics::closed;
  between.trace = false;
  std::optional<PlanarSum> sum;
  for (std::size_t k = 1; k < sets.size(); ++k) {
    const PlanarOperand& first = k == 1 ? sets[0] : PlanarOperand(*sum);
    Result<PlanarSum> next = minkowski_sum(first, sets[k], k + 1 == sets.size() ? options : between);
    if (!next) return next;
    sum = std::move(next).value();
  }
  return *std::move(sum);
}

}  // namespace dymsum
