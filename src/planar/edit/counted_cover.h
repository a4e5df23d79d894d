// Covered cells of a sum that follow edits of its operands: every cell knows how many pairs of cells prove that it lies
// inside. docs/design/edited-sum.md, "Cover".
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "planar/edit/edge_raster.h"
#include "planar/edit/walk_changes.h"
#include "planar/mask/interior_mask.h"
#include "planar/operand/operand.h"

namespace dymsum::planar {

/// A cell of a grid.
struct GridCell {
  int row = 0, column = 0;
};

/// The cells that the interior mask proves covered, each with the number of its proofs. An edit of an operand changes
/// few cells of its raster, and each of these adds or takes proofs.
class CountedCover {
 public:
  /// Nothing is covered with fewer than two cells along the longer side.
  CountedCover(const PlacedPair& placed, int cells);

  const Grid& grid() const { return grid_; }
  bool covered(int row, int column) const { return covered_.get(row, column); }
  /// Whether some cell of a rectangle is live.
  bool any_live(int row0, int column0, int row1, int column1) const;
  /// Whether operands still lie on the grid, which leaves a margin around those that it was made for.
  bool holds(const PlacedPair& placed) const;
  /// What has to be added to coordinates of the lattice that was last followed to be those of the grid.
  Point shift() const { return shift_; }

  /// Follows an edit of the operands. Returns the cells that are covered no longer. Cost: that of EdgeRaster::update,
  /// and for each cell of a raster that changed the other raster's cells.
  std::vector<GridCell> update(const PlacedPair& before, const PlacedPair& after,
                               const std::array<WalkChanges, 2>& changes);

  /// Cells of rasters that changed in the last update.
  std::uint64_t changed_cells() const { return changed_cells_; }

 private:
  // Proofs are sums of an inner corner of one operand and a touched cell of the other.
  void count_all();
  void add_cells(const std::vector<EdgeRaster::Flip>& flips, const Bitmap& other);
  std::vector<GridCell> settle();

  void stand_on(const Lattice& lattice);

  std::array<Point, 2> low_, high_;  // of the grids of both operands, in input coordinates
  Point shift_;
  Grid grid_;
  Bitmap covered_;
  std::vector<std::int32_t> counts_;
  std::vector<EdgeRaster> rasters_;
  std::vector<std::uint32_t> flipped_;
  std::uint64_t changed_cells_ = 0;
};

}  // namespace dymsum::planar
