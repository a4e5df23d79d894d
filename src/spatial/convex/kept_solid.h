// A finished solid kept beside an overlay: what differs from the overlay as the solid last saw it is found by comparing
// the two, so nothing can be missed, whatever moved in between.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "dymsum/convex_solid.h"
#include "spatial/convex/close_facets.h"
#include "spatial/convex/crossing_slots.h"
#include "spatial/convex/facet_corners.h"
#include "spatial/convex/kept_vertices.h"
#include "spatial/convex/nearest_positions.h"
#include "spatial/gauss/overlay.h"

namespace dymsum::spatial {

class KeptSolid {
 public:
  /// Holds nothing yet. `operands` has to outlive this.
  KeptSolid(const Overlay& overlay, const ConvexOperands& operands);

  /// Makes it the solid of the overlay, which is that of the same operands, at these poses.
  void follow(const Overlay& overlay, const SolidPose& p, const SolidPose& q);
  const ConvexSolid& solid() const { return solid_; }
  /// Memory held.
  std::size_t bytes() const;

 private:
  struct Counts {
    std::uint32_t before, now, kept;
  };
  std::uint32_t facet_of(int op, std::uint32_t f) const { return op == 0 ? f : p_faces_ + f; }
  std::uint32_t facet_of(std::uint32_t crossing) const { return p_faces_ + q_faces_ + slots_.of(crossing); }
  void add_crossings(const Overlay& overlay);
  void follow_faces(const Overlay& overlay);
  void follow_crossings(const Overlay& overlay);
  void change(std::uint32_t facet, const FacetFeatures& features, bool same);
  bool is_as_before(std::uint32_t facet) const;
  void add_facet(std::uint32_t corners);
  void allot(std::uint32_t facet, std::uint32_t corners);
  void note(std::uint32_t facet, bool same, const Counts& corners);
  void add_vertex(std::uint32_t v);
  void drop_unused_vertices();
  void name_new_vertices(const Overlay& overlay);
  void join_ranges();

  ConvexSolid solid_;
  std::uint32_t p_faces_, q_faces_;
  // The overlay's words as they were.
  std::array<std::vector<std::uint32_t>, 2> extreme_;
  CrossingSlots slots_;  // facets after those of the faces
  CloseFacets close_;
  std::vector<std::uint8_t> was_close_;  // of each facet
  std::vector<std::uint32_t> room_;      // of each facet, for corners; two less for triangles
  KeptVertices vertices_;
  NearestPositions positions_;
  std::vector<VertexPair> corners_;  // of the facet at hand
};

}  // namespace dymsum::spatial
