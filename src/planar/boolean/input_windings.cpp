#include "planar/boolean/input_windings.h"

#include <algorithm>

#include "planar/arrangement/ray_rows.h"

namespace dymsum::planar {

InputWindings::InputWindings(const Soup& soup, const SegmentGraph& graph, const std::vector<std::uint32_t>& input_of,
                             std::size_t inputs, const Poll& poll)
    : inputs_(inputs) {
  const auto& edges = graph.edges();
  windings_.assign(2 * edges.size() * inputs, 0);
  const RayRows rows(soup);
  std::vector<std::uint8_t> known(edges.size(), 0), done(graph.nodes().size(), 0);
  std::vector<std::uint32_t> open;  // nodes with a known edge
  // Left of an edge the rings of its sub-edges go around once more than right of it, where these run as it does.
  const auto jump = [&](std::uint32_t edge, std::span<std::int32_t> windings, int sign) {
    const SegmentGraph::Edge& e = edges[edge];
    for (std::uint32_t k = e.first; k < e.last; ++k) {
      const SegmentGraph::SubEdge& s = graph.sub_edges()[k];
      windings[input_of[s.segment]] += SegmentGraph::forward(e, s) ? sign : -sign;
    }
  };
  const auto enter = [&](std::uint32_t edge) {
    known[edge] = 1;
    for (const std::uint32_t v : {edges[edge].low, edges[edge].high})
      if (!done[v]) {
        done[v] = 1;
        open.push_back(v);
      }
  };
  // The face clockwise of a ray is known.
  const auto set = [&](const SegmentGraph::Ray& ray, std::span<const std::int32_t> clockwise) {
    if (known[ray.edge]) return;
    const std::size_t k = ray.forward ? 1 : 0;
    std::copy(clockwise.begin(), clockwise.end(), side(ray.edge, k).begin());
    std::copy(clockwise.begin(), clockwise.end(), side(ray.edge, 1 - k).begin());
    jump(ray.edge, side(ray.edge, 1 - k), ray.forward ? 1 : -1);
    enter(ray.edge);
  };
  std::vector<std::int32_t> seed(inputs);
  std::size_t seeds = 0;
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    if (known[e]) continue;
    poll.at_test(seeds++, edges.size());
    std::fill(seed.begin(), seed.end(), 0);
    rows.for_each_passed(graph.sample(e), [&](std::uint32_t s, int by) { seed[input_of[s]] += by; });
    // Right of the segment from which the ray starts.
    set({e, SegmentGraph::forward(edges[e], graph.sub_edges()[edges[e].first])}, seed);
    while (!open.empty()) {
      const auto rays = graph.rays(open.back());
      open.pop_back();
      std::size_t first = 0;
      while (!known[rays[first].edge]) ++first;
      for (std::size_t k = 0; k + 1 < rays.size(); ++k)
        set(rays[(first + k + 1) % rays.size()], beside(rays[(first + k) % rays.size()]));
    }
  }
}

}  // namespace dymsum::planar
