// The rings of a robot or an obstacle as contacts name their vertices and edges: those of the parts, then every
// polyline walked there and back, a ring of 2 (n - 1) vertices for one of n, then every point, a ring of one.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "dymsum/region.h"
#include "dymsum/result.h"
#include "planar/motion/turning_forms.h"

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

// Regions whose rings touch: several walk vertices may have one number, and an edge that is cut where a ring touches it
// is several walk edges. Numbers of walks are unique.

/// The same base, but contacts name the vertices and edges of its walked rings (walked_rings.h), so that the two sides
/// of a polyline differ.
std::shared_ptr<const OperandPair> numbered_there_and_back(const OperandPair& base,
                                                           const std::array<const Region*, 2>& regions);

/// The same base, but contacts in its slices name walk edges and walk vertices.
std::shared_ptr<const OperandPair> numbered_by_walk(const OperandPair& base);

/// Appends the segments from the first to the last one along an edge of a slice's ring. Where the boundary goes
/// straight on at a touching point, from one edge of a region to another, the slice has no vertex, and names the two
/// where its edge begins and where it ends: here what lies between follows.
void append_run(WalkSegment first, const WalkSegment& last, const TurningForms& forms, std::vector<WalkSegment>& to);

/// Whether one segment ends where the other starts, at every angle: in a common pair of vertices, whichever visits of
/// them.
bool meet_at_ends(const TurningForms& forms, const WalkSegment& s, const WalkSegment& t);

/// The ends of walk edges that are ends of the region's edges, and not cuts.
class EdgeEnds {
 public:
  /// `operand`: of the region, or of its reflection.
  EdgeEnds(const Region& region, const Operand& operand);
  bool starts(std::uint32_t walk_edge) const { return starts_[walk_edge]; }
  bool ends(std::uint32_t walk_edge) const { return ends_[walk_edge]; }

 private:
  std::vector<bool> starts_, ends_;
};

}  // namespace dymsum::planar
