// Whether the robot provably overlaps the obstacle somewhere near an angle, in doubles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "cspace/events/near_angle.h"
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

// Points in the interior of both operands, well away from their boundaries: where one of them lies deep in the other
// operand the two overlap, also where all that is near are edges that run along each other.

class InnerPoints {
 public:
  /// One beside each edge where there is room.
  InnerPoints(const TurningForms& forms, const OverlapFilter& filter);

  /// Asked about one heading and margin only. True only if the open sum of heading h holds `at` (of the forms' doubles)
  /// and all positions within `margin` of it, at all angles at which the operand that turns moves by no more than the
  /// rest of `margin`.
  bool inside(Point at, Heading h, double margin);

 private:
  bool find(Point at, Heading h, double margin);
  bool inside(std::uint32_t op, std::size_t k, Point at, Heading h, double margin) const;

  const TurningForms& forms_;
  const OverlapFilter& filter_;
  std::array<std::vector<Point>, 2> points_;
  std::array<std::size_t, 2> last_{};  // what answered last
  // Answers for cells of the plane, of one heading and margin.
  std::map<std::array<std::int64_t, 2>, bool> known_;
};

// What lies beside the edges of an operand: where a point that is a little to the left of an edge's line is provably
// in its interior.

class EdgeAprons {
 public:
  /// Points that lie at most `depth` to the left of an edge's line.
  EdgeAprons(const TurningForms& forms, double depth) : forms_(forms), depth_(depth) {
    for (std::uint32_t op = 0; op < 2; ++op) clear_[op].assign(forms.size(op), kUnknown);
  }

  enum class Beside : std::uint8_t {
    no,    ///< nothing is known of it
    edge,  ///< in the interior, if left of the edge
    prev,  ///< if left of the edge and of the one before it
    next,  ///< of the one after it
  };
  /// What lies beside a point at `along` (a length along an edge from its start) and `left` of its line, both of which
  /// may err by a quarter of the depth. Sharp corners, edges that are not much longer than the depth or near to others,
  /// and pieces without area: no.
  Beside beside(std::uint32_t op, std::uint32_t edge, double along, double left);

 private:
  static constexpr std::uint8_t kUnknown = 2;
  bool clear(std::uint32_t op, std::uint32_t edge) const;
  bool blunt(std::uint32_t op, std::uint32_t edge, std::uint32_t next) const;

  const TurningForms& forms_;
  double depth_;
  std::array<std::vector<std::uint8_t>, 2> clear_;
};

}  // namespace dymsum::planar
