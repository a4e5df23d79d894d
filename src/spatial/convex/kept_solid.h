// A finished solid kept beside an overlay: what differs from the overlay as the solid last saw it is found by comparing
// the two, so nothing can be missed, whatever moved in between.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "dymsum/convex_solid.h"
#include "spatial/convex/facet_corners.h"
#include "spatial/convex/nearest_positions.h"
#include "spatial/convex/pair_index.h"
#include "spatial/gauss/overlay.h"

namespace dymsum::spatial {

class KeptSolid {
 public:
  /// Of nothing yet. `operands` has to outlive this.
  KeptSolid(const Overlay& overlay, const ConvexOperands& operands);

  /// Makes it the solid of the overlay, which is that of the same operands, at these poses.
  void follow(const Overlay& overlay, const SolidPose& p, const SolidPose& q);
  const ConvexSolid& solid() const { return solid_; }
  /// Memory held.
  std::size_t bytes() const;

 private:
  enum class Look : std::uint8_t {
    plain,  ///< nothing is truly zero: the overlay's words say what the facet is
    close,  ///< something may be truly zero: looked at exactly
  };
  struct Counts {
    std::uint32_t before, now, kept;
  };
  struct Edges {
    std::uint32_t p, q;
    std::uint64_t key() const { return std::uint64_t{p} << 32 | q / 2; }
  };
  /// A crossing that another one was before, or will be: its edges, and its slot or index.
  struct Moved {
    std::uint64_t key;
    std::uint32_t at;
  };
  static Edges edges_now(const Overlay& overlay, std::uint32_t crossing);
  std::uint32_t facet_of(int op, std::uint32_t f) const { return op == 0 ? f : p_faces_ + f; }
  std::uint32_t facet_of(std::uint32_t crossing) const { return p_faces_ + q_faces_ + slot_[crossing]; }
  void add_crossings(const Overlay& overlay);
  void keep_slots(const Overlay& overlay);
  void find_close(const Overlay& overlay);
  void follow_faces(const Overlay& overlay);
  void follow_crossings(const Overlay& overlay);
  void change(std::uint32_t facet, const FacetFeatures& features, bool same);
  bool is_as_before(std::uint32_t facet) const;
  void allot(std::uint32_t facet, std::uint32_t corners);
  void note(std::uint32_t facet, bool same, const Counts& corners);
  std::uint32_t vertex_of(VertexPair pair);
  void drop_unused_vertices();
  void name_new_vertices(const Overlay& overlay);
  void join_ranges();

  ConvexSolid solid_;
  std::uint32_t p_faces_, q_faces_;
  // The overlay's words as they were.
  std::array<std::vector<std::uint32_t>, 2> extreme_;
  std::vector<Edges> crossed_;         // by slots
  std::vector<std::uint32_t> slot_;    // of the overlay's crossings: which facet behind those of the faces
  std::vector<Moved> before_, now_;    // scratch of keep_slots
  std::vector<std::uint32_t> vacant_;  // the same
  std::vector<Look> look_, look_before_;
  std::vector<std::uint32_t> room_;  // of each facet, for corners; two less for triangles
  // Of vertices: their pairs, how many corners of facets are there, and when they were seen last.
  std::vector<VertexPair> pair_;
  std::vector<std::uint32_t> uses_, seen_;
  std::vector<std::uint32_t> free_vertices_, unused_;
  PairIndex index_;
  NearestPositions positions_;
  std::vector<VertexPair> corners_;  // of the facet at hand
  std::uint32_t stamp_ = 0;
};

}  // namespace dymsum::spatial
