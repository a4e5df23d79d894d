// The nodes at which the tracks of a complex begin, meet or end, and what is queried the pockets behind them.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "shape/complex/complex.h"

namespace dymsum::shape {

/// A position where tracks begin, meet or end: a node, or nodes that flat edges connect, which lie at one radius.
struct Junction {
  std::vector<std::uint32_t> nodes;    ///< ascending
  std::vector<std::uint32_t> in, out;  ///< edges that ascend to it and from it, ascending

  std::uint32_t node() const { return nodes.front(); }
};

/// All junctions in order of radius, and among equal ones of their first nodes. O(edges).
std::vector<Junction> junctions_of(const Complex& complex);

/// A loop vertex, or kNoIndex where a bridge has no pocket.
struct PocketMinimumAt {
  std::uint32_t vertex = kNoIndex;
  double concavity = 0;
};

/// The side on which the pocket of an edge's bridges lies, seen by a disc that grows along it: it has none between two
/// loops.
enum class PocketAt : std::uint8_t { gap, behind, ahead };

/// What tracks ask about the bridges at the upper ends of edges.
struct PocketOracle {
  std::function<PocketMinimumAt(std::uint32_t edge)> deepest;
  std::function<bool(std::uint32_t edge, std::uint32_t vertex)> holds;  ///< whether the pocket has the vertex inside
  std::function<PocketAt(std::uint32_t edge)> at;
  /// What its discs touch, by ranks that say nothing of indices.
  std::function<std::array<std::uint32_t, 4>(std::uint32_t edge)> contacts;
};

}  // namespace dymsum::shape
