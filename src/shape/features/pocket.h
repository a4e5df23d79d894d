// Bridges and their pockets: what a disc that touches the boundary at two positions cuts off.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "dymsum/shape_features.h"
#include "shape/features/boundary_loops.h"
#include "shape/features/position.h"

namespace dymsum::shape {

// The vertex of a chain of the boundary that lies farthest to the left of a line.

/// Convex hulls of the runs of a binary tree over all loops.
class ChainExtremes {
 public:
  /// O(n log n). Keeps a reference.
  explicit ChainExtremes(const BoundaryLoops& loops);

  /// The vertex of the chain that is farthest to the left of the directed line a -> b; of several, of the first and the
  /// last one in its direction, the one of the lesser canonical rank. Exact. O(log^2 n) signs.
  std::uint32_t farthest(const BoundaryChain& chain, const Position& a, const Position& b) const;

 private:
  struct Hull {
    std::vector<std::uint32_t> upper, lower;  ///< from left to right, without vertices inside their edges
  };
  struct Line {
    const Position &a, &b;
    int dx = 0;         ///< sign of b.x - a.x
    int wanted = -1;    ///< of equally far ones: -1 the first, 1 the last
    bool tied = false;  ///< there were some
  };
  std::uint32_t farthest_on(Line& line, const BoundaryChain& chain) const;
  bool better(Line& line, std::uint32_t v, std::uint32_t than) const;
  void see(Line& line, std::uint32_t v, std::uint32_t& best) const;
  void see_run(Line& line, std::uint32_t first, std::uint32_t end, std::uint32_t& best) const;
  void see_hull(Line& line, const Hull& hull, std::uint32_t& best) const;

  const BoundaryLoops* loops_;
  std::vector<std::vector<Hull>> levels_;  ///< level k: runs of kRun 2^k vertices
};

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
