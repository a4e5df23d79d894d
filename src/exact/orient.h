// Exact signs of 2x2 determinants and scalar products of plain doubles of any exponents: a floating-point filter with a
// proved error bound answers almost always; what it leaves open is computed in integers on the common grid of the
// arguments.
#pragma once

#include <cmath>

#include "dymsum/region.h"
#include "exact/rounding_bound.h"
#include "exact/rung.h"

namespace dymsum::exact {

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

}  // namespace dymsum::exact
