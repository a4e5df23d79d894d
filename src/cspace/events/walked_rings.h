// The rings of a robot or an obstacle as contacts name their vertices and edges: those of the parts, then every
// polyline walked there and back, a ring of 2 (n - 1) vertices for one of n, then every point, a ring of one.
#pragma once

#include <optional>

#include "dymsum/region.h"
#include "dymsum/result.h"

namespace dymsum::planar {

/// Coordinates of robots, obstacles and positions are at most this.
inline constexpr double kLargestCoordinate = 0x1p400;

/// Whether some of it has no area.
inline bool has_thin_pieces(const Region& r) { return !r.polylines().empty() || !r.points().empty(); }

/// The error for operands that no robot and obstacle can be: where neither of two pieces has area their sum has no rule
/// that determines which of their meetings overlap.
inline std::optional<Error> refused_pair(const Region& robot, const Region& obstacle) {
  if (robot.empty() || obstacle.empty())
    return Error{ErrorCode::unsupported_operand, "robot and obstacle may not be empty", {}};
  if (has_thin_pieces(robot) && has_thin_pieces(obstacle))
    return Error{ErrorCode::unsupported_operand,
                 "robot and obstacle both have polylines or points: two pieces without area never overlap, so that "
                 "they would pass through each other; "
                 "give one of them an area",
                 {}};
  return std::nullopt;
}

/// A position from which a polyline runs along another one, along itself, or along an edge of a part, for an interval.
/// O(n^2) for n edges, most of them distinguished by their positions in x.
std::optional<Point> overlapping_polylines(const Region& r);

/// A polyline walked there and back.
inline Ring walked(const Polyline& line) {
  Ring ring(line);
  for (std::size_t k = line.size() - 1; k-- > 1;) ring.push_back(line[k]);
  return ring;
}

/// How many vertices all rings have.
inline std::size_t walked_vertices(const Region& r) {
  std::size_t n = r.vertex_count();
  for (const Polyline& line : r.polylines()) n += line.size() - 2;
  return n;
}

/// Calls f(ring) for every ring.
template <class F>
void for_each_ring(const Region& region, F&& f) {
  for (const Part& part : region.parts()) {
    f(part.outer);
    for (const Ring& hole : part.holes) f(hole);
  }
  for (const Polyline& line : region.polylines()) f(walked(line));
  for (const Point& point : region.points()) f(Ring{point});
}

}  // namespace dymsum::planar
