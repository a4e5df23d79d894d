// What rotation does to the signs of the planar engine: every one is a trigonometric polynomial in theta, of degree 1
// for the side of a vertex sum and of degree 2 for three lines through one point. In doubles for filters, and as
// integer polynomials in t = tan(theta / 2). docs/design/cspace-obstacle.md, "Numbers".
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "exact/polynomial.h"
#include "planar/motion/operand_pair.h"
#include "planar/motion/turning_bounds.h"
#include "planar/operand/operand.h"

namespace dymsum::planar {

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
  /// Whether it is certainly not zero within `half` of heading h, errors up to `error` included: by Taylor's formula.
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
  /// With the further source vertices of the base, as many of either operand, behind the walk vertices.
  TurningForms(const OperandPair& base, std::uint32_t further);

  const Operand& operand(std::uint32_t op) const { return *operands_[op]; }
  /// Of a single point, which is a vertex without an edge.
  bool is_point(std::uint32_t op, std::uint32_t v) const { return operands_[op]->next[v] == v; }
  std::uint32_t size(std::uint32_t op) const { return static_cast<std::uint32_t>(operands_[op]->size()); }
  const std::vector<Point>& points(std::uint32_t op) const { return points_[op]; }
  Point edge(std::uint32_t op, std::uint32_t e) const { return {operands_[op]->ex[e], operands_[op]->ey[e]}; }
  double reach() const { return reach_; }                      ///< of the turning operand about its centre
  double radius(std::uint32_t v) const { return radius_[v]; }  ///< of a vertex of it
  double span() const { return span_; }                        ///< of all coordinates of sums
  double width() const { return width_; }
  double height() const { return height_; }
  Point centre() const { return centre_; }  ///< of the turning operand, in the lattice's doubles
  struct Vec {
    exact::BigInteger x, y;
  };
  /// A vertex, in steps of the common grid.
  const Vec& grid_point(std::uint32_t op, std::uint32_t v) const { return exact_[op][v]; }

  Point place(Pair v, Heading h) const {
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
  /// A bound on the error of side() and of the same computed from places.
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
  /// Zero where walk edge e of the turning operand is parallel to walk edge f of the fixed one.
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

}  // namespace dymsum::planar
