// Exact signs of points with doubles for coordinates, in the plane and in space, and the rungs by which signs are
// decided.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "dymsum/mesh.h"
#include "dymsum/region.h"
#include "exact/int.h"
#include "exact/rounding_bound.h"

namespace dymsum::exact {

// The ladder that the sign of an expression climbs until a rung determines it. Every room has some of these rungs, in
// this order and by these names; a rung that does not determine the sign says so, and never guesses.

enum class Rung : std::uint8_t {
  doubles,       ///< doubles with a proved bound of their error, or intervals of doubles
  double_pairs,  ///< the same with some thirty digits (FineInterval)
  integers,      ///< integers of a proved width, without allocation (Int)
  big,           ///< numbers of any size (Big), and algebraic numbers over them
};

struct SignAnswer {
  int sign = 0;  ///< -1, 0, 1
  Rung rung = Rung::doubles;
};

/// How many signs each rung has determined.
class RungCounts {
 public:
  RungCounts() = default;
  constexpr RungCounts(std::uint64_t doubles, std::uint64_t double_pairs, std::uint64_t integers, std::uint64_t big)
      : decided_{doubles, double_pairs, integers, big} {}

  void count(Rung rung) { ++decided_[static_cast<std::size_t>(rung)]; }
  int add(SignAnswer answer) {
    count(answer.rung);
    return answer.sign;
  }
  std::uint64_t at(Rung rung) const { return decided_[static_cast<std::size_t>(rung)]; }
  /// Determined by rungs that round.
  std::uint64_t filtered() const { return at(Rung::doubles) + at(Rung::double_pairs); }
  /// Determined by exact numbers.
  std::uint64_t exact() const { return at(Rung::integers) + at(Rung::big); }

  RungCounts& operator+=(const RungCounts& other) {
    for (std::size_t i = 0; i < decided_.size(); ++i) decided_[i] += other.decided_[i];
    return *this;
  }
  friend bool operator==(const RungCounts&, const RungCounts&) = default;

 private:
  std::array<std::uint64_t, 4> decided_{};
};

// Exact signs of 2x2 determinants and scalar products of plain doubles of any exponents: a floating-point filter with a
// proved error bound answers almost always; what it leaves open is computed in integers on the common grid of the
// arguments.

// The filter's bound, for s = u v +- w z with u, v, w, z differences of doubles, l = fl(fl(u) fl(v)),
// r = fl(fl(w) fl(z)) and e = 2^-53. Differences err relatively by at most e (they never underflow), so
// fl(u) fl(v) = u v (1 + d1)(1 + d2) and l = fl(u) fl(v) (1 + d3) + t, |d| <= e, |t| <= 2^-1075 (t is the underflow of
// the product). Hence
//   |u v| <= (|l| + |t|) / (1 - e)^3,   |l - u v| <= (3e + 3e^2 + e^3) |u v| + |t| <= (3e + 13e^2)|l| + 2|t|,
// the same for r, and the final operation adds e (|l| + |r|) at most when not underflowing (sums never underflow):
//   |fl(s) - s| <= (4e + 13e^2)(|l| + |r|) + 2^-1073.
// The test |fl(s)| > 5e fl(|l| + |r|) + 2^-1000, evaluated in doubles, is stricter: 5e (1 - e)^3 > 4e + 13e^2, and
// 2^-1000 also covers the underflow of the threshold itself. Overflow makes the threshold infinite or NaN and the test
// fail.
inline constexpr double kProvedSign = rounding_bound(4, 5);

/// The sign of l + r for products l and r of rounded differences where it is proved, else 0.
inline int proved_sign(double l, double r) {
  const double s = l + r, threshold = kProvedSign * (std::abs(l) + std::abs(r)) + kUnderflow;
  return (s > threshold) - (s < -threshold);
}

/// The sign of (b - a) x (d - c) where doubles determine it, else 0.
inline int proved_cross_sign(Point a, Point b, Point c, Point d) {
  return proved_sign((b.x - a.x) * (d.y - c.y), -((b.y - a.y) * (d.x - c.x)));
}

/// The sign of (b - a) x (d - c), exactly. Requires finite coordinates.
SignAnswer cross_answer(Point a, Point b, Point c, Point d);
/// The sign of (b - a) . (d - c), exactly. Requires finite coordinates.
SignAnswer dot_answer(Point a, Point b, Point c, Point d);

/// The sign of (b - a) x (d - c): > 0 when direction cd points to the left of direction ab.
inline int cross_sign(Point a, Point b, Point c, Point d) {
  const int proved = proved_cross_sign(a, b, c, d);
  return proved != 0 ? proved : cross_answer(a, b, c, d).sign;
}
inline int cross_sign(Point a, Point b, Point c, Point d, RungCounts& counts) {
  return counts.add(cross_answer(a, b, c, d));
}

/// The sign of (b - a) . (d - c).
inline int dot_sign(Point a, Point b, Point c, Point d) { return dot_answer(a, b, c, d).sign; }
inline int dot_sign(Point a, Point b, Point c, Point d, RungCounts& counts) {
  return counts.add(dot_answer(a, b, c, d));
}

/// The sign of (b - a) x (c - a): > 0 when a, b, c turn counter-clockwise, 0 when they are collinear.
inline int orient_sign(Point a, Point b, Point c) { return cross_sign(a, b, a, c); }
inline int orient_sign(Point a, Point b, Point c, RungCounts& counts) { return cross_sign(a, b, a, c, counts); }

// The exact sign of the 3x3 determinant that orients four points of space, for plain doubles of any exponents: a
// floating-point filter with a proved error bound answers almost always; what it leaves open is computed in integers on
// the common grid of the arguments.

/// det(u, v, w) of three vectors, generic in the number type. For Int<D> the result is Int<3D + 3>: products of two
/// 2D, their difference 2D + 1, times the third 3D + 1, the sum of three 3D + 3.
template <class Vector>
constexpr auto determinant(const Vector& u, const Vector& v, const Vector& w) {
  const auto x = u.y * v.z - u.z * v.y, y = u.z * v.x - u.x * v.z, z = u.x * v.y - u.y * v.x;
  return x * w.x + y * w.y + z * w.z;
}

/// The sign of det(b - a, c - a, d - a): > 0 when d lies on the side of the plane abc from which a, b, c run
/// counter-clockwise, 0 when the four points lie in one plane. Requires finite coordinates. Integers for differences of
/// at most 126 bits, big numbers beyond.
SignAnswer orient3_answer(const Point3& a, const Point3& b, const Point3& c, const Point3& d);

inline int orient3_sign(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  return orient3_answer(a, b, c, d).sign;
}
inline int orient3_sign(const Point3& a, const Point3& b, const Point3& c, const Point3& d, RungCounts& counts) {
  return counts.add(orient3_answer(a, b, c, d));
}

/// A coordinate axis, and the plane seen from its positive end.
enum class Axis { x, y, z };

/// The point without its coordinate on `axis`; counter-clockwise stays counter-clockwise seen from the axis' positive
/// end.
constexpr Point dropped(const Point3& p, Axis axis) {
  if (axis == Axis::x) return {p.y, p.z};
  if (axis == Axis::y) return {p.z, p.x};
  return {p.x, p.y};
}

/// The sign of the normal's component on `axis`: of (b - a) x (c - a).
inline int normal_sign(const Point3& a, const Point3& b, const Point3& c, Axis axis) {
  return orient_sign(dropped(a, axis), dropped(b, axis), dropped(c, axis));
}

/// a, b, c lie on one line; equal points do.
inline bool collinear(const Point3& a, const Point3& b, const Point3& c) {
  return normal_sign(a, b, c, Axis::z) == 0 && normal_sign(a, b, c, Axis::x) == 0 && normal_sign(a, b, c, Axis::y) == 0;
}

}  // namespace dymsum::exact
