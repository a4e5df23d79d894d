// Positions of the plane with doubles near them, and squares of their distances from segments, as fractions of
// integers.
#pragma once

#include <memory>
#include <optional>

#include "dymsum/region.h"
#include "exact/big.h"
#include "exact/interval.h"

namespace dymsum::check {

using exact::BigInteger;
using exact::HomogeneousPoint;
using exact::Interval;

/// num / den, den > 0.
struct Fraction {
  BigInteger num = 0, den = 1;
  friend bool operator<(const Fraction& a, const Fraction& b) { return a.num * b.den < b.num * a.den; }
};

struct ExactPoint {
  explicit ExactPoint(HomogeneousPoint p);
  HomogeneousPoint exact;  ///< without common factor
  Interval x, y;           ///< of the nearest doubles
  Point near;              ///< these
};
using PointRef = std::shared_ptr<const ExactPoint>;

/// A closed segment; both ends equal: a point.
struct Segment {
  PointRef from, to;
};

/// a x + b y + c.
struct Line {
  BigInteger a, b, c;
  /// The sign is that of the side, the value a multiple that depends on the position.
  BigInteger at(const HomogeneousPoint& p) const { return a * p.x + b * p.y + c * p.w; }
};
/// The line through both, without common factor; its left is positive.
Line line_through(const HomogeneousPoint& a, const HomogeneousPoint& b);
/// The position on both. Requires that they are not parallel.
PointRef meeting_of(const Line& a, const Line& b);
/// p as seen from q, rounded.
Point seen_from(const HomogeneousPoint& q, const HomogeneousPoint& p);
/// The sign of (b - a) x (c - a).
int orientation(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c);
/// The sign of x(a) - x(b).
int compare_x(const ExactPoint& a, const ExactPoint& b);
bool same_position(const ExactPoint& a, const ExactPoint& b);

/// The square of the distance of p from the segment.
Fraction squared_distance(const ExactPoint& p, const Segment& s);
/// The nearest position of the segment.
HomogeneousPoint nearest_on(const ExactPoint& p, const Segment& s);
/// The same distance squared, between bounds.
Interval squared_distance_bounds(const ExactPoint& p, const Segment& s);
/// The distance in doubles, whatever its error.
double rough_distance(Point p, const Segment& s);

}  // namespace dymsum::check
