// What lies beyond a level: runs of boundary positions whose rays go on, and how they follow each other.
#pragma once

#include "shape/disc/boundary_order.h"
#include "shape/disc/level.h"

namespace dymsum::shape {

/// Positions of one walk, one after the other, whose discs grow beyond the level: from the item at which they begin to
/// that at which they end; a whole walk has no items.
struct Run {
  std::uint32_t loop = 0, from = kNoIndex, to = kNoIndex;
  bool whole() const { return from == kNoIndex; }
  friend bool operator==(const Run&, const Run&) = default;
};

/// Where several components meet at one node, rings keep those on one side of the boundary connected: the side of the
/// region that is walked round, or that of the discs.
enum class Connected : std::uint8_t { region, discs };

struct LevelRings {
  std::vector<Run> runs;
  std::vector<std::uint32_t> run_from;            ///< edge of the complex -> the run that begins on it, or kNoIndex
  std::vector<std::vector<std::uint32_t>> rings;  ///< of runs; whole walks are rings of their own
};

/// The edge at which the boundary goes on that came to a crossing of `edge`: itself, or at a node of the level where
/// the region stays connected that of the next component clockwise.
std::uint32_t edge_after(const Complex& complex, const Level& level, std::uint32_t edge, Connected connected);

/// Runs of positions whose edges of the complex lie beyond nodes [0, cut), with cut = level.below or level.up_to. Rings
/// that visit a node of the level twice are split there if `split`. O(n).
LevelRings level_rings(const Complex& complex, const BoundaryOrder& order, const Level& level, std::uint32_t cut,
                       Connected connected, bool split);

}  // namespace dymsum::shape
