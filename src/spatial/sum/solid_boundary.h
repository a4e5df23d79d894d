// The stages of a solid sum in their order, from operands to the cells that bound it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "dymsum/spatial_sum.h"
#include "spatial/arrangement/solid_arrangement.h"
#include "spatial/boundary/tight_features.h"
#include "spatial/convolution/reduced_facets.h"

namespace dymsum::spatial {

// The cells of the arrangement that bound the sum: around every edge the cells' sides that look into one wedge of space
// belong together.

// The wedges of space around the edges of an arrangement.

/// A side of a cell: 1 that of its plane's normal, -1 the other one.
struct CellSide {
  std::uint32_t cell = 0;
  int side = 1;
};

/// Sorts the cells around one edge after the other, in an array that it keeps. is_wall(cell): whether a cell counts; it
/// is looked through where it does not.
template <class IsWall>
class EdgeWedges {
 public:
  EdgeWedges(const SumSpace& space, const SolidArrangement& arrangement, IsWall is_wall)
      : space_(space), arrangement_(arrangement), is_wall_(is_wall) {}

  /// f(x, y): the sides of cells that look into one wedge, counter-clockwise (x) and clockwise around the edge, for all
  /// wedges. Exact. O(k log k) for k cells.
  template <class F>
  void for_each(std::uint32_t edge, F f) {
    walls_.clear();
    for (const EdgeUse use : arrangement_.uses(edge)) {
      const PlaneGroup& group = arrangement_.groups[use.group];
      const CellEdge& e = group.cells.edges[use.edge];
      const bool up = arrangement_.point(group, e.a) < arrangement_.point(group, e.b);
      const std::uint32_t left = up ? e.left : e.right, right = up ? e.right : e.left;
      add_wall(group, true, left);
      add_wall(group, false, right);
    }
    if (walls_.size() > 2) sort_around(arrangement_.edge_ends[edge]);
    for (std::size_t k = 0; k < walls_.size(); ++k)
      f(looking(walls_[k], true), looking(walls_[(k + 1) % walls_.size()], false));
  }

 private:
  /// Half of a plane at the edge, covered by a cell.
  struct Wall {
    PlaneId plane;
    bool left;
    std::uint32_t cell;
  };

  void add_wall(const PlaneGroup& group, bool left, std::uint32_t cell) {
    if (cell != kNoId && is_wall_(group.first_cell + cell))
      walls_.push_back({group.plane, left, group.first_cell + cell});
  }
  /// Counter-clockwise of the left half lies the normal's side, of the right half the other one.
  static CellSide looking(const Wall& wall, bool counter_clockwise) {
    return {wall.cell, wall.left == counter_clockwise ? 1 : -1};
  }

  /// Counter-clockwise seen against the vector from a to b.
  void sort_around(const std::array<PointId, 2>& edge) {
    const Approx &a = arrangement_.points.approx(edge[0]), &b = arrangement_.points.approx(edge[1]);
    const Vec3 d = b.at - a.at;
    axis_ = std::abs(d.x) >= std::abs(d.y) && std::abs(d.x) >= std::abs(d.z) ? 0
            : std::abs(d.y) >= std::abs(d.z)                                 ? 1
                                                                             : 2;
    along_ = 0;
    const double gap = axis_ == 0 ? d.x : axis_ == 1 ? d.y : d.z;
    if (std::abs(gap) > 2 * (a.radius + b.radius) + space_.span() * 0x1p-50) along_ = gap > 0 ? 1 : -1;
    for (int k = 0; k < 3 && along_ == 0; ++k) {
      axis_ = k;
      along_ = space_.exact_order(arrangement_.points.source(edge[0]), arrangement_.points.source(edge[1]), k);
    }
    const Wall reference = walls_[0];
    const auto sector = [&](const Wall& w) {
      if (w.plane == reference.plane) return w.left == reference.left ? 0 : 2;
      return turn(reference, w) > 0 ? 1 : 3;
    };
    std::sort(walls_.begin(), walls_.end(), [&](const Wall& x, const Wall& y) {
      const int a = sector(x), b = sector(y);
      if (a != b) return a < b;
      return turn(x, y) > 0;
    });
  }
  /// The sign of the turn around the edge from one half-plane to another: (n x d) x (m x d) = d (d . (n x m)).
  int turn(const Wall& x, const Wall& y) const {
    if (x.plane == y.plane) return 0;
    const Vec3 c = cross(space_.plane(x.plane).n, space_.plane(y.plane).n);
    const double v = axis_ == 0 ? c.x : axis_ == 1 ? c.y : c.z;
    const int s = v > 0x1p-47 ? 1 : v < -0x1p-47 ? -1 : space_.exact_cross(x.plane, y.plane, axis_);
    return s * along_ * (x.left ? 1 : -1) * (y.left ? 1 : -1);
  }

  const SumSpace& space_;
  const SolidArrangement& arrangement_;
  IsWall is_wall_;
  std::vector<Wall> walls_;
  int axis_ = 0, along_ = 0;
};

/// What lies on the sides of a cell.
enum class CellState : std::uint8_t {
  covered,   ///< both sides in the open sum
  boundary,  ///< the side that its facets face is outside
};

struct CellLinks {
  std::vector<std::uint32_t>
      patch;  ///< per cell: cells whose front sides are connected have the same index; kNoId for covered ones
  std::uint32_t patches = 0;
};

/// Statement and proof: docs/design/solid-sum.md, "Links". A cell that facets of both directions cover has no patch,
/// and one of neither is looked through. With a scope only cells and edges in it are linked, and other cells have no
/// patch.
CellLinks link_cells(const SumSpace& space, const SolidArrangement& arrangement, StageWatch& watch,
                     const ArrangementScope* scope = nullptr);

struct SolidBoundary {
  std::shared_ptr<SumSpace> space;
  FacetTable table;
  std::unique_ptr<SolidArrangement> arrangement;
  std::vector<bool> boundary;        ///< per cell
  std::vector<std::uint32_t> patch;  ///< per cell of the boundary: connected by wedges of the outside
  TightFeatures tight;
  bool either_side = false;  ///< whether a cell of the boundary may have facets of either direction, or of one
};

/// Throws Cancelled and OverBudget.
SolidBoundary solid_boundary(const SolidOperand& p, const SolidOperand& q, const SpatialOptions& options,
                             SpatialStats& stats, StageWatch& watch);

/// What is known of a convolution beforehand.
struct ConvolutionHints {
  bool inner_dropped = false;  ///< facets deep inside the open sum are left out already
};
/// The same of a space and the facets in it, whatever positions of the operands' vertices the space has.
SolidBoundary solid_boundary(std::unique_ptr<SumSpace> space, ReducedConvolution convolution, const SolidOperand& p,
                             const SolidOperand& q, const ConvolutionHints& hints, const SpatialOptions& options,
                             SpatialStats& stats, StageWatch& watch);
/// The space of a sum: of doubles, or where vertices are exact, of these.
std::unique_ptr<SumSpace> space_of(const SolidOperand& p, const SolidOperand& q);
/// The cells of a boundary whose space and table of facets are there.
void find_cells(SolidBoundary& boundary, SpatialStats& stats, StageWatch& watch);
/// Bytes of facets in the table and on the way into it: their planes and edges, facet edges as segments with upright
/// planes.
std::uint64_t table_bytes(std::size_t facets);

/// The number of inner boxes across the sum, for so many facets: few boxes are many times faster than the facets that
/// they save.
int inner_boxes_across(std::size_t facets);

/// A position off the facets, infinitely near to a cell: in front of it for side 1 or -1 (of the plane's normal),
/// inside it for 0.
Flag flag_at(const SolidArrangement& arrangement, const PlaneGroup& group, const Cell& cell, int side);

}  // namespace dymsum::spatial
