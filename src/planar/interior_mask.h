// A proof, cell by cell, that parts of the plane lie in the interior of the sum: whatever happens there need not be computed.
// Lemma and proof: docs/design/planar-sum.md, "interior mask".
#pragma once

#include <cstdint>
#include <vector>

#include "planar/grid.h"
#include "planar/lattice.h"
#include "planar/operand.h"

namespace dymsum::planar {

/// Cells whose closure, grown by 8 kReach cells, lies in int P + Q or P + int Q.
class InteriorMask {
 public:
  /// `cells` along the longer side of the sum's bounding box.
  InteriorMask(const Operand& p, const Operand& q, int cells);

  const Grid& grid() const { return grid_; }
  bool dead(int row, int column) const { return (bits_[std::size_t(row) * words_ + column / 64] >> (column % 64)) & 1; }
  /// Whether all cells of a rectangle of cells are dead. O(1).
  bool all_dead(int row0, int column0, int row1, int column1) const {
    const std::size_t w = std::size_t(grid_.columns) + 1;
    const auto at = [&](int r, int c) { return sums_[std::size_t(r) * w + c]; };
    const std::uint32_t live = at(row1 + 1, column1 + 1) - at(row0, column1 + 1) - at(row1 + 1, column0) + at(row0, column0);
    return live == 0;
  }
  std::size_t dead_cells() const { return dead_cells_; }
  std::size_t bytes() const { return bits_.size() * 8 + sums_.size() * 4; }

 private:
  Grid grid_;
  std::size_t words_ = 0;
  std::vector<std::uint64_t> bits_;
  std::vector<std::uint32_t> sums_;  ///< live cells left of and below a corner
  std::size_t dead_cells_ = 0;
};

}  // namespace dymsum::planar
