// The order in which the faces of a Gauss map are visited, each from another one.
#pragma once

#include <cstdint>
#include <vector>

#include "spatial/gauss/polytope.h"

namespace dymsum::spatial {

/// All faces, each but the first after a neighbour.
struct FaceVisits {
  struct Visit {
    std::uint32_t face, from;  ///< and that neighbour
    HalfEdge via;              ///< its half-edge between them
    /// A face before it to climb from: the neighbour, or, round a face of many edges, the one visited from there just
    /// before, as neighbours round such a face are closer to each other than to it.
    std::uint32_t near;
  };
  std::vector<Visit> all;

  explicit FaceVisits(const Polytope& solid);
};

/// How moves walk along all arcs of one operand: from face to face by its visits, then along the rest.
struct ArcPlan {
  std::vector<std::uint32_t> levels;  ///< where visits as far from the first face begin; one more at the end
  std::vector<std::uint32_t> chords;  ///< edges that no visit goes by

  ArcPlan(const Polytope& solid, const FaceVisits& visits);
};

}  // namespace dymsum::spatial
