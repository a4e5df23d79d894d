// What the exact questions to a complex need.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

#include "exact/big.h"
#include "exact/interval.h"
#include "exact/root_expression.h"
#include "shape/complex/complex.h"
#include "shape/complex/walks.h"

namespace dymsum::shape {

// Positions along a site, as what they are: an end, the position of a disc that touches another site at its end, or the
// position of a disc that touches two other sites. Two marks with the same name are the same position.

/// A site, or a part of a vertex: directions are determined by the tangent of half their angle from an axis, 0 = +x, 1
/// = +y, 2 = -x, 3 = -y, whose opposite is not in the part.
struct Section {
  std::uint32_t site = 0;
  std::uint8_t axis = 0;
};

struct Mark {
  enum class Kind : std::uint8_t {
    minus_infinity,
    start,     ///< of the section
    tangent,   ///< the disc that touches the line of edge i at its start (root 0) or end (root 1)
    crossing,  ///< the disc that touches i < j; of two, root 0 is the first. j = kNoIndex: the disc is a half-plane
    toward,    ///< the smallest disc that touches i
    away,      ///< opposite to it; vertices only
    end,
    plus_infinity,
  };
  Kind kind = Kind::start;
  std::uint8_t root = 0;
  std::int8_t lead = 0;  ///< crossing: the signs of the quadratic's coefficients of x^2 and x
  std::int8_t slope = 0;
  std::uint32_t i = kNoIndex, j = kNoIndex;
  exact::Interval near = {};  ///< contains the parameter, unless it is infinite

  bool is_infinite() const { return kind == Kind::minus_infinity || kind == Kind::plus_infinity; }
  /// The same name.
  bool same(const Mark& o) const { return kind == o.kind && root == o.root && i == o.i && j == o.j; }
};

// Discs that touch a site, in numbers of any type T: exact::Interval, exact::FineInterval or exact::RootExpression.
//
// Along an edge a -> b with vector D, right normal N (of the same length) and L = D.D, a point p has the coordinates
// (X, Y) = (D.(p - a), N.(p - a)), that is, sqrt(L) times its true ones; the disc at parameter U in [0, L] has its
// centre at (U, R), R = sqrt(L) times its radius, and another site makes R a quadratic in U.
//
// At a vertex v the direction w = ((1 - x^2) A + 2 x A') / (1 + x^2) has the parameter x, with the section's axis A and
// A' to its left; another site makes (1 + x^2) / radius a quadratic in x.

/// Integers for T; intervals stand for themselves.
template <class T>
using Whole = std::conditional_t<std::is_same_v<T, exact::RootExpression>, exact::BigInteger, T>;

template <class N>
struct Vec {
  N x, y;
};
template <class N>
Vec<N> right_of(const Vec<N>& v) {
  return {v.y, N(-v.x)};
}
template <class N>
N dot(const Vec<N>& a, const Vec<N>& b) {
  return N(a.x * b.x + a.y * b.y);
}
template <class N>
Vec<N> turned_back(const Vec<N>& v, int quarters) {
  if (quarters == 0) return v;
  if (quarters == 1) return {v.y, N(-v.x)};
  if (quarters == 2) return {N(-v.x), N(-v.y)};
  return {N(-v.y), v.x};
}

/// a x^2 + b x + c.
template <class T>
struct Quadratic {
  T a, b, c;
};
template <class T>
Quadratic<T> operator-(const Quadratic<T>& f, const Quadratic<T>& g) {
  return {f.a - g.a, f.b - g.b, f.c - g.c};
}
template <class T>
T discriminant(const Quadratic<T>& f) {
  return f.b * f.b - T(4) * f.a * f.c;
}

/// What is known of the sign of a denominator's cancelling terms: not for exact numbers, which do not cancel.
inline bool provably_positive(const exact::Interval& v) { return v.low() > 0; }
inline bool provably_positive(const exact::FineInterval& v) { return sign_of(v) == 1; }
inline bool provably_positive(const exact::BigInteger& v) { return v.sign() > 0; }

template <class T>
class Formulas {
 public:
  using Z = Whole<T>;
  explicit Formulas(const Walks& walks) : walks_(walks) {}

  bool is_edge(std::uint32_t s) const { return walks_.is_edge(s); }

  Vec<Z> between(std::uint32_t from, std::uint32_t to) const {
    const BoundaryPoint &p = walks_.points[from], &q = walks_.points[to];
    if constexpr (std::is_same_v<T, exact::Interval>) {
      return {q.ix - p.ix, q.iy - p.iy};
    } else if constexpr (std::is_same_v<T, exact::FineInterval>) {
      return {difference(p.ix, q.ix), difference(p.iy, q.iy)};
    } else {
      return {Z(q.x - p.x), Z(q.y - p.y)};
    }
  }
  Vec<Z> vector(std::uint32_t s) const { return between(walks_.ends[s].a, walks_.ends[s].b); }

  // Along an edge.

  struct Frame {
    std::uint32_t a;
    Vec<Z> d, n;
    Z length2;
  };
  Frame frame(std::uint32_t s) const {
    const Vec<Z> d = vector(s);
    return {walks_.ends[s].a, d, right_of(d), Z(dot(d, d))};
  }
  Vec<Z> local(const Frame& f, std::uint32_t point) const { return in(f, between(f.a, point)); }
  static Vec<Z> in(const Frame& f, const Vec<Z>& v) { return {dot(f.d, v), dot(f.n, v)}; }

  /// 1 / (|E| - Ex) for the local vector E of an edge, times Ey: without cancellation.
  static T slant(const Vec<Z>& e, const T& length) {
    if (provably_positive(e.x) && !may_vanish(e.y)) return (length + T(e.x)) / T(e.y);
    return T(e.y) / (length - T(e.x));
  }
  static T length_of(const Vec<Z>& e) { return sqrt(T(Z(dot(e, e)))); }

  /// R as a function of U.
  Quadratic<T> radius_along(const Frame& f, std::uint32_t j) const {
    const Vec<Z> p = local(f, walks_.ends[j].a);
    if (!walks_.is_edge(j)) {
      const T y2 = T(Z(p.y + p.y));
      return {T(1) / y2, T(Z(-(p.x + p.x))) / y2, T(Z(p.x * p.x + p.y * p.y)) / y2};
    }
    const Vec<Z> e = in(f, vector(j));
    const T length = length_of(e), k = slant(e, length);
    // -(Ey (U - Px) + Ex Py) / (|E| - Ex); Ex / (|E| - Ex) = (k^2 - 1) / 2
    const T x = (k * k - T(1)) / T(2);
    return {T(0), -k, k * T(p.x) - x * T(p.y)};
  }
  /// U of the disc that touches the line of edge j at one of its ends.
  T tangent_along(const Frame& f, std::uint32_t j, int end) const {
    const Vec<Z> q = local(f, end == 0 ? walks_.ends[j].a : walks_.ends[j].b), e = in(f, vector(j));
    return T(q.x) - T(q.y) * slant(e, length_of(e));
  }

  // About a vertex.

  Vec<Z> turned(const Section& s, const Vec<Z>& v) const { return turned_back(v, s.axis); }

  /// The parameter of the direction of v, |v| = length.
  static T half_angle(const Vec<T>& v, const T& length, bool behind) {
    return behind ? (length - v.x) / v.y : v.y / (length + v.x);
  }
  static T half_angle(const Vec<Z>& v, const T& length) {
    return half_angle(Vec<T>{T(v.x), T(v.y)}, length, provably_positive(Z(-v.x)) && !may_vanish(v.y));
  }
  /// (1 + x^2) / radius as a function of x.
  Quadratic<T> curvature_about(const Section& s, std::uint32_t j) const {
    const std::uint32_t v = walks_.ends[s.site].a;
    const Vec<Z> d = turned(s, between(v, walks_.ends[j].a));
    if (!walks_.is_edge(j)) {
      const T q = T(Z(dot(d, d))), x = T(Z(d.x + d.x)) / q;
      return {-x, T(Z(d.y * Z(4))) / q, x};
    }
    const Vec<Z> e = turned(s, vector(j)), m = right_of(e);
    const T h = T(Z(-dot(m, d))), length = sqrt(T(Z(dot(e, e))));
    return {(length + T(m.x)) / h, T(Z(m.y * Z(-2))) / h, (length - T(m.x)) / h};
  }
  T tangent_about(const Section& s, std::uint32_t j, int end) const {
    const SiteEnds& ends = walks_.ends[j];
    const Vec<Z> q = turned(s, between(walks_.ends[s.site].a, end == 0 ? ends.a : ends.b));
    const Vec<Z> e = turned(s, vector(j));
    return half_angle(mirrored(q, right_of(e)), sqrt(T(Z(dot(e, e)))) * T(Z(dot(q, q))));
  }
  /// About a vertex: a vector in the direction of a mark, where that has one without roots.
  std::optional<Vec<Z>> direction(const Section& s, const Mark& m) const {
    const std::uint32_t v = walks_.ends[s.site].a;
    switch (m.kind) {
      case Mark::Kind::start:
      case Mark::Kind::end: {
        if (walks_.is_isolated(s.site)) return std::nullopt;
        const SiteEnds& ends = walks_.ends[s.site];
        return right_of(turned(s, vector(m.kind == Mark::Kind::start ? ends.prev : ends.next)));
      }
      case Mark::Kind::tangent: {
        const SiteEnds& ends = walks_.ends[m.i];
        return mirrored(turned(s, between(v, m.root == 0 ? ends.a : ends.b)), right_of(turned(s, vector(m.i))));
      }
      case Mark::Kind::toward:
      case Mark::Kind::away:
        return toward_vector(s, m.i, m.kind == Mark::Kind::away);
      default:
        return std::nullopt;
    }
  }
  /// q.q times the mirror image of m in the line perpendicular to q.
  static Vec<Z> mirrored(const Vec<Z>& q, const Vec<Z>& m) {
    const Z qq = dot(q, q), qm = Z(dot(q, m) * Z(2));
    return {Z(qq * m.x - qm * q.x), Z(qq * m.y - qm * q.y)};
  }

  // Both.

  Quadratic<T> function(const Section& s, std::uint32_t j) const {
    return walks_.is_edge(s.site) ? radius_along(frame(s.site), j) : curvature_about(s, j);
  }
  /// What site j makes of a disc less what site i makes of it; nothing instead of i where it is kNoIndex.
  Quadratic<T> difference(const Section& s, std::uint32_t i, std::uint32_t j) const {
    const Quadratic<T> f = function(s, j);
    return i == kNoIndex ? f : f - function(s, i);
  }

  T value(const Section& s, const Mark& m) const {
    const bool edge = walks_.is_edge(s.site);
    switch (m.kind) {
      case Mark::Kind::start:
        return edge ? T(0) : section_end(s, 0);
      case Mark::Kind::end:
        return edge ? T(frame(s.site).length2) : section_end(s, 1);
      case Mark::Kind::tangent:
        return edge ? tangent_along(frame(s.site), m.i, m.root) : tangent_about(s, m.i, m.root);
      case Mark::Kind::crossing:
        return root(m.j == kNoIndex ? function(s, m.i) : difference(s, m.i, m.j), m);
      case Mark::Kind::toward:
      case Mark::Kind::away:
        return toward(s, m.i, m.kind == Mark::Kind::away);
      default:
        throw std::logic_error("an infinite mark has no value");
    }
  }

 private:
  static exact::FineInterval difference(const exact::Interval& a, const exact::Interval& b) {
    if (a.is_point() && b.is_point()) return exact::FineInterval::difference(a.low(), b.low());
    return exact::FineInterval(b) - exact::FineInterval(a);
  }

  static bool may_vanish(const exact::Interval& v) { return v.contains_zero(); }
  static bool may_vanish(const exact::FineInterval& v) { return v.contains_zero(); }
  static bool may_vanish(const exact::BigInteger& v) { return v.is_zero(); }

  T section_end(const Section& s, int end) const {
    const SiteEnds& ends = walks_.ends[s.site];
    if (walks_.is_isolated(s.site)) return end == 0 ? T(-1) : T(1);
    const Vec<Z> d = turned(s, vector(end == 0 ? ends.prev : ends.next));
    return half_angle(right_of(d), sqrt(T(Z(dot(d, d)))));
  }

  T toward(const Section& s, std::uint32_t j, bool away) const {
    if (walks_.is_edge(s.site)) return T(local(frame(s.site), walks_.ends[j].a).x);
    const Vec<Z> d = toward_vector(s, j, away);
    return half_angle(d, sqrt(T(Z(dot(d, d)))));
  }
  Vec<Z> toward_vector(const Section& s, std::uint32_t j, bool away) const {
    const Vec<Z> d =
        turned(s, walks_.is_edge(j) ? right_of(vector(j)) : between(walks_.ends[s.site].a, walks_.ends[j].a));
    return walks_.is_edge(j) != away ? Vec<Z>{Z(-d.x), Z(-d.y)} : d;
  }

  /// Root 0 is the smaller one.
  static T root(const Quadratic<T>& f, const Mark& m) {
    if (m.lead == 0) return -f.c / f.b;
    const T d = sqrt(discriminant(f));
    // (-b + sigma d) / 2a with the sign that does not cancel, or the same as 2c / (-b - sigma d)
    const int sigma = (m.root == 0) == (m.lead > 0) ? -1 : 1;
    const bool adds = sigma * m.slope <= 0;
    if (adds) return (sigma > 0 ? d - f.b : -f.b - d) / (f.a * T(2));
    return f.c * T(2) / (sigma > 0 ? -f.b - d : d - f.b);
  }

  const Walks& walks_;
};

/// A disc that touches a site at a position, and another one.
struct DiscSource {
  enum class Kind : std::uint8_t {
    corner,  ///< the point `site` with radius 0
    neck,    ///< the smallest disc between section.site and `other`, both of them vertices
    disc,    ///< at `mark` of `section`
  };
  Kind kind = Kind::disc;
  Section section = {};
  Mark mark = {};
  std::uint32_t other = kNoIndex;  ///< a site
  std::uint32_t point = 0;         ///< corner: the boundary point
};

/// A complex in grid units if T is exact, in interval units if not; see Walks.
template <class T>
struct DiscOf {
  T x, y, radius;
};
template <class T>
DiscOf<T> disc_of(const Walks& walks, const DiscSource& source);
template <class T>
T radius_of(const Walks& walks, const DiscSource& source);

struct ExactComplex {
  Walks walks;
  std::vector<DiscSource> discs;                     ///< per node
  std::vector<exact::Interval> radii;                ///< per node, in interval units
  std::vector<std::vector<std::uint32_t>> contacts;  ///< per node: sites, clockwise
};

}  // namespace dymsum::shape
