// Whether the robot provably overlaps the obstacle somewhere near an angle, in doubles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "cspace/events/event_window.h"
#include "planar/motion/turning_forms.h"

namespace dymsum::planar {

/// Used by one thread at a time: it remembers which edges crossed last.
class OverlapFilter {
 public:
  /// Edges have to be apart or cross by this fraction of the span, so that positions may err by kPosition, and by
  /// kMoves more because they are queried at a slightly different angle.
  static constexpr double kMargin = 0x1p-32, kPosition = 0x1p-36, kMoves = 0x1p-33;
  static_assert(kPosition + kMoves + 4 * kTurnedSide < kMargin);

  OverlapFilter(const TurningForms& forms, const EventWindow& window);

  /// True only if the open obstacle of angle h holds the position `at` (of the forms' doubles): edges cross properly,
  /// or one polygon lies in the other.
  bool inside(Point at, Heading h) const;
  /// True only if the open obstacle does not hold `at`, where the given contacts hold: all edges but those of the
  /// contacts are clearly apart, and neither polygon holds a vertex of the other.
  bool touches_only(Point at, Heading h, const std::vector<WalkSegment>& contacts) const;
  /// True only if a component of an operand holds x, of the operand's own doubles, in its interior, farther than `near`
  /// from its boundary.
  bool holds(std::uint32_t op, std::uint32_t component, Point x, Heading h, double near) const;

 private:
  using Node = EdgeTree::Node;
  struct Tree {
    std::vector<Node> nodes;
    std::vector<std::uint32_t> roots;  ///< per component
  };
  std::uint32_t build(Tree& tree, std::uint32_t op, std::uint32_t first, std::uint32_t last, double grow) const;
  bool edges_apart(std::uint32_t i, std::uint32_t j, Point at, Heading h) const;
  Point placed(std::uint32_t v, Point at, Heading h) const;
  bool cross(std::uint32_t i, Point c, Point d) const;
  bool recent_cross(Point at, Heading h) const;
  bool edges_cross(const Node& fixed, const Node& turning, Point at, Heading h) const;
  bool holds(std::uint32_t op, std::uint32_t component, Point x, Heading h) const {
    return holds(op, component, x, h, kMargin * forms_.span());
  }

  const TurningForms& forms_;
  const EventWindow& window_;
  Tree fixed_, turning_;
  // Pairs of edges that crossed, the last one first: they mostly cross at the next place too. Queried before the trees,
  // so that they change the time and never the answer.
  mutable std::array<std::pair<std::uint32_t, std::uint32_t>, 8> recent_{};
  mutable std::size_t known_ = 0;
};

}  // namespace dymsum::planar
