// Cells put together to the faces, vertices and tight features of a result.
#pragma once

#include <cstdint>
#include <vector>

#include "spatial/sum/solid_boundary.h"

namespace dymsum::spatial {

/// A face of the boundary that is none of cells: one of a sheet, with corners at all points of its loops, and of P's
/// plus vertex 0 of Q.
struct SheetFace {
  std::vector<std::vector<PointId>> loops;  ///< counter-clockwise around its inside, seen from outside
  std::uint32_t cell = 0;                   ///< that of the sheet
  std::uint32_t face = 0;                   ///< of P's mesh
  /// The face of P's mesh at every side of the loops, where these are several.
  struct Side {
    PointId from, to;
    std::uint32_t face;
  };
  std::vector<Side> sides;
};

/// Fills vertices, faces, shells and tight features, in canonical order; the sum keeps the boundary's space for its
/// exact positions. `p` and `q` give the faces and edges of the operands' meshes. Sheets have no faces but those
/// that are listed.
void assemble(const SolidBoundary& boundary, const SolidOperand& p, const SolidOperand& q, SpatialSum& sum,
              StageWatch& watch, std::vector<SheetFace> sheet_faces = {});

}  // namespace dymsum::spatial
