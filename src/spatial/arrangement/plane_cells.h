// The arrangement inside one plane: facets in it, cut along their facet edges and along their contacts with facets of
// other planes, into cells.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "spatial/arrangement/plane_lines.h"

namespace dymsum::spatial {

/// An open cell, covered by so many facets whose normal is the plane's (front) or its opposite (back).
struct Cell {
  std::uint32_t front = 0, back = 0;
  std::uint32_t first_loop = 0, last_loop = 0;  ///< of PlaneCells::loops: the outer one first, then those of holes
};

/// A piece of a line between neighbouring points, with the cells on its sides as seen on the vector from a to b against
/// n; kNoId for what no facet covers.
struct CellEdge {
  PointId a = 0, b = 0;
  std::uint32_t left = kNoId, right = kNoId;
  PlaneId cut = 0;
  bool along = true;          ///< the vector from a to b is n x n_cut
  EdgeId facet_edge = kNoId;  ///< the one edge of sums that runs there as a facet edge, or kManyEdges
};

struct PlaneCells {
  std::vector<Cell> cells;
  std::vector<CellEdge> edges;
  /// Loops as half-edges: 2 e for edge e from a to b, 2 e + 1 for the way back; the cell is to the left.
  std::vector<std::uint32_t> half_edges;
  std::vector<std::uint32_t> loops{0};  ///< where each begins; one more at the end
  /// Points at which facets of other planes touch and that lie on no edge, with a plane across this one through each.
  struct Touch {
    PointId at = 0;
    PlaneId cut = 0;
  };
  std::vector<Touch> touches;
  /// Points of ids from `known` on were found here; their sources.
  PointId known = 0;
  std::vector<PointSource> found;
};

/// Makes cells of one plane after the other, in arrays that it keeps.
class PlaneArranger {
 public:
  PlaneArranger(const SumSpace& space, const PointTable& points);
  ~PlaneArranger();

  /// The cells of the union of the facets whose facet edges are among the segments. Points of segments are ids of the
  /// table; crossings get ids behind those of the table, whose order is that of this plane alone. Exact. Cost: that of
  /// PlaneLines::run, and O(c l) for c components with l loops around them.
  PlaneCells run(PlaneId plane, std::span<const PlaneSegment> segments);

 private:
  class Cells;
  std::unique_ptr<Cells> cells_;
};

}  // namespace dymsum::spatial
