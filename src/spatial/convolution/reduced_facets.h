// The reduced convolution of two solids: facets that together contain every position in which the solids touch without
// overlapping, and whose back sides lie in the open sum.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "spatial/convolution/solid_operand.h"
#include "spatial/convolution/stage_watch.h"
#include "spatial/convolution/sum_space.h"

namespace dymsum::spatial {

/// A convex polygon: a triangle of one operand plus a vertex of the other, or an edge plus an edge, a parallelogram.
struct SumFacet {
  enum class Kind : std::uint8_t { face_vertex, vertex_face, edge_edge } kind = Kind::face_vertex;
  std::uint8_t corners = 3;
  std::uint32_t p = 0, q = 0;        ///< triangle, vertex or wedge of either operand
  std::array<SumPoint, 4> corner{};  ///< counter-clockwise seen from the side of the normal, which is the outer one
};

struct ConvolutionCounts {
  std::uint64_t face_vertex = 0, edge_edge = 0;
  std::uint64_t pairs_tried = 0;
};

struct ReducedConvolution {
  std::vector<SumFacet> facets;
  std::vector<PlaneSource> planes;  ///< of the facets
  ConvolutionCounts counts;
};

/// Statement: docs/design/solid-sum.md, "Facets". Exact. Cost: the pairs of faces and vertices, and of edges, whose
/// sets of normals have overlapping boxes on the sphere of directions.
ReducedConvolution reduced_convolution(const SumSpace& space, const SolidOperand& p, const SolidOperand& q,
                                       StageWatch& watch);

}  // namespace dymsum::spatial
