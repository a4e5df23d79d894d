#include "planar/result/trace_stages.h"

namespace dymsum::planar {

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
        if (!mask->covered(r, c)) continue;
        const int first = c;
        while (c + 1 < mask->grid().columns && mask->covered(r, c + 1)) ++c;
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
      const SegmentPosition p = arrangement.end_position(step);
      r.push_back(lattice.to_input(p.x, p.y));
    }
    return r;
  };
  for (const BoundaryLoop& loop : loops.kept) trace.kept_loops.push_back(ring(loop));
  for (const BoundaryLoop& loop : loops.dropped) trace.dropped_loops.push_back(ring(loop));
}

void trace_windings(const Soup& soup, const SegmentGraph& graph, const std::vector<BoundaryEdges>& rings,
                    PlanarTrace& trace) {
  const Lattice& lattice = soup.lattice;
  const auto at = [&](std::uint32_t node) {
    const SegmentPosition& x = graph.nodes()[node].position;
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
