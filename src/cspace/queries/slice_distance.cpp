#include "cspace/queries/slice_distance.h"

namespace dymsum::cspace {
namespace {

void add_ring(const PlanarSum& slice, const SumRing& ring, Point from, NearestPosition& to) {
  for (std::size_t k = 0; k < ring.vertices.size(); ++k)
    to.add_segment(from, ring.vertices[k].at, ring.vertices[(k + 1) % ring.vertices.size()].at, 2 * slice.at_error);
}

NearestPosition nearest_edge(const PlanarSum& slice, Point from) {
  NearestPosition nearest;
  for (const SumPart& part : slice.parts) {
    add_ring(slice, part.outer, from, nearest);
    for (const SumRing& hole : part.holes) add_ring(slice, hole, from, nearest);
  }
  return nearest;
}

}  // namespace

// An obstacle has a slice at every angle (see Pivot::overlaps), and its position is a pair of finite doubles: none of
// the values below can be an error but where memory ends. A way of no length along which touching is forbidden is
// barred by overlaps and by contacts; an edge it touches is named.
SliceDistance::SliceDistance(const CspaceObstacle& obstacle, const Orientation& theta, Point from)
    : obstacle_(obstacle), theta_(theta), from_(from) {
  if (obstacle.contains(from.x, from.y, theta)) return;
  const TranslationCheck stand =
      check_translation(obstacle.robot(), obstacle.obstacle(), from, from, theta, Touching::forbidden).value();
  touching_ = !stand.free;
  on_edge_ = stand.contact.has_value();
}

NearestPosition SliceDistance::to_edges() const { return nearest_edge(obstacle_.slice(theta_).value(), from_); }

NearestPosition SliceDistance::to_boundary() const {
  const PlanarSum slice = obstacle_.slice(theta_, Semantics::open).value();
  NearestPosition nearest = nearest_edge(slice, from_);
  for (const SumSegment& s : slice.tight_segments) nearest.add_segment(from_, s.from.at, s.to.at, 2 * slice.at_error);
  for (const SumVertex& v : slice.tight_points) nearest.add_segment(from_, v.at, v.at, 2 * slice.at_error);
  return nearest;
}

}  // namespace dymsum::cspace
