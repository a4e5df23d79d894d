// What doubles lose where an operand turns: bounds for the forms of turning_forms.h and for frames of a RotatingSum.
//
// In units u of roundoff, with L = |edge|_1, W the extent of the operand that stands still, R the reach of the turning
// one and S = W + 2 R the span. Two coordinates of one vector are bounded together: |x| + |y| <= sqrt(2) |(x, y)|.
//   heading      cos and sin err by 16 at most (kHeading).
//   vertices     of the fixed operand 1 W; of the turning one 2 R for the lattice's coordinate, whose extent is 2 R,
//                and 1 R for the centre taken off: 3 R.
//   place        q + c p - s p': 1 W + sqrt(2) (16 + 3 + 1) R, and two sums of at most W + R: 3 W + 31 R <= 16 S.
//   direction    c e - s e': 16 + 1 of the edge vector + 1 of the product + 1 of the difference: 19 L a coordinate.
//   side         d x (v - start) from places: v - start errs by 2 * 16 + 1 = 33 S, times |d|_1 <= sqrt(2) L makes 47;
//                d makes 2 * 19 = 38, products and difference 3: 88 L S. The form's coefficients err by 6 W + 28 R or
//                12 W + 14 R, cos and sin make 32 W or 64 R, products and sums 6 W + 12 R: 54 L S.
//   cross        d x e of two turned edges: 2 * 19 sqrt(2) = 54 and 2 of the products and the difference: 56 L L'.
//   concurrency  Two products of a side and a cross. Coefficients of sides add up to 2 L S and err by 14, those of
//                crosses to sqrt(2) L' L'' and err by 8; 3 operations make a coefficient, and one adds both products:
//                2 (14 sqrt(2) + 2 * 8 + 3 * 3) + 6 <= 96. The coefficients add up to 6; cos 2 theta and sin 2 theta
//                err by 45, six operations by 6: 6 * 51 = 306. Together 402 L L' L'' S.
#pragma once

#include "exact/rounding_bound.h"

namespace dymsum::planar {

/// Of cos and sin of an angle of a few turns that is a sum of doubles, absolutely.
inline constexpr double kHeading = exact::rounding_bound(12, 16);
/// Of a place, each coordinate, times the span.
inline constexpr double kTurnedPlace = exact::rounding_bound(16, 32);
/// Of a turned edge vector, each coordinate, times L.
inline constexpr double kTurnedDirection = exact::rounding_bound(19, 128);
/// Of a side, from the form or from places, times L and the span.
inline constexpr double kTurnedSide = exact::rounding_bound(88, 128);
/// Of the cross product of two edge vectors, times their L.
inline constexpr double kTurnedCross = exact::rounding_bound(56, 128);
/// Of a form of three lines, times their L and the span.
inline constexpr double kConcurrency = exact::rounding_bound(402, 512);

/// Of the side of a segment's end, taken as the side of its start plus d x e: 88 + 56 |e|_1, an edge that turns has
/// |e|_1 <= sqrt(2) S, of others only 24 are counted and |e|_1 <= 2 S; and the sum.
inline constexpr double kTurnedEndSide = exact::rounding_bound(88 + 79 + 2, 256);

/// Of a crossing on a segment, in shares of it: times kTurnedEndSide L S / |d x e|. |d x e| is known to 56 of the 256
/// that it has to exceed (kCrossKnown), so shares of at most 1 err by (88 + 79) / (1 - 56 / 256) of those 256 units:
/// less than once. The rest is slack.
inline constexpr double kCrossingSlack = 4;
/// Besides, absolutely: the inverse and the product, of shares up to 1.
inline constexpr double kCrossingShare = exact::rounding_bound(2, 8);

/// Cross products up to this, times both L, are not divided by.
inline constexpr double kCrossKnown = exact::rounding_bound(56, 256);

/// Of a difference of coordinates of a place and vertices of either operand, times the span: a place inside a sub-edge
/// errs by two places, the vertex that turns by one, the differences by roundings.
inline constexpr double kOverlapPlace = exact::rounding_bound(2 * 32 + 32 + 4, 256);
/// Of a side of such a vertex, times L and the span: that, a direction (19) times two coordinates of at most 2 S,
/// products and difference of at most 2 L S.
inline constexpr double kOverlapSide = exact::rounding_bound(2 * 32 + 32 + 4 + 19 * 4 + 3 * 2, 512);

/// Turning a position back mixes the errors of both coordinates, by |cos| + |sin| <= sqrt(2).
inline constexpr double kMixed = 1.5;
/// Of the rest of turning a position back, times the span: cos and sin, sqrt(2) 16, and six operations; and of turning
/// the offsets, whose sums carry 2.
inline constexpr double kTurnedBack = exact::rounding_bound(23 + 9, 128),
                        kTurnedOffset = exact::rounding_bound(23 + 9, 64);

/// Of two doubles of angles and their difference.
inline constexpr double kAngleDifference = exact::rounding_bound(2 * 12 + 4, 512);

/// Of the double of an angle of at most a turn and a half, in radians: twice an arc tangent, half a turn, their sum.
/// Each is less than 8 and errs by 4 u or less besides the rounding of what it is made of.
inline constexpr double kAngleDouble = exact::rounding_bound(12, 32);

/// How far two pieces have to be apart in a window, times L, in shares of the span: computed in floats. In their units
/// of roundoff, with L' of the other edge at most 2 S:
///   offsets   converted, subtracted and added: 3 W + 4 R + S <= 5 S.
///   value     with d, which errs by L, products and difference: 5 + 1 + 2 + 1 = 9 L S.
///   k, dot    4 L L' <= 8 L S; times a share, which is rounded, 4 L S more; added to the value or slope 3 L S.
///   slope     the offset that turns, chosen by a product: 12 S; with d, products and sum 16 L S. Times the half of the
///             window, at most a radian.
///   turn      its own roundings: 10 L S.
/// Together 24 + 31 + 10 <= 65 L S; what the doubles themselves err by is nothing beside it.
/// An edge vector that is the difference of its ends errs by 8 S of a double's units, which may be all that there is of
/// a short one: this turns its line about its start, so that the line still passes what crosses the edge within 8 L,
/// and two ends beyond the bound on one side of it are not on two sides of the edge's.
inline constexpr double kApart = 128 * exact::kFloatRoundoff;
/// What places at the middle of a window err by at most, times the span, when swept: the place, and the radius of a
/// vertex (4 R) times the half.
inline constexpr double kSweptPlace = exact::rounding_bound(16 + 4, 128);
inline constexpr double kSweptRim = exact::rounding_bound(16 + 4, 32);

}  // namespace dymsum::planar
