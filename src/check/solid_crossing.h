// Faces of a solid that cross the inside of convex cells, and cuts of these at such faces.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "check/solid_cell.h"
#include "spatial/mesh/box_tree.h"
#include "spatial/sum/exact_set.h"

namespace dymsum::check {

class SolidCrossing {
 public:
  /// Both outlive this.
  SolidCrossing(const spatial::ExactSet& set, PlaneTable& planes);

  const SpacePointRef& vertex(std::uint32_t v) const { return vertices_[v]; }
  std::vector<std::uint32_t> all() const;  ///< the triangles
  /// A cell that holds the solid.
  SolidCell box(PlaneTable& planes) const;

  /// Of these triangles all that may cross the inside of the cell: its planes do not separate them, nor theirs the
  /// cell from them.
  std::vector<std::uint32_t> crossing(const SolidCell& cell, const std::vector<std::uint32_t>& among);
  /// The cell cut at the plane of one of these, which lies near p; or halfway between many of them.
  /// Nothing where all planes miss the cell's inside.
  std::optional<HalvedSolidCell> cut(const SolidCell& cell, const std::vector<std::uint32_t>& crossing,
                                     const SpacePoint& p);
  /// Whether a position that is on no face is inside; nothing where it is above or below an edge.
  std::optional<bool> is_inside(const SpacePoint& p);

 private:
  std::uint32_t plane_of(std::uint32_t triangle);
  bool crosses(const SolidCell& cell, std::uint32_t triangle, bool by_plane);

  const spatial::ExactSet& set_;
  PlaneTable& planes_;
  std::vector<SpacePointRef> vertices_;
  std::vector<std::uint32_t> planes_of_;  // or kNone
  spatial::BoxTree tree_;
};

}  // namespace dymsum::check
