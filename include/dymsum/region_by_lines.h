// Regions by their lines: edges as they were meant, before coordinates were turned, or rounded to doubles, to single
// precision, to decimals.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dymsum/planar_sum.h"
#include "dymsum/region.h"
#include "dymsum/result.h"

namespace dymsum {

/// The directions of a ring's axes: doubles of few digits.
using RingAxes = std::array<Point, 2>;

struct LinesOptions {
  /// The most that a vertex may move. Nothing: 2^-40 of the region's size; 8 units of the last digit where all
  /// coordinates are rounded to single precision, or to decimals, and need nearly all of these digits; at least 64 ulps
  /// of the largest coordinate.
  std::optional<double> tolerance;
  SumOptions sums;  ///< memory and progress of the union that makes the region
};

struct RegionByLines {
  /// The region: exact, canonical. An operand like every result.
  PlanarSum region;
  std::vector<RingAxes> axes;   ///< of the region's rings and lines, other than those of the coordinates: each once
  double tolerance = 0;         ///< that held
  double largest_move = 0;      ///< no vertex is further from where it was; proved
  std::size_t merged = 0;       ///< coordinates along an axis, and lines, that became one with another one
  std::size_t loose_edges = 0;  ///< edges parallel to others but for rounding that stay so: vertices would move too far
  std::size_t edges = 0;        ///< of the data
  std::string to_string() const;  ///< "12 edges became 8, along axes of their own; no vertex moved by more than 2e-16"
};

/// The region whose edges lie on the lines that they were meant to lie on. Edges that are parallel but for rounding are
/// parallel exactly, in whatever direction; edges next to one line lie on it, so that vertices between them go; edges
/// at right angles to others are so exactly. Rings turned alike have the coordinates that they had, rounded to a
/// sixteenth of the tolerance, from their midpoint on: equal lengths are equal, and a part with edges at right angles
/// fits its turned slot where lengths are multiples of that unit, else mostly. Vertices are where lines meet:
/// fractions, or doubles along the coordinates' own axes (docs/design/region-by-lines.md). The data are rings `filled`
/// takes, by positive winding numbers: they may touch or overlap within the tolerance. Polylines have lines like rings;
/// points stay. Errors: not_finite; too_few_vertices and repeated_vertex of polylines; out_of_range for a tolerance
/// that is not positive and finite or below the least that is named above, with that; no_area where nothing is left; as
/// filled. Cost: O(n log n) for n vertices, besides filled.
Result<RegionByLines> by_lines(const RegionData& data, const LinesOptions& options = {});

/// The same of several regions, in their order: what is parallel in two of them is so exactly, and rings have axes in
/// common where none of them loses by that. The order does not matter.
Result<std::vector<RegionByLines>> by_lines(std::span<const RegionData> regions, const LinesOptions& options = {});

}  // namespace dymsum
