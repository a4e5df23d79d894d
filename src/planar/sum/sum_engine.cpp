#include "planar/sum/sum_engine.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <new>
#include <stdexcept>
#include <string>

#include "planar/arrangement/live_pieces.h"
#include "planar/arrangement/live_segments.h"
#include "planar/result/part_nesting.h"
#include "planar/result/pieces.h"
#include "planar/sum/convex_boundary.h"
#include "planar/sum/winding.h"

namespace dymsum::planar {
namespace {

// Reading the clock takes as long as a stage of a small sum.
bool timed(const Operand& p, const Operand& q) { return p.size() + q.size() > 100; }

class StageClock {
 public:
  StageClock(SumStats& stats, bool runs) : stats_(stats), runs_(runs) {
    if (runs) last_ = std::chrono::steady_clock::now();
  }
  void done(std::string_view name) {
    if (!runs_) return;
    const auto now = std::chrono::steady_clock::now();
    stats_.stages.push_back({name, std::chrono::duration<double, std::milli>(now - last_).count()});
    last_ = now;
  }

 private:
  SumStats& stats_;
  bool runs_;
  std::chrono::steady_clock::time_point last_;
};

// Chains of the reduced convolution; segments behind `reduced` (parallelogram sides) have no chain and meet by
// coincidence.
class ReducedChain final : public Chain {
 public:
  ReducedChain(const Soup& soup, const ReducedConvolution& convolution, Array<std::uint32_t> live,
               std::uint32_t reduced)
      : Chain(soup.memory), soup_(soup), convolution_(convolution), live_(std::move(live)), reduced_(reduced) {
    next_.resize(soup.size(), kNone);
    if (live_.empty()) {
      convolution.fill_next({next_.data(), reduced});
      return;
    }
    const std::uint32_t n = convolution.size();
    if (reduced > n / 3) {
      Array<std::uint32_t> next(n, soup.memory);
      convolution.fill_next(next);
      // The first id of a segment made it; segments are in the order of these ids.
      for (std::uint32_t id = 0, s = 0; s < reduced; ++id)
        if (live_[id] == s) next_[s++] = this->live(next[id]);
      return;
    }
    for (std::uint32_t s = 0; s < reduced; ++s) {
      const SoupSegment& g = soup.segments[s];
      next_[s] = this->live(convolution.next({g.side(), g.edge(), g.vertex}));
    }
  }
  void incident(WalkPair v, Array<Incidence>& out) const override {
    const Operand &p = *soup_.operands[0], &q = *soup_.operands[1];
    add(convolution_.find(0, v.p, v.q), true, out);
    add(convolution_.find(1, v.q, v.p), true, out);
    add(convolution_.find(0, p.prev[v.p], v.q), false, out);
    add(convolution_.find(1, q.prev[v.q], v.p), false, out);
    for (std::uint32_t s = reduced_; s < soup_.size(); ++s) {
      if (soup_.start(s) == v) out.push_back({s, true});
      if (soup_.end(s) == v) out.push_back({s, false});
    }
  }

 private:
  std::uint32_t live(std::uint32_t id) const {
    if (id == kNoRank) return kNone;
    return live_.empty() ? id : live_[id];
  }
  void add(std::uint32_t id, bool starts, Array<Incidence>& out) const {
    if (const std::uint32_t s = live(id); s != kNone) out.push_back({s, starts});
  }

  const Soup& soup_;
  const ReducedConvolution& convolution_;
  Array<std::uint32_t> live_;  // id -> segment of the soup; empty: the identity
  std::uint32_t reduced_;
};

// The sides of the parallelograms of every pair of edges of two components without area, counter-clockwise.
void add_parallelograms(const Lattice& lattice, const Operand& p, const Operand& q, Soup& soup) {
  for (const Component& cp : p.components)
    for (const Component& cq : q.components) {
      if (cp.dimension != 1 || cq.dimension != 1) continue;
      for (std::uint32_t e = cp.first; e < cp.last; ++e)
        for (std::uint32_t f = cq.first; f < cq.last; ++f) {
          if (lattice.cross(p.edge(e), q.edge(f)) <= 0) continue;
          for (const WalkSegment& w : {WalkSegment{0, e, f}, WalkSegment{1, f, p.next[e]}}) soup.add(w, soup.box(w));
        }
    }
}

bool has_dimension_below_two(const Operand& o) {
  return std::any_of(o.components.begin(), o.components.end(), [](const Component& c) { return c.dimension < 2; });
}

// Below this many segments meeting twins cost less than finding them.
constexpr std::size_t kMerge = 24;
// Below this many segments a mask does not pay.
constexpr std::size_t kMask = 400;

// A sweep is cheaper than filling a grid for few segments, and for more of them while each has not too many others
// above and below it: as many as widths of segments add up to that of the sum.
bool sweep_pays(const Soup& soup) {
  constexpr std::size_t kFew = 4000;
  constexpr double kBeside = 250;
  if (soup.size() < kFew) return true;
  double widths = 0;
  for (const SoupBox& b : soup.boxes) widths += std::abs(b.dx);
  return widths < kBeside * soup.lattice.span;
}

// Cells along the longer side for n segments: finer grids cost more in the mask than they save in pairs.
constexpr double kCellsPerRoot = 2;
int cells_for(std::size_t n) {
  return std::clamp(static_cast<int>(kCellsPerRoot * std::sqrt(static_cast<double>(n))), 8, 1024);
}

Grid plain_grid(const Lattice& lattice, std::size_t n) {
  const double width = lattice.points[0]->width + lattice.points[1]->width;
  const double height = lattice.points[0]->height + lattice.points[1]->height;
  const double longer = std::max(width, height);
  Grid g;
  const int cells = cells_for(n);
  g.cell = longer / cells;
  g.per_cell = cells / longer;
  g.columns = static_cast<int>(width * g.per_cell) + 1;
  g.rows = static_cast<int>(height * g.per_cell) + 1;
  return g;
}

void trace_stages(const Soup& soup, const InteriorMask* mask, const Arrangement& arrangement, const SortedLoops& loops,
                  const ReducedConvolution& convolution, PlanarTrace& trace) {
  const Lattice& lattice = soup.lattice;
  convolution.for_each([&](const WalkSegment& w) {
    const SoupBox b = soup.box(w);
    trace.convolution.push_back({lattice.to_input(b.ax, b.ay), lattice.to_input(b.bx, b.by), w.side == 0});
  });
  if (mask != nullptr)
    for (int r = 0; r < mask->grid().rows; ++r)
      for (int c = 0; c < mask->grid().columns; ++c) {
        if (!mask->dead(r, c)) continue;
        const int first = c;
        while (c + 1 < mask->grid().columns && mask->dead(r, c + 1)) ++c;
        const double h = mask->grid().cell;
        trace.masked_cells.push_back({lattice.to_input(first * h, r * h), lattice.to_input((c + 1) * h, (r + 1) * h)});
      }
  for (const Crossing& c : arrangement.crossings()) {
    const SoupBox& b = soup.boxes[c.a];
    trace.crossings.push_back(lattice.to_input(b.ax + c.ta * (b.bx - b.ax), b.ay + c.ta * (b.by - b.ay)));
  }
  const auto ring = [&](const BoundaryLoop& loop) {
    Ring r;
    for (const Step& step : loop.steps) {
      const Place p = arrangement.end_place(step);
      r.push_back(lattice.to_input(p.x, p.y));
    }
    return r;
  };
  for (const BoundaryLoop& loop : loops.kept) trace.kept_loops.push_back(ring(loop));
  for (const BoundaryLoop& loop : loops.dropped) trace.dropped_loops.push_back(ring(loop));
}

// Cracks and punctures: candidates of the arrangement that are not inside the open sum.
// A sector that no segment covers may still lie inside: where a chain ends at a reflex vertex its contact covers more
// than the half discs of its segments. So every node off the boundary is tested, not only those whose sectors are all
// covered.
void find_tight(const Soup& soup, const Arrangement& arrangement, const Array<BoundaryLoop>& kept, Collision& collision,
                RawBoundary& out, double& grid_error, const Poll* poll) {
  const std::size_t rounds = arrangement.covered_subs().size() + arrangement.nodes().size();
  std::size_t round = 0;
  if (arrangement.nodes().empty()) return;
  Array<std::uint8_t> on_boundary(arrangement.degenerate_nodes() + 1, 0, soup.memory);
  for (const BoundaryLoop& loop : kept)
    for (const Step& step : loop.steps)
      if (const std::uint32_t node = arrangement.end_node(step); node != kNone) on_boundary[node] = 1;
  for (const Step& step : arrangement.covered_subs()) {
    if (poll != nullptr) poll->at_test(round++, rounds);
    if (collision.overlaps(arrangement.sample(step))) continue;
    const Place from = arrangement.start_place(step), to = arrangement.end_place(step);
    const SubEnd a = arrangement.start_of(step), b = arrangement.end_of(step);
    grid_error = std::max({grid_error, position_error(soup, from), position_error(soup, to)});
    const std::uint32_t s = step.segment;
    out.cracks.push_back(
        {vertex_of(soup, s, a.pair ? s : a.other, a, from), vertex_of(soup, s, b.pair ? s : b.other, b, to)});
  }
  for (const Arrangement::Node& node : arrangement.nodes()) {
    if (poll != nullptr) poll->at_test(round++, rounds);
    if (on_boundary[node.number] != 0) continue;
    const Place place = arrangement.place_of(node);
    if (collision.overlaps(place)) continue;
    grid_error = std::max(grid_error, position_error(soup, place));
    out.punctures.push_back(
        vertex_of(soup, node.segment, node.end.pair ? node.segment : node.end.other, node.end, place));
  }
}

// One component each, at least one of them with interior: then the open sum is connected.
bool connected_sum(const Operand& op, const Operand& oq) {
  return op.components.size() == 1 && oq.components.size() == 1 &&
         (op.components[0].dimension == 2 || oq.components[0].dimension == 2);
}

// Convex operands: see convex_boundary.
bool run_convex(const SumOptions& options, SumState& state, Poll& poll) {
  if (options.engine != Engine::fast || options.trace) return false;
  StageClock clock(state.stats, timed(*state.p, *state.q));
  std::optional<SumRing> ring = convex_boundary(*state.lattice, *state.p, *state.q);
  if (!ring) return false;
  state.stats.reduced_segments = state.p->loops[0].last + state.q->loops[0].last;
  state.stats.live_segments = state.stats.reduced_segments;
  state.stats.loops = 1;
  state.boundary.at_error = input_error(*state.lattice, sum_error(*state.lattice));
  state.boundary.rings.push_back(*std::move(ring));
  state.boundary.outer.push_back(1);
  clock.done("convolution");
  poll.stage("convolution");
  poll(1);
  return true;
}

void run_reduced(const SumOptions& options, SumState& state, Refine when, Poll& poll) {
  const Lattice& lattice = *state.lattice;
  const Operand &op = *state.p, &oq = *state.q;
  SumStats& stats = state.stats;
  StageClock clock(stats, timed(op, oq));
  const std::function<bool(double)> asked = [&](double share) {
    poll(share);
    return true;
  };
  Scratch scratch;
  poll.stage("convolution");
  const ReducedConvolution convolution(lattice, op, oq, &scratch);
  const std::uint32_t n = convolution.size();
  stats.reduced_segments = n;
  clock.done("directions");
  const bool fast = options.engine == Engine::fast;
  std::optional<InteriorMask> mask;
  if (fast && (n >= kMask || (n > 0 && when == Refine::always))) {
    poll.stage("mask");
    mask.emplace(op, oq, cells_for(n));
    stats.mask_grid = cells_for(n);
    clock.done("mask");
  }
  poll.stage("segments");
  Soup soup(lattice, op, oq, &scratch);
  const bool merge = fast && n >= kMerge && convolution.parallel_edges() * 8 > op.size() + oq.size();
  Array<std::uint32_t> live(&scratch);
  if (mask || merge)
    live = add_live(convolution, mask ? &*mask : nullptr, merge ? Twins::merged : Twins::kept, soup, poll);
  else soup.add(convolution);
  clock.done("convolution");
  const bool closed = options.semantics != Semantics::open;
  const bool parallelograms = closed && has_dimension_below_two(op) && has_dimension_below_two(oq);
  std::optional<Refined> refined;
  if (mask && !parallelograms) {  // whose sides are in no cell
    poll.stage("refinement");
    refined = refine(op, oq, *mask, soup, live, when, poll);
    if (refined) clock.done("refinement");
  }
  const FineCells* const fine = refined ? &refined->cells : nullptr;
  if (refined && refined->fine) stats.mask_grid *= kBrick;
  const std::uint32_t reduced_live = static_cast<std::uint32_t>(soup.size());
  if (parallelograms) add_parallelograms(lattice, op, oq, soup);
  const ReducedChain chain(soup, convolution, std::move(live), reduced_live);
  stats.live_segments = soup.size();
  clock.done("chains");

  Meetings meetings(&scratch);
  Array<DeadMark> marks(&scratch);
  {
    CrossingFinder finder(soup, meetings, &chain);
    poll.stage("crossings");
    finder.poll = &asked;
    finder.first_unchained = reduced_live;
    if (!fast) finder.all_pairs();
    else if (fine != nullptr) {
      finder.sweep(refined->live.pieces, kReach / 2 * fine->grid().cell);
      marks = std::move(refined->live.marks);
    } else if (sweep_pays(soup)) finder.sweep(mask ? &*mask : nullptr);
    else finder.grid(mask ? mask->grid() : plain_grid(lattice, soup.size()), mask ? &*mask : nullptr, marks);
  }
  stats.crossings = meetings.crossings.size();
  stats.cell_entries = meetings.cell_entries;
  stats.pair_tests = meetings.pair_tests;
  stats.exact_signs += meetings.exact_signs;
  clock.done("crossings");

  poll.stage("arrangement");
  const Arrangement arrangement(soup, std::move(meetings), chain, marks, &poll);
  stats.degenerate_nodes = arrangement.degenerate_nodes();
  stats.exact_signs += arrangement.exact_orders();
  clock.done("arrangement");

  poll.stage("loops");
  Array<BoundaryLoop> loops = find_loops(soup, arrangement, &poll);
  stats.loops = loops.size();
  clock.done("loops");

  poll.stage("collision");
  Collision collision(lattice, op, oq, fast);
  collision.with_parallelograms = parallelograms;
  const bool connected = fast && !parallelograms && connected_sum(op, oq);
  SortedLoops sorted =
      verify_loops(soup, arrangement, std::move(loops), collision, connected, {mask ? &*mask : nullptr, fine, &poll});
  clock.done("collision");
  if (state.trace) trace_stages(soup, mask ? &*mask : nullptr, arrangement, sorted, convolution, *state.trace);
  double grid_error = soup.point_error;
  if (options.semantics != Semantics::regular && !parallelograms)
    find_tight(soup, arrangement, sorted.kept, collision, state.boundary, grid_error, &poll);
  clock.done("tight");
  for (const BoundaryLoop& ring : simple_rings(soup, arrangement, std::move(sorted.kept))) {
    state.boundary.rings.push_back(make_ring(soup, arrangement, ring, grid_error));
    state.boundary.outer.push_back(ring.turning > 0);
  }
  state.boundary.at_error = input_error(lattice, grid_error);
  stats.collision_tests = collision.counts().tests;
  stats.filtered_signs += collision.counts().filtered;
  stats.exact_signs += collision.counts().exact;
  stats.peak_bytes = scratch.peak_bytes() + (mask ? mask->bytes() : 0) + (fine != nullptr ? fine->bytes() : 0);
  clock.done("rings");
  poll(1);
}

void run_engine(const SumOptions& options, SumState& state, Refine when, Poll& poll) {
  if (state.p->size() == 0 || state.q->size() == 0) return;
  if (run_convex(options, state, poll)) return;
  if (options.engine == Engine::winding) {
    if (!run_winding(options, state)) throw Cancelled{};
  } else {
    run_reduced(options, state, when, poll);
  }
}

Error no_room(const SumState& state, std::string_view stage, std::string_view reason) {
  const auto text = [](std::uint64_t n) { return std::to_string(n); };
  std::string message = "the sum of " + text(state.p->size()) + " and " + text(state.q->size()) +
                        " vertices is too large: " + std::string(reason);
  if (!stage.empty()) message += " in the stage '" + std::string(stage) + "'";
  if (state.stats.reduced_segments > 0) message += ", " + text(state.stats.reduced_segments) + " segments";
  if (state.stats.live_segments > 0) message += ", " + text(state.stats.live_segments) + " of them to be intersected";
  if (state.stats.crossings > 0) message += ", " + text(state.stats.crossings) + " crossings";
  return {ErrorCode::unsupported_operand, message, {}};
}

// The chosen engine.
std::optional<Error> run(SumState& state, const SumOptions& options, Refine when = Refine::where_it_pays) {
  if (options.trace) state.trace = std::make_unique<PlanarTrace>();
  Poll poll(options.progress);
  try {
    run_engine(options, state, when, poll);
  } catch (const Cancelled&) {
    return Error{ErrorCode::cancelled, "stopped on request", {}};
  } catch (const std::bad_alloc&) {
    return no_room(state, poll.stage(), "out of memory");
  } catch (const std::length_error& more) {
    return no_room(state, poll.stage(), more.what());
  }
  return std::nullopt;
}

}  // namespace

void find_tight_features(const Soup& soup, const Arrangement& arrangement, const Array<BoundaryLoop>& kept,
                         Collision& collision, RawBoundary& out, double& grid_error) {
  find_tight(soup, arrangement, kept, collision, out, grid_error, nullptr);
}

Result<SumState> compute_boundary(std::shared_ptr<const Operand> p, std::shared_ptr<const Operand> q,
                                  const SumOptions& options, Refine refine) {
  SumState state;
  StageClock clock(state.stats, timed(*p, *q));
  for (const Operand* o : {p.get(), q.get()})
    if (std::optional<Error> error = too_large(*o)) return *std::move(error);
  state.lattice = make_lattice(p->points, q->points, planar::SumInternals::min_tier_bits(options));
  state.p = placed_on(*state.lattice, std::move(p));
  state.q = placed_on(*state.lattice, std::move(q));
  state.stats.tier_bits = state.lattice->tier_bits;
  clock.done("operands");
  if (std::optional<Error> error = run(state, options, refine)) return *std::move(error);
  return state;
}

Result<SumState> compute_boundary(SumState state, const SumOptions& options) {
  if (std::optional<Error> error = run(state, options)) return *std::move(error);
  return state;
}

void lower_dimensional_candidates(const Lattice& lattice, const Operand& p, const Operand& q,
                                  std::vector<SumSegment>& segments, std::vector<SumVertex>& points) {
  const auto corner = [&](std::uint32_t i, std::uint32_t j, const Contact& line) {
    SumVertex v;
    v.in = v.out = line;
    v.corner_p = p.vertex_number[i];
    v.corner_q = q.vertex_number[j];
    v.at = lattice.to_input(p.x[i] + q.x[j], p.y[i] + q.y[j]);
    return v;
  };
  const auto of_p = [&](std::uint32_t e, std::uint32_t j) {
    return Contact{Contact::Kind::edge_of_p, p.edge_number[e], q.vertex_number[j]};
  };
  const auto of_q = [&](std::uint32_t i, std::uint32_t f) {
    return Contact{Contact::Kind::edge_of_q, p.vertex_number[i], q.edge_number[f]};
  };
  for (const Component& cp : p.components)
    for (const Component& cq : q.components) {
      if (cp.dimension == 2 || cq.dimension == 2) continue;
      for (std::uint32_t i = cp.first; i < cp.last; ++i)
        for (std::uint32_t j = cq.first; j < cq.last; ++j) {
          if (cp.dimension == 0 && cq.dimension == 0) {
            points.push_back(corner(i, j, {}));
          } else if (cp.dimension == 0) {
            segments.push_back({corner(i, j, of_q(i, j)), corner(i, q.next[j], of_q(i, j))});
          } else if (cq.dimension == 0) {
            segments.push_back({corner(i, j, of_p(i, j)), corner(p.next[i], j, of_p(i, j))});
          } else if (lattice.cross(p.edge(i), q.edge(j)) == 0 && lattice.dot(p.edge(i), q.edge(j)) > 0) {
            // Edge by edge, so that every piece lies on its contact.
            segments.push_back({corner(i, j, of_p(i, j)), corner(p.next[i], j, of_p(i, j))});
            segments.push_back(
                {corner(p.next[i], j, of_q(p.next[i], j)), corner(p.next[i], q.next[j], of_q(p.next[i], j))});
          }
        }
    }
}

void merge_pieces(const SumSource& source, const std::vector<SumPart>& parts, const std::vector<SumSegment>& candidates,
                  const std::vector<SumVertex>& candidate_points, std::vector<SumSegment>& segments,
                  std::vector<SumVertex>& points) {
  std::vector<std::vector<Position>> rings;
  std::vector<const SumRing*> ring_of;
  for (const SumPart& part : parts) {
    ring_of.push_back(&part.outer);
    for (const SumRing& hole : part.holes) ring_of.push_back(&hole);
  }
  for (const SumRing* ring : ring_of) {
    rings.emplace_back();
    for (const SumVertex& v : ring->vertices) rings.back().push_back(source.position(v));
  }
  std::vector<PieceCandidate> lines;
  std::vector<Position> spots;
  for (const SumSegment& s : candidates) lines.push_back({source.position(s.from), source.position(s.to)});
  for (const SumVertex& v : candidate_points) spots.push_back(source.position(v));
  const Pieces pieces = lower_dimensional_pieces(rings, lines, spots);
  const auto vertex = [&](const PieceEnd& end) {
    if (end.cut_ring == PieceEnd::kNone) {
      const bool is_a = compare(end.at, lines[end.candidate].a) == 0;
      return is_a ? candidates[end.candidate].from : candidates[end.candidate].to;
    }
    SumVertex v;
    v.in = candidates[end.candidate].from.in;
    const SumRing& ring = *ring_of[end.cut_ring];
    const SumVertex &from = ring.vertices[end.cut_edge], &to = ring.vertices[(end.cut_edge + 1) % ring.vertices.size()];
    v.out = source.contact_at(from.out, to.in, end.at);
    v.at = {exact::round_to_double(end.at.x), exact::round_to_double(end.at.y)};
    return v;
  };
  for (const PieceSegment& s : pieces.segments) segments.push_back({vertex(s.from), vertex(s.to)});
  for (const PiecePoint& p : pieces.points) points.push_back(candidate_points[p.candidate]);
}

PlanarSum finish_sum(SumState&& state, const SumOptions& options) {
  PlanarSum sum;
  StageClock clock(state.stats, timed(*state.p, *state.q));
  RawBoundary& raw = state.boundary;
  std::vector<SumSegment> lines;
  std::vector<SumVertex> points;
  if (options.semantics == Semantics::closed)
    lower_dimensional_candidates(*state.lattice, *state.p, *state.q, lines, points);
  const auto source = std::make_shared<SumSource>(state.lattice, std::move(state.p), std::move(state.q));
  exact_source(sum) = source;
  sum.parts = group_rings(std::move(raw.rings), raw.outer, *source, raw.at_error);
  canonicalize(sum.parts, *source, raw.at_error);
  if (!raw.cracks.empty() || !raw.punctures.empty())
    merge_pieces(*source, {}, raw.cracks, raw.punctures, sum.tight_segments, sum.tight_points);
  if (!lines.empty() || !points.empty()) merge_pieces(*source, sum.parts, lines, points, sum.segments, sum.points);
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
