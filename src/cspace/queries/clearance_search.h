// The signed distance of a configuration to the boundary of an obstacle: its patches and its tight placements.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "cspace/queries/nearest_patch.h"
#include "dymsum/cspace_obstacle.h"
#include "dymsum/motion.h"
#include "dymsum/obstacle_queries.h"
#include "exact/rounding_bound.h"

namespace dymsum::cspace {

// Distances of points to segments, in doubles with bounds.

/// The error of the distance of a point from a segment is this times the sum M of all coordinates. Vectors between the
/// points are at most M long. The unit vector errs by 6 of itself, the position along the segment by 6 + 3, the foot by
/// 9 and two more operations of as much, the distance by the difference and its length.
inline constexpr double kSegmentDistance = exact::rounding_bound(9 + 6 + 4 + 3, 128);

/// The nearest point of one of several sets: the exact distance to it differs from `distance` by at most `error`, and
/// no point of the sets is nearer than `least`.
struct NearestPosition {
  double distance = std::numeric_limits<double>::infinity(), error = 0;
  double least = std::numeric_limits<double>::infinity();
  Point at;

  /// A segment from a to b, the ends of which err by at most `off`.
  void add_segment(Point from, Point a, Point b, double off) {
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    const double ux = length > 0 ? (b.x - a.x) / length : 1, uy = length > 0 ? (b.y - a.y) / length : 0;
    const double along = std::clamp((from.x - a.x) * ux + (from.y - a.y) * uy, 0.0, length);
    const Point foot{a.x + along * ux, a.y + along * uy};
    const double size =
        std::abs(from.x) + std::abs(from.y) + std::abs(a.x) + std::abs(a.y) + std::abs(b.x) + std::abs(b.y);
    add(std::hypot(from.x - foot.x, from.y - foot.y), off + kSegmentDistance * size, foot);
  }
  void add(double d, double off, Point foot) {
    least = std::min(least, d - off);
    if (!(d + off < distance + error)) return;
    distance = d;
    error = off;
    at = foot;
  }
  /// The least distance differs from `distance` by at most this.
  double total_error() const { return std::max(error, distance - least); }
};

// The containment of a position in one exact slice of an obstacle, and how far it is from what bounds that.

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

// How far a configuration is from the tight placements of an obstacle.

struct NearestTight {
  NearestPosition position;  ///< by the metric dx^2 + dy^2 + weight^2 dtheta^2; infinitely far where nothing is tight
  double theta = 0;          ///< of the nearest one
};

/// The nearest of all tight features, tried one after the other. `from.theta` in [-pi, pi], within 2^-50 of the angle
/// that is meant; a finite weight.
NearestTight nearest_tight(const CspaceObstacle& obstacle, const Configuration& from, double weight);

/// `from.theta` in [-pi, pi], within 2^-50 of Orientation::nearest(asked).
struct ClearanceQuestion {
  Configuration from;
  double queried = 0;
  double weight = 0;
  Touching touching = Touching::allowed;
  bool overlaps = false;        ///< exactly
  bool provably_apart = false;  ///< neither overlaps nor touches, as patches decide
};

class ClearanceSearch {
 public:
  ClearanceSearch(const CspaceObstacle& obstacle, const PatchForms& forms, const PatchTree& tree)
      : obstacle_(obstacle), forms_(forms), tree_(tree) {}

  struct Answer {
    Clearance clearance;
    std::uint64_t bounds = 0;
  };
  Answer run(const ClearanceQuestion& q) const {
    return std::isinf(q.weight) ? translation(q) : no_farther_than_translation(q, any(q));
  }

 private:
  Answer any(const ClearanceQuestion& q) const;
  Answer translation(const ClearanceQuestion& q) const;
  /// The answer where doubles know little of what is near at other angles.
  Answer no_farther_than_translation(const ClearanceQuestion& q, Answer answer) const;
  Answer by_slice(const ClearanceQuestion& q) const;
  Answer touching(const ClearanceQuestion& q, const NearestPatch& found, bool on_edge) const;
  /// The nearest patch at any angle, or at the question's own; lengths in the coordinates of the obstacle, positions
  /// absolute.
  NearestPatch nearest(const ClearanceQuestion& q, bool whole_edges) const;
  NearestPatch nearest_at(const ClearanceQuestion& q) const;
  NearestPatch on_boundary(const ClearanceQuestion& q, const NearestPatch& found) const;
  template <class Search>
  NearestPatch in_coordinates(const ClearanceQuestion& q, bool whole_edges, Search search) const;
  SliceDistance slice_of(const ClearanceQuestion& q) const;
  bool near_event(double theta) const;

  const CspaceObstacle& obstacle_;
  const PatchForms& forms_;
  const PatchTree& tree_;
};

}  // namespace dymsum::cspace
