// The facets of a convolution with what they have in common: planes, and edges of sums.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "spatial/convolution/reduced_facets.h"

namespace dymsum::spatial {

struct TableFacet {
  SumFacet facet;
  PlaneId plane = 0;              ///< the same for all facets in one plane
  std::int8_t side = 1;           ///< -1 where the facet's normal is opposite to the plane's
  std::array<EdgeId, 4> edge{};   ///< of the facet edge from corner k to corner k + 1
  std::array<bool, 4> forward{};  ///< whether it runs along the edge
};

struct FacetTable {
  std::vector<TableFacet> facets;
  std::vector<bool> inner;  ///< per edge of the space: see find_inner_edges; empty where nobody looked

  bool is_inner(EdgeId edge) const { return !inner.empty() && inner[edge]; }
  SumPoint corner(std::uint32_t f, int k) const { return facets[f].facet.corner[k]; }
};

/// Adds the planes and edges to the space. O(n log n), and an exact comparison for every facet that shares a plane.
FacetTable facet_table(SumSpace& space, const ReducedConvolution& convolution, StageWatch& watch);

/// Marks the edges of sums that split a face and bound nothing: an edge inside a face of one operand, between two of
/// its triangles, plus a vertex, where both triangles plus that vertex are in the table. O(n).
void find_inner_edges(const SumSpace& space, const SolidOperand& p, const SolidOperand& q, FacetTable& table);

}  // namespace dymsum::spatial
