#include "planar/boundary/graph_rings.h"

#include <algorithm>
#include <unordered_map>

#include "planar/boundary/boundary.h"

namespace dymsum::planar {

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

}  // namespace dymsum::planar
