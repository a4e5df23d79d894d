// The containment of a position in one exact slice of an obstacle, and how far it is from what bounds that.
#pragma once

#include "cspace/queries/segment_distance.h"
#include "dymsum/motion.h"

namespace dymsum::cspace {

class SliceDistance {
 public:
  SliceDistance(const CspaceObstacle& obstacle, const Orientation& theta, Point from);

  /// Exact: on the boundary of the open slice; on that of the closed one, where free positions without contact are
  /// near.
  bool touching() const { return touching_; }
  bool on_edge() const { return on_edge_; }
  /// The nearest point of the edges, and of the tight features of the slice too. A whole slice.
  NearestPosition to_edges() const;
  NearestPosition to_boundary() const;

 private:
  const CspaceObstacle& obstacle_;
  Orientation theta_;
  Point from_;
  bool touching_ = false, on_edge_ = false;
};

}  // namespace dymsum::cspace
