#include "planar/boundary/winding_boundary.h"

#include <algorithm>
#include <stdexcept>
#include <unordered_map>

#include "planar/boundary/boundary.h"

namespace dymsum::planar {

std::vector<BoundaryEdges> WindingBoundary::rings() const {
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

SumRing WindingBoundary::ring(const BoundaryEdges& edges, double& error) const {
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

// How often the direction of a ring passes +x counter-clockwise is 1 for a counter-clockwise one, -1 otherwise. Not by
// the other engines' turning_number: this one is there to be compared with them.
bool WindingBoundary::counter_clockwise(const BoundaryEdges& ring) const {
  const Soup& soup = tracing_.soup;
  const auto upper = [&](std::uint32_t s) { return half_plane(soup.dx(s), soup.dy(s)) == 0; };
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

// Interior pairing: what comes in goes on with the next ray clockwise, across the interior.
void WindingBoundary::link(std::uint32_t node, std::vector<std::uint32_t>& next) const {
  std::vector<Ray> rays;
  for (const Ray& r : graph_.rays(node))
    if (on_boundary(r.edge)) rays.push_back(r);
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (!leaves(rays[i])) next[rays[i].edge] = rays[(i + rays.size() - 1) % rays.size()].edge;
}

// Named by a segment that bounds the sum there: one that is counted positively and runs the same way.
BoundaryEdge WindingBoundary::oriented(std::uint32_t edge) const {
  const SegmentGraph::Edge& e = graph_.edges()[edge];
  const bool forward = sides_[edge].left > 0;
  BoundaryEdge out{forward ? e.low : e.high, forward ? e.high : e.low, kNone};
  for (std::uint32_t k = e.first; k < e.last; ++k) {
    const SegmentGraph::SubEdge& s = graph_.sub_edges()[k];
    if (tracing_.signs[s.segment] > 0 && SegmentGraph::forward(e, s) == forward)
      out.segment = std::min(out.segment, s.segment);
  }
  if (out.segment == kNone) throw std::logic_error("winding numbers: a boundary edge without a segment that bounds it");
  return out;
}

// Where the open sum can have cracks: edges inside that carry positive segments in both directions.
bool WindingBoundary::may_be_crack(std::uint32_t edge) const {
  if (!inside(edge)) return false;
  const SegmentGraph::Edge& e = graph_.edges()[edge];
  bool ahead = false, back = false;
  for (std::uint32_t k = e.first; k < e.last; ++k) {
    const SegmentGraph::SubEdge& s = graph_.sub_edges()[k];
    if (tracing_.signs[s.segment] > 0) (SegmentGraph::forward(e, s) ? ahead : back) = true;
  }
  return ahead && back;
}

// Where it can have punctures: nodes inside with at least three segments. Two contacts leave a way out.
bool WindingBoundary::may_be_puncture(std::uint32_t node) const {
  if (graph_.nodes()[node].passes < 3) return false;
  const auto rays = graph_.rays(node);
  return std::all_of(rays.begin(), rays.end(), [&](const Ray& r) { return inside(r.edge); });
}

// A node as a vertex on a segment that passes through it.
SumVertex WindingBoundary::vertex(std::uint32_t node, std::uint32_t segment) const {
  const Soup& soup = tracing_.soup;
  const SegmentGraph::Node& v = graph_.nodes()[node];
  if (v.end.pair) return vertex_of(soup, segment, segment, v.end, v.place);
  const bool parallel = soup.cross(segment, v.segment) == 0;
  return vertex_of(soup, segment, parallel ? v.end.other : v.segment, v.end, v.place);
}

void WindingBoundary::find_tight_features(Collision& collision, RawBoundary& out, double& error) const {
  const auto named = [&](std::uint32_t node, std::uint32_t segment) {
    error = std::max(error, position_error(tracing_.soup, graph_.nodes()[node].place));
    return vertex(node, segment);
  };
  for (std::uint32_t i = 0; i < graph_.edges().size(); ++i) {
    if (!may_be_crack(i) || collision.overlaps(graph_.sample(i))) continue;
    const SegmentGraph::Edge& e = graph_.edges()[i];
    const std::uint32_t segment = graph_.sub_edges()[e.first].segment;
    out.cracks.push_back({named(e.low, segment), named(e.high, segment)});
  }
  for (std::uint32_t v = 0; v < graph_.nodes().size(); ++v) {
    const SegmentGraph::Node& node = graph_.nodes()[v];
    if (may_be_puncture(v) && !collision.overlaps(node.place))
      out.punctures.push_back(named(v, node.end.pair ? node.segment : node.end.other));
  }
}

}  // namespace dymsum::planar
