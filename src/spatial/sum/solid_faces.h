// Cells put together to the faces, vertices and tight features of a result.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "spatial/sum/solid_boundary.h"

namespace dymsum::spatial {

// What touches on faces and along tight segments, wherever their first vertices are: a sum in motion keeps its
// structure, but not the order of its vertices.

struct TightFaceCorners {
  std::vector<std::array<SolidContact, 2>> contacts;  ///< as of a face
  PlaneId plane = 0;
  int front = 1;  ///< the side of the plane's normal, or the other one: -1
};
struct CornerContacts {
  /// Of every face, in their order: the smallest pair beside each edge of the outer loop, from its first vertex on; one
  /// alone where it is the same beside all.
  std::vector<std::vector<SolidContact>> faces;
  std::vector<TightFaceCorners> tight_faces;
  std::vector<std::array<std::vector<SolidContact>, 2>> tight_segments;  ///< at `from` and at `to`
};

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
/// that are listed. `corners`: where it is not null, filled as well, for sums without sheets.
void assemble(const SolidBoundary& boundary, const SolidOperand& p, const SolidOperand& q, SpatialSum& sum,
              StageWatch& watch, std::vector<SheetFace> sheet_faces = {}, CornerContacts* corners = nullptr);

}  // namespace dymsum::spatial
