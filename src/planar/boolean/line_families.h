// Edges that are parallel but for rounding, of all regions together, and the axes of rings: those that they had before
// they were turned.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "dymsum/region_by_lines.h"

namespace dymsum::planar {

/// A ring, a polyline or the ring that a closed polyline is; edge k runs from vertex first + k of its region to the
/// next.
struct LineChain {
  std::size_t set = 0;  ///< whose region
  std::uint32_t first = 0, count = 0;
  bool closed = true;
  std::uint32_t edges() const { return closed ? count : count - 1; }
  std::uint32_t from(std::uint32_t edge) const { return first + edge; }
  std::uint32_t to(std::uint32_t edge) const { return first + (edge + 1 == count ? 0 : edge + 1); }
};

/// A region's vertices, ring by ring, in units in which squares of coordinates are doubles.
struct LineSet {
  std::vector<Point> at;
  double radius = 0;     ///< of the box about its midpoint
  double tolerance = 0;  ///< the most that a vertex may move
  double unit = 0;       ///< a power of two, at most a sixteenth of it, of which coordinates along axes are multiples
  bool rounded = false;  ///< by its digits: coordinates along the own axes that were equal are so
};

inline double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
inline double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
inline Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
inline Point quarter_turned(Point d) { return {-d.y, d.x}; }

/// Edges in one direction or its opposite.
struct LineFamily {
  Point direction;    ///< of length about 1 and few digits, in the upper half plane
  double length = 0;  ///< of its edges together
  std::uint32_t edges = 0;
  std::uint32_t across = 0xffffffff;  ///< the longer family that it is at a right angle to; none
  /// It says something: two edges at least, or at a right angle to another family, or along an axis of the coordinates.
  bool meant = false;
};

struct LineFamilies {
  static constexpr std::uint32_t kNone = 0xffffffff;
  std::vector<LineFamily> families;
  std::vector<std::vector<std::uint32_t>> of_edge;  ///< chain -> edge -> family; kNone for edges that are too short
};

/// Families around the longest edges: an edge belongs to the nearest one in whose direction it can be turned with its
/// ends moving by at most half the tolerance against each other. Directions are sums of the edges'; nearly along an
/// axis of the coordinates they are that, and nearly at a right angle to a longer family's exactly so. O(n log n).
LineFamilies line_families(const std::vector<LineSet>& sets, const std::vector<LineChain>& chains);

/// Two directions, the first the smaller one in the upper half plane: a positive determinant.
RingAxes axes_of(Point a, Point b);

/// The axes that a chain was drawn along: the directions of its longest meant families at a right angle to each other;
/// without such the longest one's, and the next one's that is no flat angle away, or else the right angle. Nothing
/// without meant families.
std::optional<RingAxes> chain_axes(const LineFamilies& found, const std::vector<LineSet>& sets,
                                   const std::vector<LineChain>& chains, std::size_t chain);

}  // namespace dymsum::planar
