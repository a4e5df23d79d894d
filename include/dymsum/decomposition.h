// Regions cut into nearly convex pieces at their lasting pockets. See docs/guide/shape-features.md.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "dymsum/rational.h"
#include "dymsum/region.h"
#include "dymsum/result.h"
#include "dymsum/shape_features.h"

namespace dymsum {

struct DecomposeOptions {
  /// Bars are cut at that last at least this long and whose pocket is at least this deep; 0: all.
  Rational persistence;
  Rational alpha_from;               ///< lives are counted between these diameters
  std::optional<Rational> alpha_to;  ///< none: infinity
};

/// A segment inside the region from a reflex vertex to the boundary or to an earlier cut.
struct Cut {
  enum class End : std::uint8_t { vertex, edge, cut };
  std::uint32_t vertex = 0;  ///< of the region: where it begins
  End end = End::vertex;
  std::uint32_t index = 0;  ///< vertex or edge of the region, or earlier cut, that it ends at
  RationalPoint from, to;
  std::uint32_t bar = 0;  ///< the most significant bar whose minimum it begins at
  friend bool operator==(const Cut&, const Cut&) = default;
};

using RationalRing = std::vector<RationalPoint>;

/// A connected piece: outer ring counter-clockwise, holes clockwise.
struct Piece {
  RationalRing outer;
  std::vector<RationalRing> holes;
  friend bool operator==(const Piece&, const Piece&) = default;
};

struct Decomposition {
  std::vector<Cut> cuts;      ///< in the order in which they were made
  std::vector<Piece> pieces;  ///< they tile the region: its connected components without the cuts
};

/// Cuts at the pocket minima of the bars that ShapeFeatures::significant tells, in its order. A cut resolves its notch:
/// it lies in the cone of the extensions of the two edges there, so that no angle beside it exceeds 180 degrees. It
/// ends at the nearest such point of the boundary or of an earlier cut. Cuts do not cross. They pass over holes that
/// are less significant than the bar they are made for, and the pieces lack these. What a bar is cut by depends on bars
/// as significant or more alone: with a larger persistence the cuts are the first ones of those with a smaller. Exact:
/// a cut ends at a vertex or at the exact rational foot. Errors: unsupported_operand for a region with polylines or
/// points, or whose rings touch; out_of_range for a negative persistence and alpha_to < alpha_from.
Result<Decomposition> decompose(const ShapeFeatures& features, const DecomposeOptions& options = {});

/// Twice the exact area of a piece's ring, positive counter-clockwise.
Rational twice_area(const RationalRing& ring);

/// The pieces with every coordinate rounded to the nearest double. Errors: rounding_changed_topology where a piece is
/// no valid region then.
Result<std::vector<Region>> rounded(const Decomposition& decomposition);

}  // namespace dymsum
