// The signs of the convolution as polynomials of the scale s: linear, with integer coefficients.
// docs/design/scaling-sum.md, "Numbers".
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "planar/motion/operand_pair.h"
#include "planar/operand/lattice.h"

namespace dymsum::planar {

/// a + b s.
struct ExactForm {
  exact::BigInteger a = 0, b = 0;
  bool always_zero() const { return a == 0 && b == 0; }
  /// The one positive scale at which it vanishes, if it is not constant.
  std::optional<exact::BigRational> root() const {
    if (b == 0 || a.sign() * b.sign() >= 0) return std::nullopt;
    return exact::ratio(exact::Big(exact::BigInteger(-a)), exact::Big(b));
  }
  int sign_at(const exact::BigRational& s) const {
    return exact::BigInteger(a * denominator(s) + b * numerator(s)).sign();
  }
};

class ExactForms {
 public:
  explicit ExactForms(const OperandPair& base);

  /// d x (v - start) for the unscaled edge d of the segment.
  ExactForm side(const Segment& s, Pair v) const;
  /// d . (v - start): with the scale's square, as both d and v scale; the sign of d . (v - start) over the edge's own
  /// length.
  ExactForm along(const Segment& s, Pair v) const;
  /// Vanishes where the lines of three segments meet in a point. Requires: no two of them parallel.
  ExactForm concurrent(const Segment& a, const Segment& b, const Segment& c) const;
  /// A hash of the line of a segment as it moves with s, and of its direction: equal for segments whose lines coincide
  /// at every scale.
  std::uint64_t line_hash(const Segment& s) const;

 private:
  struct Vec {
    exact::BigInteger x, y;
  };
  Vec edge(const Edge& e) const;
  ExactForm cross(const Vec& d, Pair v) const;

  std::uint32_t scaled_;
  std::array<std::vector<Vec>, 2> at_;  ///< relative to the operands' offsets
};

// What doubles lose in a window of scales.
//
// In units u of roundoff, for c(tau) = f + tau m in the window's frame, with L = |edge vector|_1, F the extent of the
// operand that stands still, M that of the moving one and S = F + 2 tau1 M the span. Fractions of a segment are
// multiples of its unscaled edge vector; within a piece they are at most max(1, tau). Coordinates and components of
// edge vectors carry 3 each: their own, and of an operand that is stretched (OperandPair::stretched) the factor's and
// the product's.
//   point    f and m carry 3 each, tau 1, the product and the sum 1 each: 4 F + 6 tau M <= 4 S. A position on a segment
//            carries 5 more: the edge vector, the product with the fraction, and the sum.
//   side     d x (v - w): two points and their difference 9, the edge vector 3, the product and the last difference 1
//            each: 14 L S. With the shift of the frame, whose sum is one more of at most F + tau1 M, a point has one
//            more. Ends of cut pieces carry 6 more: the edge vector, the products with its length and with the
//            fraction, and the sum.
//   share    numerator / denominator: what a side and the denominator lose, and the quotient (see fraction_error()).

/// The error of a sum's coordinate, or of one of a position on a segment, is this times the span.
inline constexpr double kWindowPoint = exact::rounding_bound(4 + 5, 16);
/// The error of a side is this times L and the span: with the shift, and both positions at cuts.
inline constexpr int kSideRoundings = 14;
inline constexpr double kWindowSide = exact::rounding_bound(kSideRoundings + 2 * 1 + 2 * 6, 32);
/// The error of a side of an edge that is scaled where it stands is this times |e|_1 and the span: two products with a
/// rounded tau (5 each, of parts of the span), their sum, the difference, edge vector (3), product and difference.
inline constexpr double kSearchSide = exact::rounding_bound(12, 32);

/// The error of a fraction a + b tau where it is evaluated is this times max(1, tau): product, sum and tau; a and b
/// that cancel are covered by the error of the fraction, which counts roundings of their size.
inline constexpr double kFraction = exact::rounding_bound(3, 16);
/// The same for two shares and their difference.
inline constexpr double kFractionGap = exact::rounding_bound(7, 32);
/// The error of a fraction by a scalar product of sums with an edge vector over its square is this times max(1, tau1):
/// 6 of the product, 8 of the square, the quotient and the evaluation. Besides, what the sums err by, times |d|_1 and
/// the span over the square: a side, and for a position farther on the same line a vector, its product and the sum.
inline constexpr int kProjectionRoundings = 6 + 8 + 1 + 3, kProjectedRoundings = kSideRoundings + 6;
inline constexpr double kProjection = exact::rounding_bound(kProjectionRoundings, 64),
                        kProjectedSums = exact::rounding_bound(kProjectedRoundings, 64);
/// The same for the difference of two.
inline constexpr double kProjectionGap = exact::rounding_bound(2 * kProjectionRoundings, 128),
                        kProjectedGap = exact::rounding_bound(2 * kProjectedRoundings, 128);

/// The error of -a / b, relatively: the quotient, and the sum that makes it an end of a range.
inline constexpr double kRoot = exact::rounding_bound(2, 16);
/// The error of tau is this times tau1: it is the double nearest to the scale.
inline constexpr double kTau = exact::rounding_bound(1, 8);

/// The error of a fraction of two crossing lines where it is evaluated is this times the sizes of what a and b make:
/// products, sums and tau.
inline constexpr double kFollowed = exact::rounding_bound(5, 8);
/// The errors of the weights of a mediant, relatively: a length alone; a cross product, over its own part of
/// cancellation, with the three factors that it is multiplied with; the sum and the quotient.
inline constexpr double kLengthWeight = exact::rounding_bound(3, 8), kCrossWeight = exact::rounding_bound(8 + 4, 32),
                        kMediant = exact::rounding_bound(3, 8);

/// The error of a position in input coordinates is this times the span: evaluation (3), the blow-up and the last sum;
/// times the offsets: the factor and its product, the scale, products and sums.
inline constexpr double kKeptPosition = exact::rounding_bound(6, 16), kKeptOffsets = exact::rounding_bound(7, 8);

/// Denominators d that are known to this fraction of themselves at most may be divided by.
inline constexpr double kKnownDenominator = 0.25;

/// The error of a fraction n / d: n errs by `numerator`, d by `relative` of itself, fractions that matter are at most
/// half of `reach`. A fraction t errs by (numerator / |d| + |t| relative) / (1 - relative) and three roundings; outside
/// of `reach` a wrong fraction cannot become a right one. Requires relative < kKnownDenominator.
inline double fraction_error(double numerator, double d, double relative, double reach) {
  constexpr double kDivided = 2, kRounded = exact::rounding_bound(3, 32);
  static_assert(kDivided >= 1 / (1 - kKnownDenominator));
  // Lists rely on more than twice what is counted (PieceLists::look_at_neighbours).
  static_assert(kDivided * kWindowSide > 2 / (1 - kKnownDenominator) * exact::rounding_bound(kSideRoundings, 16));
  return kDivided * (numerator / d + reach * relative) + kRounded * reach;
}

/// How far from the root of a + b tau its sign may still be wrong, when a + b tau is known up to `error`.
inline double root_error(double root, double slope, double error, double tau1) {
  return error / std::abs(slope) * exact::kOutwards + kRoot * std::abs(root) + kTau * tau1;
}

}  // namespace dymsum::planar
