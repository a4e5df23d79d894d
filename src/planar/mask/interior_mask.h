// A proof, cell by cell, that parts of the plane lie in the interior of the sum: whatever happens there need not be
// computed. Lemma and proof: docs/design/planar-sum.md, "interior mask".
#pragma once

#include "planar/mask/covered_cells.h"
#include "planar/operand/operand.h"

namespace dymsum::planar {

/// Cells whose closure, grown by 8 kReach cells, lies in int P + Q or P + int Q. Without counts.
class InteriorMask : public CoveredCells {
 public:
  /// `cells` along the longer side of the sum's bounding box.
  InteriorMask(const Operand& p, const Operand& q, int cells);
  int cells() const { return cells_; }

 private:
  int cells_;
};

/// An operand on fine cells: O(cells / 64 + rows met by edges) instead of O(cells). Where components overlap some inner
/// cells are missed.
Raster fine_raster(const Operand& o, const Grid& cells);
/// The same for any cells, by winding numbers. O(cells).
Raster winding_raster(const Operand& o, const Grid& cells);

}  // namespace dymsum::planar
