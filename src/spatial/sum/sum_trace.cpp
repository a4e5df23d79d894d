#include "spatial/sum/sum_trace.h"

#include <algorithm>
#include <cmath>

namespace dymsum::spatial {

namespace {

/// A space's doubles in the operands' own coordinates, rounded.
class World {
 public:
  explicit World(const SumSpace& space) {
    for (int axis = 0; axis < 3; ++axis) {
      const SumSpace::Line line = space.line(axis);
      unit_[axis] = std::ldexp(1.0, line.unit), offset_[axis] = line.p_offset + line.q_offset;
    }
  }
  Point3 operator()(Vec3 v) const {
    return {v.x * unit_[0] + offset_[0], v.y * unit_[1] + offset_[1], v.z * unit_[2] + offset_[2]};
  }

 private:
  double unit_[3], offset_[3];
};

}  // namespace

SpatialTrace trace_of(const SolidBoundary& boundary, StageWatch& watch) {
  SpatialTrace trace;
  watch.hold(boundary.table.facets.size() * (sizeof(SpatialTrace::Facet) + 4 * sizeof(Point3)));
  trace.facets.reserve(boundary.table.facets.size());
  const SumSpace& space = *boundary.space;
  const World world(space);
  for (const TableFacet& f : boundary.table.facets) {
    SpatialTrace::Facet& facet = trace.facets.emplace_back();
    facet.corners.reserve(static_cast<std::size_t>(f.facet.corners));
    facet.kind = static_cast<SpatialTrace::Facet::Kind>(f.facet.kind);
    for (int k = 0; k < f.facet.corners; ++k) facet.corners.push_back(world(space.approx(f.facet.corner[k])));
  }
  const SolidArrangement& arrangement = *boundary.arrangement;
  // What runs through facets, not around them.
  const auto inside = [&](std::uint32_t edge) {
    const auto uses = arrangement.uses(edge);
    return std::any_of(uses.begin(), uses.end(), [&](EdgeUse use) {
      const CellEdge& e = arrangement.edge(use);
      return e.left != kNoId && e.right != kNoId;
    });
  };
  watch.hold(arrangement.edge_ends.size() * sizeof(trace.pieces[0]));
  trace.pieces.reserve(arrangement.edge_ends.size());
  for (std::uint32_t edge = 0; edge < arrangement.edge_ends.size(); ++edge) {
    if (!inside(edge)) continue;
    const auto [a, b] = arrangement.edge_ends[edge];
    trace.pieces.push_back({world(arrangement.points.approx(a).at), world(arrangement.points.approx(b).at)});
  }
  return trace;
}

}  // namespace dymsum::spatial
