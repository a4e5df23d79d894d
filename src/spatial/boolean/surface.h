// The triangles of closed surfaces, of one or of several solids.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dymsum/mesh.h"
#include "spatial/convolution/solid_operand.h"
#include "spatial/sum/common_grid.h"
#include "spatial/sum/exact_set.h"

namespace dymsum::spatial {

/// A solid, perhaps turned inside out.
struct DirectedSolid {
  const Mesh* mesh = nullptr;
  bool inside_out = false;
};

struct Surface {
  SolidOperand operand;  ///< triangles with area, their faces and vertices: nothing else
  /// Of several solids: where the triangles of each begin, and where the last ones end. Two triangles of one of them
  /// have nothing in common but vertices and edges of both. Empty where that is not known.
  std::vector<std::uint32_t> first_triangle;

  bool of_solids() const { return !first_triangle.empty(); }
};

/// The triangles with area. Vertices keep their indices; those that no triangle has lie where another one does, so that
/// they need no digits of their own.
Surface surface_of(const MeshData& data);
/// The same of triangles, at exact positions.
Surface surface_of(const CommonGrid& grid, const ExactSet& triangles);
/// The solids' surfaces without their thin parts: faces and vertices are counted on from solid to solid.
Surface surface_of(std::span<const DirectedSolid> solids);

}  // namespace dymsum::spatial
