#include "spatial/arrangement/facet_table.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <tuple>
#include <unordered_map>

namespace dymsum::spatial {

namespace {

void share_planes(const SumSpace& space, PlaneId first, FacetTable& table, StageWatch& watch) {
  const std::vector<exact::Residue> hash = space.plane_hashes(first, table.facets.size());
  std::vector<std::uint32_t> order(hash.size());
  std::iota(order.begin(), order.end(), 0u);
  watch.sort(order, [&](std::uint32_t a, std::uint32_t b) { return std::tie(hash[a], a) < std::tie(hash[b], b); });
  // The leaders of the planes with one hash, nearly always one; they stand after those with the hash 0, which may be
  // any plane and come first.
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

/// Edges once, in the order in which facets have them.
void share_edges(SumSpace& space, FacetTable& table) {
  const auto before = static_cast<EdgeId>(space.edges().size());
  std::vector<SumEdge> edges;
  std::vector<std::uint32_t> slots(std::bit_ceil(4 * table.facets.size() + 1), kNoId);  // open addressing
  for (TableFacet& facet : table.facets) {
    const int n = facet.facet.corners;
    for (int k = 0; k < n; ++k) {
      SumEdge edge{facet.facet.corner[k], facet.facet.corner[(k + 1) % n]};
      facet.forward[k] = edge.from < edge.to;
      if (!facet.forward[k]) std::swap(edge.from, edge.to);
      const auto pair = [](SumPoint s) { return static_cast<std::uint64_t>(s.p) << 32 | s.q; };
      const std::uint64_t mixed = pair(edge.from) * 0x9e3779b97f4a7c15ULL + pair(edge.to) * 0xd6e8feb86659fd93ULL;
      std::size_t at = (mixed >> 32) & (slots.size() - 1);
      while (slots[at] != kNoId && edges[slots[at]] != edge) at = (at + 1) & (slots.size() - 1);
      if (slots[at] == kNoId) {
        slots[at] = static_cast<std::uint32_t>(edges.size());
        edges.push_back(edge);
      }
      facet.edge[k] = before + slots[at];
    }
  }
  space.add_edges(edges);
}

std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
  return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | std::max(a, b);
}

/// The edges of solid parts between two triangles in one plane, and no others: true in the map.
std::unordered_map<std::uint64_t, bool> flat_edges(const SolidOperand& solid) {
  std::unordered_map<std::uint64_t, bool> flat;
  for (const Wedge& w : solid.wedges)
    if (w.bend == Wedge::Bend::flat && !w.is_segment() && w.left < solid.first_plate)
      flat.emplace(edge_key(w.from, w.to), true);
  if (flat.empty()) return flat;
  // What else meets there makes it an edge like others.
  std::unordered_map<std::uint64_t, int> wedges;
  for (const Wedge& w : solid.wedges)
    if (const auto at = flat.find(edge_key(w.from, w.to)); at != flat.end() && ++wedges[at->first] > 1)
      at->second = false;
  return flat;
}

}  // namespace

void find_inner_edges(const SumSpace& space, const SolidOperand& p, const SolidOperand& q, FacetTable& table) {
  const std::unordered_map<std::uint64_t, bool> flat[2] = {flat_edges(p), flat_edges(q)};
  if (flat[0].empty() && flat[1].empty()) return;
  std::vector<int> balance(space.edges().size(), 0);  // of facets to either side
  for (const TableFacet& f : table.facets)
    for (int k = 0; k < f.facet.corners; ++k) balance[f.edge[k]] += f.forward[k] ? 1 : -1;
  table.inner.assign(space.edges().size(), false);
  for (EdgeId e = 0; e < balance.size(); ++e) {
    const SumEdge& edge = space.edges()[e];
    const bool of_p = edge.from.q == edge.to.q;
    const std::uint64_t key = of_p ? edge_key(edge.from.p, edge.to.p) : edge_key(edge.from.q, edge.to.q);
    const auto at = flat[of_p ? 0 : 1].find(key);
    table.inner[e] = balance[e] == 0 && at != flat[of_p ? 0 : 1].end() && at->second;
  }
}

FacetTable facet_table(SumSpace& space, const ReducedConvolution& convolution, StageWatch& watch) {
  FacetTable table;
  table.facets.reserve(convolution.facets.size());
  for (const SumFacet& facet : convolution.facets) table.facets.push_back({facet, 0, 1, {}, {}});
  share_planes(space, space.add_planes(convolution.planes, watch.threads()), table, watch);
  share_edges(space, table);
  return table;
}

}  // namespace dymsum::spatial
