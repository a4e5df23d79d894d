#include "planar/result/trace_windings.h"

namespace dymsum::planar {

void trace_windings(const Soup& soup, const SegmentGraph& graph, const std::vector<BoundaryEdges>& rings,
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

}  // namespace dymsum::planar
