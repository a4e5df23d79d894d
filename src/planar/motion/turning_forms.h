// What rotation does to the signs of the planar engine: every one is a trigonometric polynomial in theta, of degree 1
// for the side of a vertex sum and of degree 2 for three lines through one point. In doubles for filters, and as
// integer polynomials in t = tan(theta / 2). docs/design/cspace-obstacle.md, "Numbers".
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "exact/polynomial.h"
#include "exact/rounding_bound.h"
#include "planar/motion/operand_pair.h"
#include "planar/operand/operand.h"

namespace dymsum::planar {

// What doubles lose where an operand rotates, in these forms and in frames of a RotatingSum.
//
// In units u of roundoff, with L = |edge|_1, W the extent of the operand that stands still, R the reach of the turning
// one and S = W + 2 R the span. Two coordinates of one vector are bounded together: |x| + |y| <= sqrt(2) |(x, y)|.
//   heading      cos and sin err by 16 at most (kHeading).
//   vertices     of the fixed operand 1 W; of the turning one 2 R for the lattice's coordinate, whose extent is 2 R,
//                and 1 R for the centre taken off: 3 R.
//   place        q + c p - s p': 1 W + sqrt(2) (16 + 3 + 1) R, and two sums of at most W + R: 3 W + 31 R <= 16 S.
//   direction    c e - s e': 16 + 1 of the edge vector + 1 of the product + 1 of the difference: 19 L a coordinate.
//   side         d x (v - start) from positions: v - start errs by 2 * 16 + 1 = 33 S, times |d|_1 <= sqrt(2) L makes
//   47;
//                d makes 2 * 19 = 38, products and difference 3: 88 L S. The form's coefficients err by 6 W + 28 R or
//                12 W + 14 R, cos and sin make 32 W or 64 R, products and sums 6 W + 12 R: 54 L S.
//   cross        d x e of two turned edges: 2 * 19 sqrt(2) = 54 and 2 of the products and the difference: 56 L L'.
//   concurrency  Two products of a side and a cross. Coefficients of sides add up to 2 L S and err by 14, those of
//                crosses to sqrt(2) L' L'' and err by 8; 3 operations make a coefficient, and one adds both products:
//                2 (14 sqrt(2) + 2 * 8 + 3 * 3) + 6 <= 96. The coefficients add up to 6; cos 2 theta and sin 2 theta
//                err by 45, six operations by 6: 6 * 51 = 306. Together 402 L L' L'' S.

/// The absolute error of cos and sin of an angle of a few turns that is a sum of doubles.
inline constexpr double kHeading = exact::rounding_bound(12, 16);
/// The error of each coordinate of a position is this times the span.
inline constexpr double kTurnedPosition = exact::rounding_bound(16, 32);
/// The error of each coordinate of a rotated edge vector is this times L.
inline constexpr double kTurnedDirection = exact::rounding_bound(19, 128);
/// The error of a side, from the form or from positions, is this times L and the span.
inline constexpr double kTurnedSide = exact::rounding_bound(88, 128);
/// The error of the cross product of two edge vectors is this times their L.
inline constexpr double kTurnedCross = exact::rounding_bound(56, 128);
/// The error of a form of three lines is this times their L and the span.
inline constexpr double kConcurrency = exact::rounding_bound(402, 512);

/// The error of the side of a segment's end, taken as the side of its start plus d x e: 88 + 56 |e|_1, an edge that
/// turns has |e|_1 <= sqrt(2) S, of others only 24 are counted and |e|_1 <= 2 S; and the sum.
inline constexpr double kTurnedEndSide = exact::rounding_bound(88 + 79 + 2, 256);

/// The error of a crossing on a segment, as a fraction of it, is this times kTurnedEndSide L S / |d x e|. |d x e| is
/// known to 56 of the 256 that it has to exceed (kCrossKnown), so fractions of at most 1 err by (88 + 79) / (1 - 56 /
/// 256) of those 256 units: less than once. The rest is slack.
inline constexpr double kCrossingSlack = 4;
/// The absolute error besides: the inverse and the product, of fractions up to 1.
inline constexpr double kCrossingFraction = exact::rounding_bound(2, 8);

/// Cross products up to this, times both L, are not divided by.
inline constexpr double kCrossKnown = exact::rounding_bound(56, 256);

/// The error of a difference of coordinates of a position and vertices of either operand is this times the span: a
/// position inside a sub-edge errs by two positions, the vertex that turns by one, the differences by roundings.
inline constexpr double kOverlapPosition = exact::rounding_bound(2 * 32 + 32 + 4, 256);
/// The error of a side of such a vertex is this times L and the span: that, a direction (19) times two coordinates of
/// at most 2 S, products and difference of at most 2 L S.
inline constexpr double kOverlapSide = exact::rounding_bound(2 * 32 + 32 + 4 + 19 * 4 + 3 * 2, 512);

/// Turning a position back mixes the errors of both coordinates, by |cos| + |sin| <= sqrt(2).
inline constexpr double kMixed = 1.5;
/// The error of what is left when a position is turned back is this times the span: cos and sin, sqrt(2) 16, and six
/// operations; and of turning the offsets, whose sums carry 2.
inline constexpr double kTurnedBack = exact::rounding_bound(23 + 9, 128),
                        kTurnedOffset = exact::rounding_bound(23 + 9, 64);

/// The error of two doubles of angles and their difference.
inline constexpr double kAngleDifference = exact::rounding_bound(2 * 12 + 4, 512);

/// The error of the double of an angle of at most a turn and a half, in radians: twice an arc tangent, half a turn,
/// their sum. Each is less than 8 and errs by 4 u or less besides the rounding of what it is made of.
inline constexpr double kAngleDouble = exact::rounding_bound(12, 32);

/// How far two pieces have to be apart in a window, times L, as fractions of the span: computed in floats. In their
/// units of roundoff, with L' of the other edge at most 2 S:
///   offsets   converted, subtracted and added: 3 W + 4 R + S <= 5 S.
///   value     with d, which errs by L, products and difference: 5 + 1 + 2 + 1 = 9 L S.
///   k, dot    4 L L' <= 8 L S; times a fraction, which is rounded, 4 L S more; added to the value or slope 3 L S.
///   slope     the offset that turns, chosen by a product: 12 S; with d, products and sum 16 L S. Times the half of the
///             window, at most a radian.
///   turn      its own roundings: 10 L S.
/// Together 24 + 31 + 10 <= 65 L S; what the doubles themselves err by is nothing beside it.
/// An edge vector that is the difference of its ends errs by 8 S of a double's units, which may be all that there is of
/// a short one: this turns its line about its start, so that the line still passes what crosses the edge within 8 L,
/// and two ends beyond the bound on one side of it are not on two sides of the edge's.
inline constexpr double kApart = 128 * exact::kFloatRoundoff;
/// What positions at the midpoint of a window err by at most, times the span, when swept: the position, and the radius
/// of a vertex (4 R) times the half.
inline constexpr double kSweptPosition = exact::rounding_bound(16 + 4, 128);
inline constexpr double kSweptRim = exact::rounding_bound(16 + 4, 32);

/// cos and sin of an angle.
struct Heading {
  double c = 1, s = 0;
  static Heading of(double theta) { return {std::cos(theta), std::sin(theta)}; }
};

/// a + b cos + g sin.
struct TrigForm {
  double a = 0, b = 0, g = 0;
  double at(Heading h) const { return a + b * h.c + g * h.s; }
  double slope(Heading h) const { return g * h.c - b * h.s; }
  double swing() const { return std::abs(b) + std::abs(g); }
  TrigForm operator-() const { return {-a, -b, -g}; }
  TrigForm operator-(const TrigForm& o) const { return {a - o.a, b - o.b, g - o.g}; }
  TrigForm times(double f) const { return {a * f, b * f, g * f}; }
  /// Whether it is provably not zero within `half` of heading h, errors up to `error` included: by Taylor's formula.
  bool far_from_zero(Heading h, double half, double error) const {
    return std::abs(at(h)) > std::abs(slope(h)) * half + 0.5 * swing() * half * half + error;
  }
};

/// The product or sum of products of two forms: a + b cos + g sin + b2 cos 2 theta + g2 sin 2 theta.
struct TrigForm2 {
  double a = 0, b = 0, g = 0, b2 = 0, g2 = 0;
  void add_product(const TrigForm& u, const TrigForm& v) {
    a += u.a * v.a + 0.5 * (u.b * v.b + u.g * v.g);
    b += u.a * v.b + u.b * v.a;
    g += u.a * v.g + u.g * v.a;
    b2 += 0.5 * (u.b * v.b - u.g * v.g);
    g2 += 0.5 * (u.b * v.g + u.g * v.b);
  }
  double at(Heading h) const { return a + b * h.c + g * h.s + b2 * (h.c * h.c - h.s * h.s) + 2 * g2 * h.c * h.s; }
  double slope(Heading h) const { return g * h.c - b * h.s + 2 * g2 * (h.c * h.c - h.s * h.s) - 4 * b2 * h.c * h.s; }
  /// A bound on the second derivative.
  double bend() const { return std::abs(b) + std::abs(g) + 4 * (std::abs(b2) + std::abs(g2)); }
  bool far_from_zero(Heading h, double half, double error) const {
    return std::abs(at(h)) > std::abs(slope(h)) * half + 0.5 * bend() * half * half + error;
  }
};

/// Operand 0 stands still, operand 1 turns about its centre in these doubles; a translation that depends on the angle
/// enters no sign. Segments and pairs are by walk edges and vertices: side 0 is an edge of the fixed operand + a vertex
/// of the turning one.
class TurningForms {
 public:
  explicit TurningForms(const OperandPair& base);
  /// The forms have the further source vertices of the base, as many of either operand, after the walk vertices.
  TurningForms(const OperandPair& base, std::uint32_t further);

  const Operand& operand(std::uint32_t op) const { return *operands_[op]; }
  /// Whether a vertex is a single point, without an edge.
  bool is_point(std::uint32_t op, std::uint32_t v) const { return operands_[op]->next[v] == v; }
  std::uint32_t size(std::uint32_t op) const { return static_cast<std::uint32_t>(operands_[op]->size()); }
  const std::vector<Point>& points(std::uint32_t op) const { return points_[op]; }
  Point edge(std::uint32_t op, std::uint32_t e) const { return {operands_[op]->ex[e], operands_[op]->ey[e]}; }
  double reach() const { return reach_; }                      ///< of the rotating operand about its centre
  double radius(std::uint32_t v) const { return radius_[v]; }  ///< of a vertex of it
  double span() const { return span_; }                        ///< of all coordinates of sums
  double width() const { return width_; }
  double height() const { return height_; }
  Point centre() const { return centre_; }  ///< of the rotating operand, in the lattice's doubles
  struct Vec {
    exact::BigInteger x, y;
  };
  /// A vertex, in steps of the common grid.
  const Vec& grid_point(std::uint32_t op, std::uint32_t v) const { return exact_[op][v]; }

  Point position(Pair v, Heading h) const {
    const Point &q = points_[0][v.p], &p = points_[1][v.q];
    return {q.x + h.c * p.x - h.s * p.y, q.y + h.s * p.x + h.c * p.y};
  }
  static Pair start(const WalkSegment& s) { return s.side == 0 ? Pair{s.edge, s.vertex} : Pair{s.vertex, s.edge}; }
  Pair end(const WalkSegment& s) const {
    const std::uint32_t to = operands_[s.side]->next[s.edge];
    return s.side == 0 ? Pair{to, s.vertex} : Pair{s.vertex, to};
  }
  Point direction(const WalkSegment& s, Heading h) const {
    const Point e = edge(s.side, s.edge);
    return s.side == 0 ? e : Point{h.c * e.x - h.s * e.y, h.s * e.x + h.c * e.y};
  }
  double length1(const WalkSegment& s) const {
    const Point e = edge(s.side, s.edge);
    return std::abs(e.x) + std::abs(e.y);
  }
  /// A bound on the error of side() and of the same computed from positions.
  double side_error(const WalkSegment& s) const { return kTurnedSide * length1(s) * span_; }

  /// d x (v - start), d . (v - start), d x d'.
  TrigForm side(const WalkSegment& s, Pair v) const;
  TrigForm cross(const WalkSegment& s, const WalkSegment& t) const;
  /// Parallel at every angle. Exact.
  bool parallel(const WalkSegment& s, const WalkSegment& t) const;
  TrigForm2 concurrency(const WalkSegment& a, const WalkSegment& b, const WalkSegment& c) const;
  double concurrency_error(const WalkSegment& a, const WalkSegment& b, const WalkSegment& c) const {
    return kConcurrency * length1(a) * length1(b) * length1(c) * span_;
  }

  exact::Polynomial exact_side(const WalkSegment& s, Pair v, int chart) const;
  exact::Polynomial exact_concurrency(const WalkSegment& a, const WalkSegment& b, const WalkSegment& c,
                                      int chart) const;
  /// d x d', and d . (v - u) for two pairs.
  exact::Polynomial exact_cross(const WalkSegment& s, const WalkSegment& t, int chart) const;
  exact::Polynomial exact_along(const WalkSegment& s, Pair u, Pair v, int chart) const;
  /// Zero where walk edge e of the rotating operand is parallel to walk edge f of the fixed one.
  exact::Polynomial exact_alignment(std::uint32_t e, std::uint32_t f, int chart) const;
  /// The chart in which they point in the same direction once.
  int alignment_chart(std::uint32_t e, std::uint32_t f) const;

 private:
  struct Form {
    exact::BigInteger a, b, g;
  };
  void add_point(std::uint32_t op, const PlacedPoints& from, std::size_t k);
  Vec vector(std::uint32_t op, std::uint32_t e) const;
  Form crossed(const Vec& d, std::uint32_t side, Pair u, Pair v) const;
  Form cross_form(const WalkSegment& s, const WalkSegment& t) const;

  const OperandPair& base_;
  std::array<const Operand*, 2> operands_;
  std::array<std::vector<Point>, 2> points_;
  std::array<std::vector<Vec>, 2> exact_;
  Point centre_;
  std::vector<double> radius_;
  double reach_ = 0, span_ = 0, width_ = 0, height_ = 0;
};

// The segments of the reduced convolution and the angles at which they exist: edges and convex vertices by direction.

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
