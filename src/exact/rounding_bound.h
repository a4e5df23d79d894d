// How far doubles can be from what they stand for: the vocabulary of the bounds of double filters. A bound stands as a
// named constant next to the forms that it guards, with the count of roundings that its derivation finds; what it
// grants beyond that count is its slack, and the compiler refuses one that grants too little.
//
// The counts are in units u of roundoff, as fractions of the product of magnitudes that the bound is multiplied with.
// Two operations of one rounding each make (1 + d)(1 + e) <= 1 + gamma(2); the difference from 2 u is what gamma is
// for.
#pragma once

namespace dymsum::exact {

/// u: an operation on doubles errs by at most this fraction of its result. Products and quotients may underflow
/// besides, sums and differences never lose by it.
inline constexpr double kRoundoff = 0x1p-53;

/// A bound that is at least n u / (1 - n u): a product of n factors 1 + d or 1 / (1 + d), |d| <= u, differs from 1 by
/// no more (Higham, Accuracy and Stability of Numerical Algorithms, lemma 3.1). Requires 0 < n <= 2^20.
// With e = n u <= 2^-33: 4 e is a double and so is 1 + 4 e, as 4 u = 2^-51; the product loses u at most, and (1 + 4 e)
// (1 - u) >= 1 + 3 e - u - 4 e u >= 1 + e + 2 e^2 >= 1 / (1 - e).
constexpr double gamma(int n) {
  const double e = n * kRoundoff;
  return e * (1 + 4 * e);
}

/// The roundings of magnitudes and of the bound itself that every rounding_bound has room for.
inline constexpr int kOwnRoundings = 32;

/// `granted` u, for an error of which at most `counted` u have been counted, each a fraction of one magnitude: it
/// covers gamma(counted) of the magnitude even where that comes out too small by kOwnRoundings roundings of its own.
/// Does not compile where it does not. Powers of two are exact factors.
// throw: not a constant expression.
consteval double rounding_bound(int counted, int granted) {
  const double bound = granted * kRoundoff;
  if (counted < 1 || counted > (1 << 20) || !(bound * (1 - gamma(kOwnRoundings)) >= gamma(counted)))
    throw "the bound grants fewer roundings than were counted";
  return bound;
}
static_assert(rounding_bound(1, 2) == 0x1p-52 && rounding_bound(1 << 20, (1 << 20) + 1) > 0x1p-33);

/// Added to a bound of sums of products of plain doubles: far more than the 2^-1075 that each of them loses where it
/// underflows, and than what the bound's own products lose.
inline constexpr double kUnderflow = 0x1p-1000;
/// Added to a bound of single values: more than the 2^-1075 that each of up to 16 of them loses where it is rounded to
/// a subnormal.
inline constexpr double kSubnormal = 16 * 0x1p-1074;

/// Factors for expressions of terms of one sign with fewer than 2^12 roundings: the result is not below, not above the
/// exact value.
inline constexpr double kOutwards = 1 + 0x1p-40, kInwards = 1 - 0x1p-40;
static_assert(gamma(1 << 12) * (1 + gamma(1)) < kOutwards - 1 && gamma(1 << 12) * (1 + gamma(1)) < 1 - kInwards);

/// Roundoff of floats.
inline constexpr double kFloatRoundoff = 0x1p-24;
/// The factor for a bound that is kept as a float: converted and multiplied by this, it is not below the double.
/// Requires at least 2^-100.
inline constexpr float kFloatOutwards = 1 + 0x1p-20f;
static_assert((1 - kFloatRoundoff) * (1 - kFloatRoundoff) * kFloatOutwards > 1);

}  // namespace dymsum::exact
