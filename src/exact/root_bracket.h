// Real roots between dyadic rationals of any precision, isolated and narrowed by exact signs.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "exact/polynomial.h"

namespace dymsum::exact {

// Simple real roots of polynomials in doubles with proved error bounds: answers for generic polynomials, never a wrong
// one.

/// low < x < high contains exactly one root of a polynomial, a simple one, and the polynomial is not zero at the ends.
struct DoubleBracket {
  double low = 0, high = 0;
};

/// The sign that p has at all points of [low, high], if there is one and doubles decide.
std::optional<int> filtered_sign(const Polynomial& p, double low, double high);

/// All roots of p in (lo, hi), ascending, when doubles prove that they are simple and that lo and hi are none; nothing
/// where they do not. The brackets are as narrow as signs in doubles can make them, some dozens of units in the last
/// place where roots are well apart. Requires lo < hi. Descartes' rule on halved intervals, then Newton's iteration.
std::optional<std::vector<DoubleBracket>> filtered_roots(const Polynomial& p, double lo, double hi);

/// numerator / 2^shift, not necessarily in lowest terms.
struct DyadicNumber {
  BigInteger numerator = 0;
  unsigned shift = 0;

  /// The number a finite double stands for.
  static DyadicNumber of(double v);
  BigRational value() const { return BigRational(numerator, BigInteger(1) << shift); }
};
int compare(const DyadicNumber& a, const DyadicNumber& b);
/// v in [first, second], equal when v is a double, else neighbouring doubles; the outer one infinite past their range.
std::pair<double, double> double_bounds(const BigRational& v);
/// The dyadic number strictly between that has the smallest denominator; of integers, the one nearest to 0. Requires
/// low < high.
DyadicNumber simplest_between(const DyadicNumber& low, const DyadicNumber& high);

/// One root x of a polynomial f. Either low < x < high, f has no other root there, x is a simple root, f(low) and
/// f(high) are not 0 and hence have opposite signs; or low = x = high.
class RootBracket {
 public:
  /// Requires low < high and the first case above.
  RootBracket(Polynomial f, const DyadicNumber& low, const DyadicNumber& high);
  /// Requires f(x) = 0.
  RootBracket(Polynomial f, const DyadicNumber& x);

  const Polynomial& polynomial() const { return f_; }
  bool is_point() const { return low_ == high_; }
  DyadicNumber low() const { return {low_, shift_}; }
  DyadicNumber high() const { return {high_, shift_}; }

  /// Narrows the bracket. Where f is nearly linear in it the bits gained double with each call, up to 512; a call that
  /// fails halves what the next one tries, and one that tries a single bit succeeds: ten calls at least halve it.
  /// Quadratic interval refinement (Abbott, 2006).
  void refine();
  /// Refines until high - low <= 2^-bits.
  void refine_to(long bits);
  /// Refines until (high - low) 2^53 < |x| or x is found to be 0; then x is low = high if it is a double.
  void refine_to_double();
  /// The sign of root - x; narrows the bracket to the side of x.
  int compare_to(const DyadicNumber& x);
  /// [low, high] in doubles, rounded outwards; equal only when the root is that double.
  std::pair<double, double> bounds() const;

 private:
  int sign(const BigInteger& numerator) const { return f_.value_at_dyadic(numerator, shift_).sign(); }
  void rescale(unsigned more);
  void reduce();
  void become_point(const BigInteger& numerator);
  bool narrow_towards(const BigInteger& left, const BigInteger& width);

  Polynomial f_;
  BigInteger low_, high_;
  unsigned shift_ = 0, gain_ = 1;
  int low_sign_ = 0;
};

/// The roots of f in (lo, hi], ascending, their brackets within [lo, hi]. Requires a square-free f of positive degree
/// and lo < hi. Sturm's theorem on halved intervals: it ends because distinct roots of f have a positive distance, by
/// Mahler more than 2^-(n (B + log2 n) + 1) for degree n and coefficients of B bits.
std::vector<RootBracket> isolated_roots(const Polynomial& f, double lo, double hi);

/// The sign of p at the root, which narrows the bracket. Requires that p is not 0 there.
int sign_of_nonzero(RootBracket& root, const Polynomial& p);

}  // namespace dymsum::exact
