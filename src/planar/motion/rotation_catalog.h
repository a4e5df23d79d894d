// The segments of the reduced convolution and the angles at which they exist: edges and convex vertices by direction.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <vector>

#include "exact/rounding_bound.h"
#include "planar/motion/turning_forms.h"

namespace dymsum::planar {

inline constexpr double kTurn = 2 * std::numbers::pi;
/// Angles that are nearer than this to where a segment begins or ends are not decided by doubles. In units u of
/// roundoff, half a unit in the last place being 4 u below 8 radians, 8 u below 16 and 16 u below 32:
//   edge      u of the vector's components, 4 each of the arc tangent, of 2 pi and of the sum: 13.
//   turn      two edges, the difference, 2 pi and the sum: 26 + 12 = 38.
//   relative  angle of an edge less that of another one and theta, which errs by 12 (kAngleDouble): two differences of
//             less than 16 and 32, up to four times 2 pi (16), the product (16), its difference, and perhaps 2 pi and
//             the sum: 26 + 12 + 8 + 16 + 16 + 16 + 4 + 8 = 106.
//   span      relative less turn, brought near 0 by 2 pi: 106 + 38 + 4 + 8 = 156.
//   with      the angle of a frame, from the midpoint of its window: 28 (kAngleDifference) and the difference.
inline constexpr double kAngleSlack = exact::rounding_bound(156 + 28 + 4, 8192);

/// The angle in [0, 2 pi).
inline double positive_angle(double a) {
  a = a - kTurn * static_cast<double>(static_cast<long long>(a / kTurn));
  return a < 0 ? a + kTurn : a;
}

class RotationCatalog {
 public:
  explicit RotationCatalog(const TurningForms& forms);

  enum class Existence : std::uint8_t { no, yes, unsure };
  /// Whether a segment exists at theta; `unsure` near the alignments at which it begins or ends.
  Existence exists(const WalkSegment& s, double theta) const;

  struct Edge {
    double angle = 0;
    std::uint32_t edge = 0;
  };
  /// A single point is a vertex with all directions, and has no edge.
  /// Calls f(side, vertex, edges, at, count) for every convex vertex: with the edges at positions at, at + 1, ... of
  /// the cyclic list it makes segments that exist somewhere in [low, high], and perhaps some that only nearly do.
  template <class F>
  void for_each_turn(double low, double high, F&& f) const {
    for (std::uint32_t side = 0; side < 2; ++side) {
      const std::uint32_t vertex_op = 1 - side;
      for (const Corner& corner : corners_[vertex_op]) {
        const std::vector<Edge>& edges = corner.of_hole ? outer_edges_[side] : edges_[side];
        if (edges.empty()) continue;
        // Directions of edges, less the rotation of the rotating operand, between those of the corner.
        const double from = positive_angle(corner.in + (side == 0 ? low : -high) - kAngleSlack),
                     length = corner.turn + (high - low) + 2 * kAngleSlack;
        const std::size_t first = (corner.of_hole ? outer_start_ : start_)[side].at_or_after(edges, from);
        std::size_t at = first, count = 0;
        for (; count < edges.size(); ++count, at = at + 1 == edges.size() ? 0 : at + 1) {
          const double after = edges[at].angle - from;  // of two angles in [0, 2 pi)
          if ((after < 0 ? after + kTurn : after) > length) break;
        }
        f(side, corner.vertex, edges, first, count);
      }
    }
  }
  /// Calls f(WalkSegment) for every segment that exists somewhere in [low, high], and perhaps for some that only nearly
  /// do.
  template <class F>
  void for_each(double low, double high, F&& f) const {
    for_each_turn(low, high,
                  [&](std::uint32_t side, std::uint32_t vertex, const std::vector<Edge>& edges, std::size_t at,
                      std::size_t count) {
                    for (std::size_t k = 0; k < count; ++k, at = at + 1 == edges.size() ? 0 : at + 1)
                      f(WalkSegment{side, edges[at].edge, vertex});
                  });
  }
  /// The position of an edge in the list of for_each_turn for a vertex of the other operand.
  std::uint32_t position(std::uint32_t side, std::uint32_t edge, std::uint32_t vertex) const {
    return (of_hole_[1 - side][vertex] ? outer_rank_ : rank_)[side][edge];
  }
  std::uint32_t list_size(std::uint32_t side, std::uint32_t vertex) const {
    return static_cast<std::uint32_t>((of_hole_[1 - side][vertex] ? outer_edges_ : edges_)[side].size());
  }

  /// Open.
  struct Span {
    double from = 0, to = 0;
  };
  /// The interval of angles, relative to theta, at which a segment exists and that is nearest to 0. Requires may_exist.
  /// It is the only one that comes within a quarter turn of theta: intervals begin a whole turn apart, so that the
  /// midpoints of all others are at least half a turn away, and none is longer than half a turn, by which a convex
  /// vertex turns at most.
  Span span(const WalkSegment& s, double theta) const {
    const std::uint32_t op = 1 - s.side;
    if (forms_.is_point(op, s.vertex)) return {-2 * kTurn, 2 * kTurn};
    const double in = angle_[op][forms_.operand(op).prev[s.vertex]], turn = turn_[op][s.vertex];
    Span span;
    if (s.side == 0) {
      const double r = positive_angle(angle_[0][s.edge] - theta - in);
      span = {r - turn, r};
    } else {
      const double r = positive_angle(angle_[1][s.edge] + theta - in);
      span = {-r, turn - r};
    }
    const double midpoint = 0.5 * (span.from + span.to), by = midpoint > kTurn / 2    ? -kTurn
                                                              : midpoint < -kTurn / 2 ? kTurn
                                                                                      : 0;
    return {span.from + by, span.to + by};
  }

  /// The segment that ends at a pair at theta, and the one that starts there; kNoRank edges where there is none.
  /// `unsure` is set where doubles do not decide.
  struct Joint {
    bool has_in = false, has_out = false, unsure = false;
    WalkSegment in, out;
  };
  Joint joint(Pair v, double theta) const;
  bool convex(std::uint32_t op, std::uint32_t v) const { return forms_.operand(op).convex[v] != 0; }
  /// Whether hole edges and hole vertices keep edge and vertex apart at every angle.
  bool may_exist(const WalkSegment& s) const;
  double edge_angle(std::uint32_t op, std::uint32_t e) const { return angle_[op][e]; }

 private:
  struct Corner {
    double in = 0, turn = 0;
    std::uint32_t vertex = 0;
    bool of_hole = false;
  };
  /// The positions at which to begin in a sorted list: of as many equal intervals of a turn as there are edges, the
  /// first one that is not before it.
  struct Starts {
    std::vector<std::uint32_t> first;
    void index(const std::vector<Edge>& edges);
    /// The first edge whose angle is not less than one in [0, 2 pi), all round; requires edges.
    std::size_t at_or_after(const std::vector<Edge>& edges, double angle) const {
      std::size_t at = first[std::min(first.size() - 1, interval(angle))];
      while (at > 0 && edges[at - 1].angle >= angle) --at;
      while (at < edges.size() && edges[at].angle < angle) ++at;
      return at == edges.size() ? 0 : at;
    }
    std::size_t interval(double angle) const {
      return static_cast<std::size_t>(angle * (static_cast<double>(first.size()) / kTurn));
    }
  };

  const TurningForms& forms_;
  std::array<std::vector<Edge>, 2> edges_, outer_edges_;  // sorted
  std::array<Starts, 2> start_, outer_start_;             // of these
  std::array<std::vector<Corner>, 2> corners_;
  std::array<std::vector<double>, 2> angle_, turn_;  // of edges; of convex vertices
  std::array<std::vector<std::uint8_t>, 2> of_hole_;
  std::array<std::vector<std::uint32_t>, 2> rank_, outer_rank_;  // of edges in the lists; ~0: not in it
};

}  // namespace dymsum::planar
