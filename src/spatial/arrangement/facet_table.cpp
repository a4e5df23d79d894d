#include "spatial/arrangement/facet_table.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace dymsum::spatial {

namespace {

void share_planes(const SumSpace& space, PlaneId first, FacetTable& table, StageWatch& watch) {
  const std::vector<exact::Residue> hash = space.plane_hashes(first, table.facets.size());
  std::vector<std::uint32_t> order(hash.size());
  std::iota(order.begin(), order.end(), 0u);
  watch.sort(order, [&](std::uint32_t a, std::uint32_t b) { return std::tie(hash[a], a) < std::tie(hash[b], b); });
  // Of the planes with one hash, nearly always one; behind those with the hash 0, which may be any plane and come
  // first.
  std::vector<std::uint32_t> leaders;
  std::size_t wild = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (k == 0 || hash[order[k]] != hash[order[k - 1]]) {
      if (k > 0 && hash[order[k - 1]] == 0) wild = leaders.size();
      leaders.resize(wild);
    }
    TableFacet& facet = table.facets[order[k]];
    facet.plane = first + order[k], facet.side = 1;
    int same = 0;
    for (const std::uint32_t leader : leaders) {
      same = space.same_plane(first + leader, facet.plane);
      if (same == 0) continue;
      facet.plane = first + leader, facet.side = static_cast<std::int8_t>(same);
      break;
    }
    if (same == 0) leaders.push_back(order[k]);
  }
}

void share_edges(SumSpace& space, FacetTable& table, StageWatch& watch) {
  struct Border {
    SumEdge edge;
    std::uint32_t facet;
    int corner;
  };
  std::vector<Border> borders;
  borders.reserve(4 * table.facets.size());
  for (std::uint32_t f = 0; f < table.facets.size(); ++f) {
    TableFacet& facet = table.facets[f];
    const int n = facet.facet.corners;
    for (int k = 0; k < n; ++k) {
      SumEdge edge{facet.facet.corner[k], facet.facet.corner[(k + 1) % n]};
      facet.forward[k] = edge.from < edge.to;
      if (!facet.forward[k]) std::swap(edge.from, edge.to);
      borders.push_back({edge, f, k});
    }
  }
  watch.sort(borders, [](const Border& a, const Border& b) {
    return std::tie(a.edge, a.facet, a.corner) < std::tie(b.edge, b.facet, b.corner);
  });
  std::vector<SumEdge> edges;
  const auto first = static_cast<EdgeId>(space.edges().size());
  for (std::size_t k = 0; k < borders.size(); ++k) {
    if (k == 0 || borders[k].edge != borders[k - 1].edge) edges.push_back(borders[k].edge);
    table.facets[borders[k].facet].edge[borders[k].corner] = first + static_cast<EdgeId>(edges.size() - 1);
  }
  space.add_edges(edges);
}

}  // namespace

FacetTable facet_table(SumSpace& space, const ReducedConvolution& convolution, StageWatch& watch) {
  FacetTable table;
  table.facets.reserve(convolution.facets.size());
  for (const SumFacet& facet : convolution.facets) table.facets.push_back({facet, 0, 1, {}, {}});
  share_planes(space, space.add_planes(convolution.planes, watch.threads()), table, watch);
  share_edges(space, table, watch);
  return table;
}

}  // namespace dymsum::spatial
