// Robots without area: a single segment or a single point. Walked round, a segment is a ring of two vertices, there and back, and a point a
// ring of one. Where contacts of an obstacle are named, edge 0 of a segment leads from its first vertex to its second one, and edge 1 back.
#pragma once

#include <optional>

#include "dymsum/region.h"
#include "dymsum/result.h"

namespace dymsum::planar {

inline bool is_segment(const Region& r) {
  return r.parts().empty() && r.points().empty() && r.polylines().size() == 1 && r.polylines()[0].size() == 2;
}
inline bool is_point(const Region& r) { return r.parts().empty() && r.polylines().empty() && r.points().size() == 1; }
/// What may turn: parts with area, one segment, or one point.
inline bool may_be_robot(const Region& r) {
  return (!r.parts().empty() && r.polylines().empty() && r.points().empty()) || is_segment(r) || is_point(r);
}
/// What it may overlap: parts with area.
inline bool may_be_obstacle(const Region& r) { return !r.parts().empty() && r.polylines().empty() && r.points().empty(); }

/// The error for operands that no robot and obstacle can be.
inline std::optional<Error> refused_pair(const Region& robot, const Region& obstacle) {
  if (robot.empty() || obstacle.empty())
    return Error{Code::unsupported_operand, "robot and obstacle may not be empty", {}};
  if (!may_be_robot(robot))
    return Error{Code::unsupported_operand, "the robot consists of parts with area, or is one segment or one point; longer polylines and several pieces without area are not supported", {}};
  if (!may_be_obstacle(obstacle))
    return Error{Code::unsupported_operand, "the obstacle consists of parts with area, not of polylines or points", {}};
  return std::nullopt;
}

/// Calls f(ring) for every ring of a region, in the order of its vertices. Requires: may_be_robot.
template <class F>
void for_each_ring(const Region& region, F&& f) {
  for (const Part& part : region.parts()) {
    f(part.outer);
    for (const Ring& hole : part.holes) f(hole);
  }
  for (const Polyline& segment : region.polylines()) f(segment);
  if (!region.points().empty()) f(region.points());
}

}  // namespace dymsum::planar
