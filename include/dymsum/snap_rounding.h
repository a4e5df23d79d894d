// Every planar sum as polygons of doubles: rounded to the nearest doubles where these are such polygons, and otherwise
// by snap rounding, with a report of what that did.
#pragma once

#include <cstddef>
#include <string>

#include "dymsum/planar_sum.h"

namespace dymsum {

/// What became of an exact set in doubles.
struct Rounding {
  bool nearest = true;              ///< as PlanarSum::rounded: nothing happened but that; the counts are 0
  std::size_t merged_vertices = 0;  ///< positions that have the nearest doubles of another one
  std::size_t collapsed_edges = 0;  ///< edges whose ends are one
  std::size_t bends = 0;            ///< where edges cross or touch in doubles that did not, each got a vertex there
  std::size_t lines = 0;            ///< polylines for what is thinner than rounding
  std::size_t points = 0;           ///< points for what is smaller
  std::size_t vanished_rings = 0;   ///< gaps that closed, and parts that lie within others now
  /// The distance of what moved, in the unit of the coordinates: every point of the set is at most this far from the
  /// region, every point of the region from the set, and every point of its boundary from the exact boundary.
  double moved = 0;
  double moved_ulps = 0;  ///< moved, in units in the last place of the largest coordinate
  /// "2 vertices merged, 1 edge collapsed, ...; moved by at most 3e-16"; "nearest doubles".
  std::string to_string() const;
  friend bool operator==(const Rounding&, const Rounding&) = default;
};

struct SnapRounded {
  Region region;
  Rounding rounding;
};

/// The set of a sum in doubles. PlanarSum::rounded where that has an answer. Otherwise the nearest doubles of its
/// vertices, edges between them cut at the nearest doubles of crossings until none cross, and the set where the
/// boundary winds round more often counter-clockwise; what has become thinner than doubles is polylines and points, and
/// gaps that thin are closed. Tight features are not part of the set. Error rounding_changed_topology only for
/// coordinates past the double range. Cost: as rounded; where it is not that, as well O(n log n + m), a few times, for
/// n edges and m pairs of edges with overlapping x ranges.
Result<SnapRounded> snap_rounded(const PlanarSum& sum);

}  // namespace dymsum
