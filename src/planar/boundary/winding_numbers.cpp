#include "planar/boundary/winding_numbers.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>

#include "planar/arrangement/ray_rows.h"

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

}  // namespace dymsum::planar
