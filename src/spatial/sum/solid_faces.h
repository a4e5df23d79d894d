// Cells put together to the faces, vertices and tight features of a result.
#pragma once

#include <array>
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

/// Fills vertices, faces, shells and tight features, in canonical order; the sum keeps the boundary's space for its
/// exact positions. `p` and `q` give the faces and edges of the
/// operands' meshes. `corners`: where it is not null, filled as well.
void assemble(const SolidBoundary& boundary, const SolidOperand& p, const SolidOperand& q, SpatialSum& sum,
              StageWatch& watch, CornerContacts* corners = nullptr);

}  // namespace dymsum::spatial
