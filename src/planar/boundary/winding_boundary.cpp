#include "planar/boundary/winding_boundary.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <unordered_map>

#include "planar/arrangement/segment_graph.h"
#include "planar/boundary/boundary.h"

namespace dymsum::planar {
namespace {

// Left minus right of every edge.
std::vector<int> jumps(const Tracing& tracing, const SegmentGraph& graph) {
  const auto& edges = graph.edges();
  std::vector<int> jump(edges.size(), 0);
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::uint32_t k = edges[i].first; k < edges[i].last; ++k) {
      const SegmentGraph::SubEdge& s = graph.sub_edges()[k];
      jump[i] += SegmentGraph::forward(edges[i], s) ? tracing.signs[s.segment] : -tracing.signs[s.segment];
    }
  return jump;
}

}  // namespace

std::vector<Sides> find_windings(const Tracing& tracing, const SegmentGraph& graph) {
  const auto& edges = graph.edges();
  const std::vector<int> jump = jumps(tracing, graph);
  std::vector<Sides> sides(edges.size());
  std::vector<std::uint8_t> known(edges.size(), 0);
  std::vector<std::uint32_t> open;  // nodes with a known edge
  std::vector<std::uint8_t> done(graph.nodes().size(), 0);
  const RayRows rows(tracing.soup);
  const auto set_right = [&](const SegmentGraph::Ray& ray, int right) {
    const Sides found = ray.forward ? Sides{right + jump[ray.edge], right} : Sides{right, right - jump[ray.edge]};
    if (known[ray.edge] && !(sides[ray.edge] == found))
      throw std::logic_error("winding numbers: the tracing is not closed");
    sides[ray.edge] = found;
    known[ray.edge] = 1;
    const SegmentGraph::Edge& e = edges[ray.edge];
    for (const std::uint32_t v : {e.low, e.high})
      if (!done[v]) {
        done[v] = 1;
        open.push_back(v);
      }
  };
  for (std::uint32_t seed = 0; seed < edges.size(); ++seed) {
    if (known[seed]) continue;
    const bool forward = SegmentGraph::forward(edges[seed], graph.sub_edges()[edges[seed].first]);
    int right = 0;
    rows.for_each_passed(graph.sample(seed), [&](std::uint32_t s, int by) { right += by * tracing.signs[s]; });
    set_right({seed, forward}, right);
    while (!open.empty()) {
      const auto rays = graph.rays(open.back());
      open.pop_back();
      std::size_t first = 0;
      while (!known[rays[first].edge]) ++first;
      for (std::size_t k = 0; k < rays.size(); ++k) {
        const SegmentGraph::Ray &ray = rays[(first + k) % rays.size()],
                                &following = rays[(first + k + 1) % rays.size()];
        set_right(following, ray.forward ? sides[ray.edge].left : sides[ray.edge].right);
      }
    }
  }
  return sides;
}

std::vector<BoundaryEdges> GraphRings::rings() const {
  std::vector<std::uint32_t> next(graph_.edges().size(), kNone);
  for (std::uint32_t v = 0; v < graph_.nodes().size(); ++v) link(v, next);
  std::vector<BoundaryEdges> out;
  std::vector<std::uint8_t> seen(next.size(), 0);
  for (std::uint32_t start = 0; start < next.size(); ++start) {
    if (next[start] == kNone || seen[start]) continue;
    BoundaryEdges path;
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

SumRing GraphRings::ring(const BoundaryEdges& edges, double& error) const {
  SumRing ring;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const BoundaryEdge &in = edges[i], &out = edges[(i + 1) % edges.size()];
    if (soup_.cross(in.segment, out.segment) == 0) continue;  // straight on
    const SegmentGraph::Node& node = graph_.nodes()[in.to];
    error = std::max(error, position_error(soup_, node.position));
    ring.vertices.push_back(vertex_of(soup_, in.segment, out.segment, node.end, node.position));
  }
  return ring;
}

// How often the direction of a ring passes +x counter-clockwise is 1 for a counter-clockwise one, -1 otherwise. Not by
// the other engines' turning_number: this one is there to be compared with them.
bool GraphRings::counter_clockwise(const BoundaryEdges& ring) const {
  const auto upper = [&](const BoundaryEdge& e) {
    return (half_plane(soup_.dx(e.segment), soup_.dy(e.segment)) == 0) == e.along;
  };
  int turns = 0;
  const BoundaryEdge* last = &ring.back();
  for (const BoundaryEdge& e : ring) {
    const int cross = soup_.cross(last->segment, e.segment), turn = last->along == e.along ? cross : -cross;
    if (turn > 0 && !upper(*last) && upper(e)) ++turns;
    if (turn < 0 && upper(*last) && !upper(e)) --turns;
    last = &e;
  }
  return turns > 0;
}

// Interior pairing: what comes in goes on with the next ray clockwise, across the interior.
void GraphRings::link(std::uint32_t node, std::vector<std::uint32_t>& next) const {
  std::vector<Ray> rays;
  for (const Ray& r : graph_.rays(node))
    if (on_boundary(r.edge)) rays.push_back(r);
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (!leaves(rays[i])) next[rays[i].edge] = rays[(i + rays.size() - 1) % rays.size()].edge;
}

BoundaryEdge GraphRings::oriented(std::uint32_t edge) const {
  const SegmentGraph::Edge& e = graph_.edges()[edge];
  const bool forward = sides_[edge].left;
  const std::uint32_t segment = segments_[edge];
  const bool along = segment_along(graph_, edge, forward, [&](std::uint32_t s) { return s == segment; }) != kNone;
  return {forward ? e.low : e.high, forward ? e.high : e.low, segment, along};
}

SumVertex vertex_on(const Soup& soup, const SegmentGraph& graph, std::uint32_t node, std::uint32_t segment) {
  const SegmentGraph::Node& v = graph.nodes()[node];
  if (v.end.pair) return vertex_of(soup, segment, segment, v.end, v.position);
  const bool parallel = soup.cross(segment, v.segment) == 0;
  return vertex_of(soup, segment, parallel ? v.end.other : v.segment, v.end, v.position);
}

namespace {

bool inside(Sides s) { return s.left > 0 && s.right > 0; }

// Whether the open sum can have a crack there: edges inside that carry positive segments in both directions.
bool may_be_crack(const Tracing& tracing, const SegmentGraph& graph, std::uint32_t edge) {
  const auto positive = [&](std::uint32_t s) { return tracing.signs[s] > 0; };
  return segment_along(graph, edge, true, positive) != kNone && segment_along(graph, edge, false, positive) != kNone;
}

}  // namespace

GraphRings winding_rings(const Tracing& tracing, const SegmentGraph& graph, const std::vector<Sides>& sides) {
  std::vector<GraphSides> lies;
  std::vector<std::uint32_t> segments(sides.size(), kNone);
  for (std::uint32_t e = 0; e < sides.size(); ++e) {
    lies.push_back({sides[e].left > 0, sides[e].right > 0});
    if (lies[e].left == lies[e].right) continue;
    segments[e] = segment_along(graph, e, lies[e].left, [&](std::uint32_t s) { return tracing.signs[s] > 0; });
    if (segments[e] == kNone)
      throw std::logic_error("winding numbers: a boundary edge without a segment that bounds it");
  }
  return GraphRings(tracing.soup, graph, std::move(lies), std::move(segments));
}

void find_tight_features(const Tracing& tracing, const SegmentGraph& graph, const std::vector<Sides>& sides,
                         Collision& collision, RawBoundary& out, double& error) {
  const auto named = [&](std::uint32_t node, std::uint32_t segment) {
    error = std::max(error, position_error(tracing.soup, graph.nodes()[node].position));
    return vertex_on(tracing.soup, graph, node, segment);
  };
  for (std::uint32_t i = 0; i < graph.edges().size(); ++i) {
    if (!inside(sides[i]) || !may_be_crack(tracing, graph, i) || collision.overlaps(graph.sample(i))) continue;
    const SegmentGraph::Edge& e = graph.edges()[i];
    const std::uint32_t segment = graph.sub_edges()[e.first].segment;
    out.cracks.push_back({named(e.low, segment), named(e.high, segment)});
  }
  for (std::uint32_t v = 0; v < graph.nodes().size(); ++v) {
    const SegmentGraph::Node& node = graph.nodes()[v];
    // Punctures are nodes inside with at least three segments: two contacts leave a way out.
    const auto rays = graph.rays(v);
    const auto lies_inside = [&](const SegmentGraph::Ray& r) { return inside(sides[r.edge]); };
    if (node.passes < 3 || !std::all_of(rays.begin(), rays.end(), lies_inside)) continue;
    if (!collision.overlaps(node.position))
      out.punctures.push_back(named(v, node.end.pair ? node.segment : node.end.other));
  }
}

}  // namespace dymsum::planar
