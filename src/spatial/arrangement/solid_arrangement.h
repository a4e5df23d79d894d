// All planes of a convolution cut into cells, with the points and edges that cells of different planes share.
#pragma once

#include <cstdint>
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

struct SolidArrangement {
  PointTable points;
  std::vector<PlaneGroup> groups;
  std::uint32_t cell_count = 0;

  explicit SolidArrangement(const SumSpace& space) : points(space) {}

  /// The id in `points` of a point of a group's cells.
  PointId point(const PlaneGroup& group, PointId id) const {
    return id < group.cells.known ? id : group.names[id - group.cells.known];
  }
  std::uint32_t group_of(std::uint32_t cell) const;
};

/// Exact. `threads` 0: as many as there are cores; the result does not depend on it.
SolidArrangement arrange(SumSpace& space, const FacetTable& table, const Contacts& contacts, int threads);

}  // namespace dymsum::spatial
