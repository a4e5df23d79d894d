// What the doubles of edge vectors and of sums of vertices lose: bounds of soups, arrangements and collisions, where
// both operands rest.
//
// In units u of roundoff, with L = |edge vector|_1 and S the span. A coordinate of a vertex carries 1 rounding, of a
// scaled or rotated operand 3: its own, the factor's and the product's.
//   point   3 S of the coordinates, and the sum.
//   side    d x (v - start): two points and their difference 9 S, the edge vector 3, product and difference 1 each:
//           14 L S. Where v is a position, its own error counts instead of one point's: 10 L S.
//   share   of a segment where another one crosses it, n / (n - m) for the sides n and m of its ends: what n and m err
//           by is weighted with 1 - t and t, so t errs by what one side does over |n - m|.
#pragma once

#include "exact/rounding_bound.h"

namespace dymsum::planar {

/// The error of x y' - y x' for vectors whose components carry one rounding each is this times |x y'| + |y x'|: two of
/// the factors, the product and the difference.
inline constexpr double kEdgeCross = exact::rounding_bound(4, 8);
/// The same for those of a scaled or rotated operand, which carry three each.
inline constexpr double kScaledEdgeCross = exact::rounding_bound(8, 16);
/// The error of the difference of two such components is this times the sum of both.
inline constexpr double kScaledEdgeGap = exact::rounding_bound(4, 8);

/// The error of each coordinate of the sum of two vertices is this times the span.
// No slack is needed. With a vertex x and its factor s in [1, 2), and their product rounded to p in [1, 2), the
// roundings of x, s, p and the sum err by u (x + s) + u^2 + 2 u, where x + s <= 1 + x s: no more than 4 u p, as p = 1
// only for x = s = 1, when the product is exact. In the binades above, each u of a rounding is 2 u of twice the number.
inline constexpr double kSumPoint = 4 * exact::kRoundoff;
/// The error of the side of a vertex or a position is this times L and the span.
inline constexpr double kSumSide = exact::rounding_bound(14, 16);
/// How far apart a box and a position, or two boxes at a position, have to be, times the span: coordinates, two
/// differences, and the margin taken off.
inline constexpr double kSumBox = exact::rounding_bound(3 + 1 + 3, 16);
/// The same for a vertex's height over a position: the sum of two vertices, and the difference.
inline constexpr double kSumHeight = exact::rounding_bound(4 + 1, 8);

/// Sides whose signs are known otherwise are taken for at least this fraction of a side error.
inline constexpr double kLeastSide = 0.5;
/// The error of a fraction of a crossing is this times side error / |d x e|. Sides err by 3/2 of one, as they are taken
/// for kLeastSide at least; n - m differs from d x e by 3 of them, and d x e by 1. |d x e| is more than 8 where the
/// fraction says anything, so n - m is at least half of it.
inline constexpr double kCrossingFractions = 8;
static_assert((1 + kLeastSide) / (1 - (2 * (1 + kLeastSide) + 1) / kCrossingFractions) <= kCrossingFractions);
/// The same of a vertex on a segment, times point error / max(|dx|, |dy|): two points, and what the vector errs by;
/// kept as a float.
inline constexpr double kTouchFractions = 4;
static_assert(3 <= kTouchFractions * (1 - exact::kFloatRoundoff));
/// The absolute error besides: the difference, the quotient and what is made of fractions up to 1 by three operations.
inline constexpr double kFractionRoundings = exact::rounding_bound(5, 8);
/// The error of the weight w of a mediant is this times what both denominators err by, as fractions of themselves: w
/// errs by at most w (1 - w) (r + s) / (1 - r - s) <= (r + s) / 2 where r + s <= 1/2, and by less than 1 anywhere.
inline constexpr double kMediantFractions = 2;
static_assert(kMediantFractions * 0.5 >= 1);

/// The error of start + t d beside those of the start and of t is these times |d| and the span: product and sum. What d
/// is rounded by is less than another error of a point, which is counted with the start.
inline constexpr double kStepLength = exact::rounding_bound(1, 4), kStepSum = exact::rounding_bound(1, 2);
/// The error of a position rounded from the exact one relative to a pair of vertices is this times the span: the
/// difference, two vertices of three roundings each and two sums.
inline constexpr double kRoundedPosition = exact::rounding_bound(9, 32);

/// Positions that are known worse than this, times the span, are rounded from the exact ones. Any value is right.
inline constexpr double kPoorPosition = 0x1p-38;

}  // namespace dymsum::planar
