// Bridges and their pockets: what a disc that touches the boundary at two positions cuts off.
#pragma once

#include <cstdint>
#include <optional>

#include "dymsum/shape_features.h"
#include "shape/features/boundary_loops.h"
#include "shape/features/chain_extremes.h"
#include "shape/features/position.h"

namespace dymsum::shape {

/// The segment between the two contacts of a disc on an edge of the complex. Its pocket lies to its left.
struct Bridge {
  Position from, to;
  std::uint32_t from_site = 0, to_site = 0;
  std::optional<BoundaryChain> pocket;  ///< from `from` to `to`; none for a gap between two loops
};

/// The chain of an edge's pocket, the same for all its bridges, and whether it is the one ahead: `from` is left then.
struct PocketSide {
  std::optional<BoundaryChain> chain;
  bool ahead = false;
};

/// The pocket lies behind the corner, where its disc comes from; but what bounds a region of finite size is a pocket,
/// so that at a neck, where one of two corners goes inward, it lies ahead of that one. O(1).
PocketSide pocket_side(const Complex& complex, const BoundaryLoops& loops, std::uint32_t edge);

/// The bridge at the upper end of an edge: of an unbounded one in the limit, between two vertices.
Bridge bridge_at_end(const Complex& complex, const BoundaryLoops& loops, std::uint32_t edge);
/// The bridge at radius r. Requires low radius <= r <= high radius, and an edge that is not flat.
Bridge bridge_at(const Complex& complex, const BoundaryLoops& loops, std::uint32_t edge, const Rational& r);

struct Deepest {
  std::uint32_t vertex = kNoIndex;  ///< of the loops
  double concavity = 0;             ///< the double nearest to the exact distance or length
};

/// The pocket minimum by a measure. Requires a bridge with a pocket. What is deepest is decided exactly for the
/// straight line; for shortest paths the doubles nearest to the lengths are compared. Of equally deep vertices by a
/// shortest path it is the one of the least canonical rank.
Deepest pocket_minimum(const BoundaryLoops& loops, const ChainExtremes& extremes, const Bridge& bridge,
                       const FeatureOptions& options);

}  // namespace dymsum::shape
