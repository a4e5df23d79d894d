#include "spatial/sum/sum_trace.h"

#include <algorithm>
#include <cmath>

namespace dymsum::spatial {

namespace {

/// Positions on the grid in the operands' own coordinates, rounded.
class World {
 public:
  explicit World(const SumSpace& space) {
    for (int axis = 0; axis < 3; ++axis) {
      const SumSpace::Line line = space.line(axis);
      unit_[axis] = std::ldexp(1.0, line.exponent), offset_[axis] = line.p_offset + line.q_offset;
    }
  }
  Point3 operator()(Vec3 v) const {
    return {v.x * unit_[0] + offset_[0], v.y * unit_[1] + offset_[1], v.z * unit_[2] + offset_[2]};
  }

 private:
  double unit_[3], offset_[3];
};

}  // namespace

SpatialTrace trace_of(const SolidBoundary& boundary) {
  SpatialTrace trace;
  const SumSpace& space = *boundary.space;
  const World world(space);
  for (const TableFacet& f : boundary.table.facets) {
    SpatialTrace::Facet& facet = trace.facets.emplace_back();
    facet.kind = static_cast<SpatialTrace::Facet::Kind>(f.facet.kind);
    for (int k = 0; k < f.facet.corners; ++k) facet.corners.push_back(world(space.approx(f.facet.corner[k])));
  }
  const SolidArrangement& arrangement = *boundary.arrangement;
  std::vector<std::array<PointId, 2>> pieces;
  for (const PlaneGroup& group : arrangement.groups) {
    for (const CellEdge& e : group.cells.edges) {
      const PointId a = arrangement.point(group, e.a), b = arrangement.point(group, e.b);
      // What runs through facets, not around them.
      if (e.left != kNoId && e.right != kNoId) pieces.push_back({std::min(a, b), std::max(a, b)});
    }
  }
  std::sort(pieces.begin(), pieces.end());
  pieces.erase(std::unique(pieces.begin(), pieces.end()), pieces.end());
  for (const auto& [a, b] : pieces)
    trace.pieces.push_back({world(arrangement.points.approx(a).at), world(arrangement.points.approx(b).at)});
  return trace;
}

}  // namespace dymsum::spatial
