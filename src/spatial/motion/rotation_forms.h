// The signs that the facets of a convolution have among each other while one operand rotates, as functions of the
// angle: one formula each, for jets (what a window excludes) and for polynomials in t (what is exact).
#pragma once

#include <cmath>
#include <optional>

#include "base/doubles.h"
#include "dymsum/solid_rotation_events.h"
#include "exact/algebraic_root.h"
#include "exact/int.h"
#include "exact/interval.h"
#include "spatial/convex/exact_positions.h"
#include "spatial/convolution/sum_space.h"
#include "spatial/mesh/box_tree.h"
#include "spatial/motion/posed_pair.h"

namespace dymsum::spatial {

// Functions of the angle in a window, to first order, in doubles with a bound of everything left out: candidates are
// told from what never happens in the window by these.

/// A function of u that is within `rest` of value + slope u for every u in [-1, 1], that is every angle of a window.
struct Jet {
  double value = 0, slope = 0, rest = 0;

  double reach() const { return (std::abs(slope) + rest) * (1 + 0x1p-40); }
  double low() const { return value - reach(); }
  double high() const { return value + reach(); }
  /// Its sign throughout, or 0 where that is not proved.
  int sign() const { return value > reach() ? 1 : value < -reach() ? -1 : 0; }
};

// Every operation rounds value and slope by 2^-53 of the terms, twice at most, and products of tiny numbers by less
// than 2^-1000; the bounds themselves are rounded by less than what they are raised by.
inline Jet operator+(Jet a, Jet b) {
  const double value = a.value + b.value, slope = a.slope + b.slope;
  return {value, slope, (a.rest + b.rest) * (1 + 0x1p-50) + (std::abs(value) + std::abs(slope)) * 0x1p-52};
}
inline Jet operator-(Jet a) { return {-a.value, -a.slope, a.rest}; }
inline Jet operator-(Jet a, Jet b) { return a + -b; }
inline Jet operator*(Jet a, Jet b) {
  const double va = std::abs(a.value), vb = std::abs(b.value), sa = std::abs(a.slope), sb = std::abs(b.slope);
  const double rest = va * b.rest + vb * a.rest + a.rest * b.rest + sa * (sb + b.rest) + a.rest * sb;
  const double rounded = (va * vb + va * sb + vb * sa) * 0x1p-51 + 0x1p-1000;
  return {a.value * b.value, a.value * b.slope + b.value * a.slope, rest * (1 + 0x1p-48) + rounded};
}

/// The same with some thirty digits of the value, for windows as narrow as 1e-16: what nearly vanishes there is
/// determined by its value. Magnitudes are at most 2^100.
struct FineJet {
  base::DoublePair value;
  double slope = 0, rest = 0;

  static FineJet of(double v) { return {{v, 0}, 0, 0}; }
  /// b - a exactly.
  static FineJet difference(double a, double b) { return {base::exact_sum(b, -a), 0, 0}; }
  double size() const { return std::abs(value.high) * (1 + 0x1p-50); }  ///< at least |value|
  double reach() const { return (std::abs(slope) + rest) * (1 + 0x1p-40); }
  /// The sign, as that of a Jet.
  int sign() const {
    const double least = std::abs(value.high) * (1 - 0x1p-50);
    return !(least > reach()) ? 0 : value.high > 0 ? 1 : -1;
  }
};

// Values are rounded by less than kPairError of themselves, and by 2^-900 where error terms underflow; slopes as those
// of jets, with the value's second half left out.
inline FineJet operator+(const FineJet& a, const FineJet& b) {
  const base::DoublePair value = a.value + b.value;
  const double slope = a.slope + b.slope;
  return {
      value, slope,
      (a.rest + b.rest) * (1 + 0x1p-50) + std::abs(value.high) * (2 * base::kPairError) + std::abs(slope) * 0x1p-52};
}
inline FineJet operator-(const FineJet& a) { return {-a.value, -a.slope, a.rest}; }
inline FineJet operator-(const FineJet& a, const FineJet& b) { return a + -b; }
inline FineJet operator*(const FineJet& a, const FineJet& b) {
  const double va = a.size(), vb = b.size(), sa = std::abs(a.slope), sb = std::abs(b.slope);
  const double rest = va * b.rest + vb * a.rest + a.rest * b.rest + sa * (sb + b.rest) + a.rest * sb;
  const double rounded = va * vb * (2 * base::kPairError) + (va * sb + vb * sa) * 0x1p-51 + 0x1p-900;
  return {a.value * b.value, a.value.high * b.slope + b.value.high * a.slope, rest * (1 + 0x1p-48) + rounded};
}

// Exact turns about an axis of integers as (chart, t) on the circle, so that no angle is an exception.

/// theta = 2 atan(|axis| t) + pi chart.
struct ChartPosition {
  int chart = 0;
  exact::BigRational t;
};

/// What turns of one axis have in common. P's quaternion is (1, t axis) in chart 0, (-square t, axis) in chart 1.
class RotationCircle {
 public:
  /// Requires an axis that is not zero and has no common divisor.
  explicit RotationCircle(TurnAxis axis);

  const TurnAxis& axis() const { return axis_; }
  std::int64_t square() const { return square_; }  ///< |axis|^2
  double length() const { return length_; }
  /// The position of a rotation in the chart where |t| is at most about 1 / |axis|.
  ChartPosition position(const AxisTurn& turn) const;
  AxisTurn turn(const ChartPosition& position) const;
  ExactPose pose(const ChartPosition& position) const;
  /// The angle within 2^-48, in (-pi, 3 pi).
  double radians(int chart, double t) const;
  /// The parameter at which charts meet: t = reach of chart 0 is t = -other_reach of chart 1, and back.
  exact::BigRational reach(int chart) const;

  /// 1 + square t^2, primitive.
  const exact::Terms& divisor() const { return divisor_; }
  /// What polynomials of turned vectors are over: the divisor, times |axis|^2 in chart 1.
  const exact::Terms& weight(int chart) const { return weight_[chart]; }
  /// The vector turned, times the weight.
  exact::Vector3<exact::RootValue> turned(int chart, const exact::Vector3<exact::Big>& v,
                                          const exact::RootPoint* at) const;

 private:
  TurnAxis axis_;
  std::int64_t square_ = 1;
  double length_ = 1;
  exact::Terms divisor_;
  std::array<exact::Terms, 2> weight_;
};

/// The pair of operands, the circle and which of them turns; what both kinds of numbers are made of.
struct RotatingPair {
  SolidPair pair;
  RotationCircle circle;
  int turning = 0;                             ///< 0: P
  double unit = 1;                             ///< places times this are at most 1 in magnitude; a power of two
  std::array<std::vector<Vec3>, 2> positions;  ///< of vertices, exact doubles in units

  RotatingPair(const Mesh& p, const Mesh& q, const TurnAxis& axis, int turning);
  const SolidOperand& operand(int op) const { return op == 0 ? pair.p : pair.q; }
  const GridPositions& grid(int op) const { return op == 0 ? pair.p_positions : pair.q_positions; }
  exact::Vector3<exact::Big> direction(int op, std::uint32_t from, std::uint32_t to) const;
  bool along_axis(int op, std::uint32_t from, std::uint32_t to) const;
};

/// A vector as jets in a window about an angle.
class JetFrame {
 public:
  using Number = Jet;
  using Vector = exact::Vector3<Jet>;
  /// The angles within `half` of `midpoint`, which is within 2^-46 of what it stands for.
  JetFrame(const RotatingPair& pair, double midpoint, double half);
  Vector direction(int op, std::uint32_t from, std::uint32_t to) const {
    return placed(op, pair_.positions[op][to] - pair_.positions[op][from]);
  }
  Vector position(int op, std::uint32_t v) const { return placed(op, pair_.positions[op][v]); }
  /// A box in which a sum lies at all angles.
  Box box(SumPoint v) const;
  /// The normal of a triangle of an operand.
  Vector normal(int op, std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  /// The way a of P times the way b of Q.
  Vector across(std::uint32_t a0, std::uint32_t a1, std::uint32_t b0, std::uint32_t b1) const {
    return cross(direction(0, a0, a1), direction(1, b0, b1));
  }
  const Mat3& matrix() const { return matrix_; }
  static Jet one() { return {1, 0, 0}; }

 private:
  Vector placed(int op, Vec3 v, double error = 0) const;
  const RotatingPair& pair_;
  Mat3 matrix_, slope_;
  double half_;
};

/// The same of t in a window of a chart, in pairs of doubles or, where the window is that of a root, in intervals of
/// seventy digits: every vector times a positive factor, as of a PolynomialFrame. N is FineJet or WideInterval.
template <class N>
class PreciseFrame {
 public:
  using Number = N;
  using Vector = exact::Vector3<N>;
  /// All t from `low` to `high`, which are given.
  PreciseFrame(const RotatingPair& pair, int chart, const exact::BigRational& low, const exact::BigRational& high);
  Vector direction(int op, std::uint32_t from, std::uint32_t to) const {
    return placed(op, difference(pair_.positions[op][from], pair_.positions[op][to]), true);
  }
  Vector position(int op, std::uint32_t v) const { return placed(op, difference({}, pair_.positions[op][v]), true); }
  Vector normal(int op, std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  Vector across(std::uint32_t a0, std::uint32_t a1, std::uint32_t b0, std::uint32_t b1) const {
    return cross(placed(0, difference(pair_.positions[0][a0], pair_.positions[0][a1]), false),
                 placed(1, difference(pair_.positions[1][b0], pair_.positions[1][b1]), false));
  }
  static N one() { return N::of(1); }

 private:
  static Vector difference(Vec3 from, Vec3 to);
  Vector placed(int op, const Vector& v, bool weighted) const;
  const RotatingPair& pair_;
  int chart_;
  N t_, square_, weight_;
  Vector axis_;
};
using FineFrame = PreciseFrame<FineJet>;
using WideFrame = PreciseFrame<exact::WideInterval>;

/// The same as polynomials in t, each vector times a positive factor: one for all ways, any for normals. At a rational
/// t as their values there, which are integers.
class PolynomialFrame {
 public:
  using Number = exact::RootValue;
  using Vector = exact::Vector3<exact::RootValue>;
  PolynomialFrame(const RotatingPair& pair, int chart, const exact::RootPoint* at = nullptr)
      : pair_(pair), chart_(chart), at_(at) {}
  PolynomialFrame(const RotatingPair& pair, int chart, exact::BigRational t) : pair_(pair), chart_(chart), t_(t) {}
  Vector direction(int op, std::uint32_t from, std::uint32_t to) const {
    return placed(op, pair_.direction(op, from, to), true);
  }
  Vector position(int op, std::uint32_t v) const { return placed(op, pair_.grid(op).position<exact::Big>(v), true); }
  Vector normal(int op, std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  Vector across(std::uint32_t a0, std::uint32_t a1, std::uint32_t b0, std::uint32_t b1) const {
    return cross(placed(0, pair_.direction(0, a0, a1), false), placed(1, pair_.direction(1, b0, b1), false));
  }
  Vector placed(int op, const exact::Vector3<exact::Big>& v, bool weighted) const;
  /// The factor of all ways, and of vectors placed with it.
  Number weight() const { return value(pair_.circle.weight(chart_)); }
  static Number one() { return exact::RootValue::from_int64(1); }

 private:
  Number value(exact::Terms terms) const;
  const RotatingPair& pair_;
  int chart_;
  const exact::RootPoint* at_ = nullptr;
  std::optional<exact::BigRational> t_;
};

/// Degrees in t are those left when factors 1 + |axis|^2 t^2 are divided out: docs/design/turning-solids.md, "Degrees".
template <class Frame>
class RotationSigns {
 public:
  using Number = typename Frame::Number;
  using Vector = exact::Vector3<Number>;
  explicit RotationSigns(const Frame& frame) : f_(frame) {}

  Vector direction(DirectionSource w) const {
    return f_.direction(w.of == DirectionSource::Of::p ? 0 : 1, w.from, w.to);
  }
  Vector along(const SumEdge& e) const {
    return e.from.q == e.to.q ? f_.direction(0, e.from.p, e.to.p) : f_.direction(1, e.from.q, e.to.q);
  }
  Vector position(SumPoint v) const { return f_.position(0, v.p) + f_.position(1, v.q); }
  Vector between(SumPoint a, SumPoint b) const { return f_.direction(0, a.p, b.p) + f_.direction(1, a.q, b.q); }
  /// A plane's normal, times any positive number, and a sum in it.
  struct SidedPlane {
    Vector normal;
    SumPoint at;
  };
  SidedPlane plane(const PlaneSource& f) const { return {normal(f), f.at}; }
  Vector normal(const PlaneSource& f) const {
    const bool same = f.u.of == f.v.of;
    const int op = f.u.of == DirectionSource::Of::p ? 0 : 1;
    const Vector n = same ? f_.normal(op, f.u.from, f.u.to, f.v.to) : f_.across(f.u.from, f.u.to, f.v.from, f.v.to);
    return f.reversed ? Vector{-n.x, -n.y, -n.z} : n;
  }

  /// The form of a triangle's normal times a direction. Degree 2.
  Number slant(int op, const Triangle& t, DirectionSource d) const {
    return dot(f_.normal(op, t[0], t[1], t[2]), direction(d));
  }
  /// The form of the height of a sum over a plane. Degree 2.
  Number side(const SidedPlane& f, SumPoint v) const { return dot(f.normal, between(f.at, v)); }
  /// How two edges of sums pass: det(a, b, from a to b). Degree 2.
  Number twist(const SumEdge& a, const SumEdge& b) const {
    return dot(cross(along(a), along(b)), between(a.from, b.from));
  }
  Number rise(const SidedPlane& f, const SumEdge& e) const { return dot(f.normal, along(e)); }
  /// The order in which edge e meets f and g: g's parameter along e less f's, times both rises. Degree at most 4.
  Number order(const SumEdge& e, const SidedPlane& f, const SidedPlane& g) const {
    return side(f, e.from) * rise(g, e) - side(g, e.from) * rise(f, e);
  }
  /// det of three normals. Degree at most 4.
  Number spread(const SidedPlane& f, const SidedPlane& g, const SidedPlane& h) const {
    return dot(f.normal, cross(g.normal, h.normal));
  }
  /// The height of the common point of f, g and h over k, times spread(f, g, h). Degree at most 6.
  Number height(const SidedPlane& f, const SidedPlane& g, const SidedPlane& h, const SidedPlane& k) const {
    const Vector &a = f.normal, &b = g.normal, &c = h.normal, &d = k.normal;
    const Vector ca = cross(c, a), ab = cross(a, b);
    const Number db = dot(b, between(f.at, g.at)), dc = dot(c, between(f.at, h.at)), dd = dot(d, between(f.at, k.at));
    return db * dot(d, ca) + dc * dot(d, ab) - dd * dot(b, ca);
  }
  /// A point as `origin` and a vector x / w from there.
  struct Position {
    SumPoint origin;
    Vector x;
    Number w;
  };
  Position at(SumPoint v) const {
    const Vector zero = between(v, v);
    return {v, zero, Frame::one()};
  }
  /// The position of edge a where it passes edge b.
  Position at(const SumEdge& a, const SumEdge& b) const {
    const Vector d = along(a), e = along(b), n = cross(e, cross(d, e));
    return {a.from, scaled(dot(n, between(a.from, b.from)), d), dot(n, d)};
  }
  Position at(const SumEdge& e, const SidedPlane& f) const {
    const Vector& n = f.normal;
    const Vector d = along(e);
    return {e.from, scaled(dot(n, between(e.from, f.at)), d), dot(n, d)};
  }
  Position at(const SidedPlane& f, const SidedPlane& g, const SidedPlane& h) const {
    const Vector &a = f.normal, &b = g.normal, &c = h.normal;
    const Vector ca = cross(c, a);
    return {f.at, scaled(dot(b, between(f.at, g.at)), ca) + scaled(dot(c, between(f.at, h.at)), cross(a, b)),
            dot(b, ca)};
  }
  /// The direction into a facet across a facet edge, in a plane of this normal; facet edges are counter-clockwise.
  Vector inward(const Vector& n, const SumEdge& facet_edge) const { return cross(n, along(facet_edge)); }
  /// The side of a facet edge that begins at `from` on which a position lies: positive inside.
  Number inside(const Vector& inward, SumPoint from, const Position& at) const {
    return dot(inward, at.x) - at.w * dot(inward, between(at.origin, from));
  }
  /// How far beyond an end of edge e, from the other end, a position on its line lies.
  Number beyond(const SumEdge& e, SumPoint end, const Position& at) const {
    const Vector d = along(e);
    const Number ahead = dot(d, at.x) - at.w * dot(d, between(at.origin, end));
    return end == e.to ? ahead : -ahead;
  }

 private:
  static Vector scaled(const Number& s, const Vector& v) { return {s * v.x, s * v.y, s * v.z}; }
  const Frame& f_;
};

}  // namespace dymsum::spatial
