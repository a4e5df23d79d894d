// Regions cut into nearly convex pieces at their lasting pockets. See docs/guide/shape-features.md.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "dymsum/progress.h"
#include "dymsum/rational.h"
#include "dymsum/region.h"
#include "dymsum/result.h"
#include "dymsum/shape_features.h"

namespace dymsum {

struct DecomposeOptions {
  /// Bars are cut at that are at least this significant (see ShapeFeatures::significant); 0: all.
  Rational persistence;
  Rational alpha_from;               ///< lives are counted between these diameters
  std::optional<Rational> alpha_to;  ///< none: infinity
  Progress progress = {};            ///< stages "significance", "cuts" and "pieces"
};

using RationalSegment = std::array<RationalPoint, 2>;

/// A segment from a reflex vertex to the boundary or to an earlier cut of the same part of the region. It lies in that
/// part but for the holes that it passes over, with whatever other parts are in these: its runs are what counts.
struct Cut {
  enum class End : std::uint8_t { vertex, edge, cut };
  std::uint32_t vertex = 0;  ///< of the region: where it begins
  End end = End::vertex;
  std::uint32_t index = 0;  ///< vertex or edge of the region, or earlier cut, that it ends at
  RationalPoint from, to;
  std::uint32_t bar = 0;  ///< the most significant bar whose minimum it begins at; of a partner that of the other cut
  bool partner = false;   ///< made at once with a cut that would have separated nothing without it
  std::vector<RationalSegment> runs;  ///< what of it separates pieces, in order: all but holes and their edges
  friend bool operator==(const Cut&, const Cut&) = default;
};

using RationalRing = std::vector<RationalPoint>;

/// A connected piece: outer ring counter-clockwise, holes clockwise. Rings are simple; they may touch at points. Each
/// begins at its vertex with the least x; where several have it, at that of them with the least y.
struct Piece {
  RationalRing outer;
  std::vector<RationalRing> holes;
  friend bool operator==(const Piece&, const Piece&) = default;
};

struct Decomposition {
  std::vector<Cut> cuts;      ///< in the order in which they were made
  std::vector<Piece> pieces;  ///< they tile the region: its connected components without the cuts, by first vertices
};

/// Cuts at the pocket minima of the bars that ShapeFeatures::significant reports, in its order. Every part of the
/// region is cut by itself: an island in a hole and what is around it do not know of each other. A cut resolves its
/// notch: it lies in the cone of the extensions of the two edges there, so that no angle beside it exceeds 180 degrees.
/// It ends at the nearest such point of its part's boundary or of an earlier cut of that part; of equally near ones at
/// a vertex whose own notch it resolves, then on the boundary. Ties are decided by geometry: where a ring begins, how
/// the region is turned by quarter turns or mirrored, and the order of its parts make no difference but for congruent
/// pieces. It passes over holes of its part that are less significant than the bar it is made for, unless an earlier
/// cut touches them: it does not count inside these, and its runs leave them out. Runs do not cross. Later cuts end at
/// such a hole as at others.
///
/// Every cut separates two pieces. One that alone connects a hole, or a group of holes, with the rest is not left so:
/// it gets a partner, a cut at a vertex of the convex hull of that group. That is the shortest of those that end
/// neither at that cut nor at one that begins in the group; where all do, the shortest of all, and then it gets a
/// partner in turn. Partners are made before the cuts of a less significant bar. So a significant hole is cut open, and
/// no piece has a slit.
///
/// What a bar is cut by depends on bars as significant or more alone: with a larger persistence the cuts are the first
/// ones of those with a smaller, and pieces are unions of theirs. Exact: a cut ends at a vertex or at the exact
/// rational foot. Nearly O(n log n) in practice. Errors: unsupported_operand for a region with polylines or points, or
/// whose rings touch; out_of_range for a negative persistence and alpha_to < alpha_from; cancelled.
Result<Decomposition> decompose(const ShapeFeatures& features, const DecomposeOptions& options = {});

/// A number for each piece from 0 on, for pictures: pieces with an edge in common have different ones. Those of
/// decompose() get at most six numbers, and have an edge in common wherever more than points of their boundaries meet.
/// O(n log n) for n edges of pieces.
std::vector<std::uint32_t> piece_colours(const Decomposition& decomposition);

/// Twice the exact area of a piece's ring, positive counter-clockwise.
Rational twice_area(const RationalRing& ring);

/// The pieces with every coordinate rounded to the nearest double. Errors: rounding_changed_topology where a piece is
/// no valid region then, with its index as the evidence's part, and what happens where.
Result<std::vector<Region>> rounded(const Decomposition& decomposition);
/// The pieces of rounded(), but of a piece that is no valid region then colliding vertices are merged, and rings that
/// collapse are dropped, as repair() does; where nothing is left of a piece its region is empty. Every report says what
/// was done. Errors: rounding_changed_topology where edges of a piece cross.
Result<std::vector<Repaired>> rounded_with_repair(const Decomposition& decomposition);

}  // namespace dymsum
