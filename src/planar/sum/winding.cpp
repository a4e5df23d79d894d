#include "planar/sum/winding.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <optional>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "planar/arrangement/crossings.h"
#include "planar/arrangement/segment_graph.h"
#include "planar/boundary/boundary.h"
#include "planar/boundary/collision.h"
#include "planar/boundary/winding_numbers.h"
#include "planar/convolution/kinetic.h"

namespace dymsum::planar {
namespace {

using Edge = SegmentGraph::Edge;
using Ray = SegmentGraph::Ray;

// The parallelograms of all pairs of edges of two components without area: polylines are walked there and back, so that
// the two sides added for (e, f) meet the two added for the backward edges.
void add_parallelograms(const Lattice& lattice, const Operand& p, const Operand& q, Tracing& tracing) {
  for (const Component& cp : p.components)
    for (const Component& cq : q.components) {
      if (cp.dimension != 1 || cq.dimension != 1) continue;
      for (std::uint32_t e = cp.first; e < cp.last; ++e)
        for (std::uint32_t f = cq.first; f < cq.last; ++f) {
          if (lattice.cross(p.edge(e), q.edge(f)) <= 0) continue;
          tracing.add({0, e, f}, 1);
          tracing.add({1, f, p.next[e]}, 1);
        }
    }
}

// An edge of the boundary with interior on its left.
struct BoundaryEdge {
  std::uint32_t from = 0, to = 0, segment = 0;
};

class Boundary {
 public:
  Boundary(const Tracing& tracing, const SegmentGraph& graph, const std::vector<Sides>& sides)
      : tracing_(tracing), graph_(graph), sides_(sides) {}

  /// Simple rings, edge by edge.
  std::vector<std::vector<BoundaryEdge>> rings() const {
    std::vector<std::uint32_t> next(graph_.edges().size(), kNone);
    for (std::uint32_t v = 0; v < graph_.nodes().size(); ++v) link(v, next);
    std::vector<std::vector<BoundaryEdge>> out;
    std::vector<std::uint8_t> seen(next.size(), 0);
    for (std::uint32_t start = 0; start < next.size(); ++start) {
      if (next[start] == kNone || seen[start]) continue;
      std::vector<BoundaryEdge> path;
      std::unordered_map<std::uint32_t, std::size_t> at;  // node -> edges of the path before it
      for (std::uint32_t e = start; !seen[e]; e = next[e]) {
        seen[e] = 1;
        path.push_back(oriented(e));
        at.try_emplace(path.back().from, path.size() - 1);
        const auto meets = at.find(path.back().to);
        if (meets == at.end()) continue;
        // The path is back at a node: cut off the ring between.
        const std::size_t first = meets->second;
        out.emplace_back(path.begin() + static_cast<std::ptrdiff_t>(first), path.end());
        for (const BoundaryEdge& b : out.back()) at.erase(b.from);
        path.resize(first);
      }
    }
    return out;
  }

  SumRing ring(const std::vector<BoundaryEdge>& edges, double& error) const {
    SumRing ring;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const BoundaryEdge &in = edges[i], &out = edges[(i + 1) % edges.size()];
      if (tracing_.soup.cross(in.segment, out.segment) == 0) continue;  // straight on
      const SegmentGraph::Node& node = graph_.nodes()[in.to];
      error = std::max(error, position_error(tracing_.soup, node.place));
      ring.vertices.push_back(vertex_of(tracing_.soup, in.segment, out.segment, node.end, node.place));
    }
    return ring;
  }

  /// How often the direction of a ring passes +x counter-clockwise is 1 for a counter-clockwise one, -1 otherwise.
  bool counter_clockwise(const std::vector<BoundaryEdge>& ring) const {
    const Soup& soup = tracing_.soup;
    const auto upper = [&](std::uint32_t s) { return soup.dy(s) > 0 || (soup.dy(s) == 0 && soup.dx(s) > 0); };
    int turns = 0;
    std::uint32_t last = ring.back().segment;
    for (const BoundaryEdge& e : ring) {
      const int turn = soup.cross(last, e.segment);
      if (turn > 0 && !upper(last) && upper(e.segment)) ++turns;
      if (turn < 0 && upper(last) && !upper(e.segment)) --turns;
      last = e.segment;
    }
    return turns > 0;
  }

 private:
  bool on_boundary(std::uint32_t edge) const { return (sides_[edge].left > 0) != (sides_[edge].right > 0); }
  bool leaves(const Ray& r) const { return r.forward == (sides_[r.edge].left > 0); }

  // Interior pairing: what comes in goes on with the next ray clockwise, across the interior.
  void link(std::uint32_t node, std::vector<std::uint32_t>& next) const {
    std::vector<Ray> rays;
    for (const Ray& r : graph_.rays(node))
      if (on_boundary(r.edge)) rays.push_back(r);
    for (std::size_t i = 0; i < rays.size(); ++i)
      if (!leaves(rays[i])) next[rays[i].edge] = rays[(i + rays.size() - 1) % rays.size()].edge;
  }

  // Named by a segment that bounds the sum there: one that is counted positively and runs the same way.
  BoundaryEdge oriented(std::uint32_t edge) const {
    const Edge& e = graph_.edges()[edge];
    const bool forward = sides_[edge].left > 0;
    BoundaryEdge out{forward ? e.low : e.high, forward ? e.high : e.low, kNone};
    for (std::uint32_t k = e.first; k < e.last; ++k) {
      const SegmentGraph::SubEdge& s = graph_.sub_edges()[k];
      if (tracing_.signs[s.segment] > 0 && SegmentGraph::forward(e, s) == forward)
        out.segment = std::min(out.segment, s.segment);
    }
    if (out.segment == kNone)
      throw std::logic_error("winding numbers: a boundary edge without a segment that bounds it");
    return out;
  }

  const Tracing& tracing_;
  const SegmentGraph& graph_;
  const std::vector<Sides>& sides_;
};

// Where the open sum can have cracks: edges inside that carry positive segments in both directions.
bool may_be_crack(const Tracing& tracing, const SegmentGraph& graph, const Sides& sides, const Edge& e) {
  if (sides.left <= 0 || sides.right <= 0) return false;
  bool ahead = false, back = false;
  for (std::uint32_t k = e.first; k < e.last; ++k) {
    const SegmentGraph::SubEdge& s = graph.sub_edges()[k];
    if (tracing.signs[s.segment] > 0) (SegmentGraph::forward(e, s) ? ahead : back) = true;
  }
  return ahead && back;
}

// Where it can have punctures: nodes inside with at least three segments. Two contacts leave a way out.
bool may_be_puncture(const SegmentGraph& graph, const std::vector<Sides>& sides, std::uint32_t node) {
  if (graph.nodes()[node].passes < 3) return false;
  const auto rays = graph.rays(node);
  return std::all_of(rays.begin(), rays.end(),
                     [&](const Ray& r) { return sides[r.edge].left > 0 && sides[r.edge].right > 0; });
}

void find_tight(const Tracing& tracing, const SegmentGraph& graph, const std::vector<Sides>& sides,
                Collision& collision, RawBoundary& out, double& error) {
  const Soup& soup = tracing.soup;
  const auto vertex = [&](std::uint32_t node, std::uint32_t segment) {
    const SegmentGraph::Node& v = graph.nodes()[node];
    error = std::max(error, position_error(soup, v.place));
    if (v.end.pair) return vertex_of(soup, segment, segment, v.end, v.place);
    const bool parallel = soup.cross(segment, v.segment) == 0;
    return vertex_of(soup, segment, parallel ? v.end.other : v.segment, v.end, v.place);
  };
  for (std::uint32_t i = 0; i < graph.edges().size(); ++i) {
    const Edge& e = graph.edges()[i];
    if (!may_be_crack(tracing, graph, sides[i], e) || collision.overlaps(graph.sample(i))) continue;
    const std::uint32_t segment = graph.sub_edges()[e.first].segment;
    out.cracks.push_back({vertex(e.low, segment), vertex(e.high, segment)});
  }
  for (std::uint32_t v = 0; v < graph.nodes().size(); ++v)
    if (may_be_puncture(graph, sides, v) && !collision.overlaps(graph.nodes()[v].place))
      out.punctures.push_back(
          vertex(v, graph.nodes()[v].end.pair ? graph.nodes()[v].segment : graph.nodes()[v].end.other));
}

void trace_stages(const Soup& soup, const SegmentGraph& graph, const std::vector<std::vector<BoundaryEdge>>& rings,
                  PlanarTrace& trace) {
  const Lattice& lattice = soup.lattice;
  const auto at = [&](std::uint32_t node) {
    const Place& x = graph.nodes()[node].place;
    return lattice.to_input(x.x, x.y);
  };
  for (std::uint32_t s = 0; s < soup.size(); ++s) {
    const SoupBox& b = soup.boxes[s];
    trace.convolution.push_back(
        {lattice.to_input(b.ax, b.ay), lattice.to_input(b.bx, b.by), soup.segments[s].side() == 0});
  }
  for (std::uint32_t v = 0; v < graph.nodes().size(); ++v)
    if (!graph.nodes()[v].end.pair) trace.crossings.push_back(at(v));
  for (const auto& ring : rings) {
    trace.kept_loops.emplace_back();
    for (const BoundaryEdge& e : ring) trace.kept_loops.back().push_back(at(e.to));
  }
}

bool thin(const Operand& o) {
  return std::any_of(o.components.begin(), o.components.end(), [](const Component& c) { return c.dimension < 2; });
}

Tracing make_tracing(SumState& state, bool parallelograms) {
  Tracing tracing(*state.lattice, *state.p, *state.q);
  for (const KineticSegment& s : kinetic_convolution(*state.lattice, *state.p, *state.q)) tracing.add(s.walk, s.sign);
  state.stats.reduced_segments = tracing.soup.size();
  if (parallelograms) add_parallelograms(*state.lattice, *state.p, *state.q, tracing);
  state.stats.live_segments = tracing.soup.size();
  state.stats.peak_bytes =
      tracing.soup.segments.capacity() * sizeof(SoupSegment) + tracing.soup.boxes.capacity() * sizeof(SoupBox);
  return tracing;
}

// Nothing when stopped on request.
std::optional<Meetings> find_meetings(const Soup& soup, const SumOptions& options, SumStats& stats) {
  Meetings meetings(soup.memory);
  CrossingFinder finder(soup, meetings);
  const std::function<bool(double)> poll = [&](double share) {
    return !options.progress || options.progress("crossings", share);
  };
  finder.poll = &poll;
  finder.all_pairs();
  if (finder.stopped) return std::nullopt;
  stats.crossings = meetings.crossings.size();
  stats.pair_tests = meetings.pair_tests;
  stats.exact_signs += meetings.exact_signs;
  return meetings;
}

}  // namespace

bool run_winding(const SumOptions& options, SumState& state) {
  SumStats& stats = state.stats;
  auto last = std::chrono::steady_clock::now();
  const auto done = [&](std::string_view name) {
    const auto now = std::chrono::steady_clock::now();
    stats.stages.push_back({name, std::chrono::duration<double, std::milli>(now - last).count()});
    last = now;
    return !options.progress || options.progress(name, 1);
  };
  const bool parallelograms = options.semantics != Semantics::open && thin(*state.p) && thin(*state.q);
  const Tracing tracing = make_tracing(state, parallelograms);
  const Soup& soup = tracing.soup;
  if (!done("convolution")) return false;

  std::optional<Meetings> meetings = find_meetings(soup, options, stats);
  if (!meetings || !done("crossings")) return false;

  const SegmentGraph graph(soup, *std::move(meetings));
  stats.exact_signs += graph.exact_orders();
  for (const SegmentGraph::Node& v : graph.nodes()) stats.degenerate_nodes += v.passes > 2;
  if (!done("arrangement")) return false;

  const std::vector<Sides> sides = find_windings(tracing, graph);
  if (!done("windings")) return false;

  const Boundary boundary(tracing, graph, sides);
  const std::vector<std::vector<BoundaryEdge>> rings = boundary.rings();
  stats.loops = rings.size();
  double error = soup.point_error;
  for (const auto& ring : rings) {
    state.boundary.rings.push_back(boundary.ring(ring, error));
    state.boundary.outer.push_back(boundary.counter_clockwise(ring));
  }
  if (state.trace) trace_stages(soup, graph, rings, *state.trace);
  if (!done("loops")) return false;

  if (options.semantics != Semantics::regular && !parallelograms) {
    Collision collision(*state.lattice, *state.p, *state.q, false);
    find_tight(tracing, graph, sides, collision, state.boundary, error);
    stats.collision_tests = collision.counts().tests;
    stats.filtered_signs += collision.counts().filtered;
    stats.exact_signs += collision.counts().exact;
  }
  state.boundary.at_error = input_error(*state.lattice, error);
  stats.peak_bytes += graph.bytes();
  return done("tight");
}

}  // namespace dymsum::planar
