// Covered cells of a sum that follow edits of its operands: every cell knows how many pairs of cells prove that it lies
// inside. docs/design/edited-sum.md, "Cover".
#pragma once

#include <array>
#include <cstdint>
#include <vector>

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
  CountedCover(const Operand& p, const Operand& q, int cells);

  const Grid& grid() const { return grid_; }
  bool covered(int row, int column) const { return covered_.get(row, column); }
  /// Whether some cell of a rectangle is live.
  bool any_live(int row0, int column0, int row1, int column1) const;
  /// Whether operands of these extents still lie on the grid.
  bool holds(const Operand& p, const Operand& q) const;

  /// Follows an operand to its new walk, against the other one's raster as it was last: first P, then Q. Returns the
  /// cells that are covered no longer. Cost: O(edges + cells / 64), and for each cell of the raster that changed the
  /// other raster's cells.
  std::vector<GridCell> update(const std::array<const Operand*, 2>& operands, const std::array<bool, 2>& changed);

  /// Cells of rasters that changed in the last update.
  std::uint64_t changed_cells() const { return changed_cells_; }

 private:
  // Inner corners and touched cells of an operand: proofs are sums of a corner of one and a touched cell of the other.
  struct Proofs {
    Bitmap corners, touch;
  };
  Proofs proofs_of(const Operand& o, const Grid& cells) const;
  void count_all();
  void add_cell(int row, int column, int change, const Bitmap& other);
  void replace(const Bitmap& before, const Bitmap& after, const Bitmap& other);
  std::vector<GridCell> settle();

  std::array<Grid, 2> part_;
  std::array<double, 2> width_, height_;
  Grid grid_;
  Bitmap covered_;
  std::vector<std::int32_t> counts_;
  std::vector<Proofs> proofs_;
  std::vector<std::uint32_t> flipped_;
  std::uint64_t changed_cells_ = 0;
};

}  // namespace dymsum::planar
