#include "planar/boundary/winding_boundary.h"

#include <algorithm>
#include <stdexcept>

#include "planar/boundary/boundary.h"

namespace dymsum::planar {
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
