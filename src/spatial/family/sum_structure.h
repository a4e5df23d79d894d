// The structure of a sum without its positions, and the sum that it is at a pose.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "dymsum/spatial_sum.h"
#include "spatial/motion/posed_pair.h"
#include "spatial/sum/solid_faces.h"

namespace dymsum::spatial {

/// Faces, edges and what is tight by names of vertices, which are indices of `vertices`; these by planes and edges of
/// sums, which are indices of `planes` and `edges`. A sum of nothing has none of these.
struct SumStructure {
  struct Loop {
    std::uint32_t first = 0, last = 0;  ///< of `corners`
  };
  struct Face {
    std::uint32_t first_loop = 0, last_loop = 0;        ///< the outer one first
    std::uint32_t first_contact = 0, last_contact = 0;  ///< beside each edge of the outer loop, or one
    std::uint32_t shell = 0;
  };
  struct TightFace {
    std::uint32_t first_loop = 0, last_loop = 0;
    std::vector<std::array<SolidContact, 2>> contacts;
    std::uint32_t plane = 0;
    int front = 1;
  };
  struct Edge {
    std::uint32_t from = 0, to = 0;
    std::optional<SolidContact> contact;
  };
  struct TightSegment {
    std::array<std::uint32_t, 2> ends{};
    std::array<std::vector<SolidContact>, 2> contacts;  ///< at either end
  };
  struct TightPoint {
    std::uint32_t vertex = 0;
    std::vector<SolidContact> contacts;
  };

  std::vector<PlaneSource> planes;
  std::vector<SumEdge> edges;
  std::vector<PointSource> vertices;
  std::vector<std::optional<SolidContact>> vertex_contacts;
  std::vector<Loop> loops;
  std::vector<std::uint32_t> corners;
  std::vector<SolidContact> contacts;
  std::vector<Face> faces;
  std::vector<Edge> boundary_edges;
  std::vector<TightFace> tight_faces;
  std::vector<TightSegment> tight_segments;
  std::vector<TightPoint> tight_points;
  std::uint32_t shells = 0;
  std::uint64_t face_vertex = 0, edge_edge = 0;  ///< facets of the convolution

  std::uint64_t bytes() const;
};

/// Requires a sum that sum_of_facets made, and the contacts that it made with it.
SumStructure structure_of(const SpatialSum& sum, CornerContacts corners);

/// The sum with this structure in the space of the operands at a pose, which gets the planes and edges of the
/// structure. Exact, in canonical order, where the sum at the pose has this structure; else a surface of these planes,
/// whose signed volume is well defined. Nothing where a tight face is seen from its other side there: what touches
/// beside its edges then is not kept.
std::optional<SpatialSum> placed(const SumStructure& structure, PosedSpace space);

}  // namespace dymsum::spatial
