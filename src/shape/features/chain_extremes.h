// The vertex of a chain of the boundary that lies farthest to the left of a line.
#pragma once

#include <cstdint>
#include <vector>

#include "shape/features/boundary_loops.h"
#include "shape/features/position.h"

namespace dymsum::shape {

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

}  // namespace dymsum::shape
