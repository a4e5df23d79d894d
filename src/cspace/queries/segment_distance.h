// Distances of points to segments, in doubles with bounds.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "dymsum/cspace_obstacle.h"
#include "exact/rounding_bound.h"

namespace dymsum::cspace {

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

}  // namespace dymsum::cspace
