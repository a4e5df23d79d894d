// All planes of a convolution cut into cells, with the points and edges that cells of different planes share.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "spatial/arrangement/contacts.h"
#include "spatial/arrangement/plane_cells.h"

namespace dymsum::spatial {

/// Facets of one plane whose boxes overlap, directly or by others between them, and their cells.
struct PlaneGroup {
  PlaneId plane = 0;
  std::vector<std::uint32_t> facets;
  PlaneCells cells;
  std::uint32_t first_cell = 0;  ///< the index of its first cell among all
  std::vector<PointId> names;    ///< of the points found in this plane: their ids in the table
};

/// An edge of a group's cells.
struct EdgeUse {
  std::uint32_t group = 0, edge = 0;
};

struct SolidArrangement {
  PointTable points;
  std::vector<PlaneGroup> groups;
  std::uint32_t cell_count = 0;
  /// The edges of all planes, each once: edge e, from point edge_ends[e][0] to a larger one, is what edge_uses from
  /// first_use[e] to first_use[e + 1] are in their planes.
  std::vector<std::array<PointId, 2>> edge_ends;
  std::vector<std::uint32_t> first_use;
  std::vector<EdgeUse> edge_uses;

  explicit SolidArrangement(const SumSpace& space) : points(space) {}

  /// The id in `points` of a point of a group's cells.
  PointId point(const PlaneGroup& group, PointId id) const {
    return id < group.cells.known ? id : group.names[id - group.cells.known];
  }
  std::uint32_t group_of(std::uint32_t cell) const;
  std::span<const EdgeUse> uses(std::uint32_t edge) const {
    return {edge_uses.data() + first_use[edge], edge_uses.data() + first_use[edge + 1]};
  }
  const CellEdge& edge(EdgeUse use) const { return groups[use.group].cells.edges[use.edge]; }
};

/// An open surface of facets that are not in the table: nothing meets it but along its rim, the facet edges that it
/// has in common with one facet of the table each. They run with the sheet to their left, seen from its front.
struct Sheet {
  std::vector<std::array<SumPoint, 2>> rim;
};

/// Exact. `cuts` cut their facets' planes as contacts do. Each of the sheets is a group of its own behind all others,
/// of no plane: one cell, whose edges are the rim, with no loops.
SolidArrangement arrange(SumSpace& space, const FacetTable& table, Contacts contacts, StageWatch& watch,
                         std::span<const PlaneCut> cuts = {}, std::span<const Sheet> sheets = {});

/// What of an arrangement counts: the rest is looked through.
struct ArrangementScope {
  std::vector<bool> points, edges, cells;
};

}  // namespace dymsum::spatial
