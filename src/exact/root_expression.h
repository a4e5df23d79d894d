// Exact real numbers made of integers and doubles by + - * / and square roots.
//
// A sign is asked of intervals of doubles first, which every number carries, then of intervals of 128, 256 and 512
// bits, then, as it may be zero, of the algebra of square roots of rationals where that is cheap (exact/root_field),
// then of intervals of growing precision again. These end at a bound below which no nonzero expression of this form
// lies:
//
// Theorem (after Burnikel, Fleischer, Mehlhorn, Schirra 2000 and, with quotients, Burnikel, Funke, Mehlhorn, Schirra,
// Schmitt 2001). Let E be an expression of integers with k distinct roots among its subexpressions, and
//   integer N:  u = max(|N|, 1), l = 1        A + B:  u = u_A l_B + l_A u_B, l = l_A l_B     (A - B the same)
//   A * B:      u = u_A u_B, l = l_A l_B      A / B:  u = u_A l_B, l = l_A u_B
//   sqrt A:     u = sqrt(u_A l_A), l = l_A, or u = u_A, l = sqrt(u_A l_A).
// Then E = 0 or |E| >= 1 / (u^(2^k - 1) l).
//
// Proof. By the rules E = U / L with U and L made of integers and k roots by + - * alone: sqrt(U_A / L_A) is
// +-sqrt(U_A L_A) / L_A or U_A / +-sqrt(U_A L_A), with one new root, of U_A L_A, either way. So U and L are algebraic
// integers in a tower of k quadratic extensions of the rationals, of degree d <= 2^k. Let s be one of its d embeddings
// into the complex numbers. It maps sums and products to such, integers to themselves and a root of X to a root of
// s(X), so that |s(U)| <= u and |s(L)| <= l by induction over the rules: sums and products at most add and multiply
// magnitudes, and |s(sqrt X)| = |s(X)|^(1/2). If U is not 0, the product of all s(U) is an integer and not 0, hence
// |U| >= 1 / u^(d - 1), with u >= 1 as the product is at most u^d; and |E| = |U| / |L| >= 1 / (u^(d - 1) l).
//
// The bound is the exact exponent of a computation: bits = (2^k - 1) log2 u + log2 l, all logarithms rounded up.
#pragma once

#include <concepts>
#include <memory>
#include <string>
#include <utility>

#include "exact/big.h"
#include "exact/interval.h"
#include "exact/orient.h"

namespace dymsum::exact {

struct RootNode;

/// An immutable value: copies share its parts, threads may too. Building one costs as much as one operation on the
/// integers in it, unless what is under a root or below a line may be zero: its sign is found first.
class RootExpression {
 public:
  RootExpression();  ///< 0
  /// Exactly v. Throws std::domain_error for NaN and infinities.
  explicit RootExpression(double v);
  template <std::integral Integer>
  explicit RootExpression(Integer v) : RootExpression(BigInteger(v)) {}
  explicit RootExpression(const BigInteger& v);
  explicit RootExpression(const Big& v) : RootExpression(v.value()) {}
  template <int B>
  explicit RootExpression(const Int<B>& v) : RootExpression(Big(v)) {}
  explicit RootExpression(const BigRational& v);

  friend RootExpression operator-(const RootExpression& a);
  friend RootExpression operator+(const RootExpression& a, const RootExpression& b);
  friend RootExpression operator-(const RootExpression& a, const RootExpression& b);
  friend RootExpression operator*(const RootExpression& a, const RootExpression& b);
  /// Throws std::domain_error where b is 0.
  friend RootExpression operator/(const RootExpression& a, const RootExpression& b);
  /// The root that is not negative. Throws std::domain_error where a is negative. Roots of squares of rationals are
  /// rational.
  friend RootExpression sqrt(const RootExpression& a);
  friend RootExpression square(const RootExpression& a) { return a * a; }
  friend RootExpression& operator+=(RootExpression& a, const RootExpression& b) { return a = a + b; }
  friend RootExpression& operator-=(RootExpression& a, const RootExpression& b) { return a = a - b; }
  friend RootExpression& operator*=(RootExpression& a, const RootExpression& b) { return a = a * b; }
  friend RootExpression& operator/=(RootExpression& a, const RootExpression& b) { return a = a / b; }

  /// It contains the number. Immediate.
  const Interval& interval() const;
  const RootNode& node() const { return *node_; }

 private:
  explicit RootExpression(std::shared_ptr<const RootNode> node) : node_(std::move(node)) {}
  std::shared_ptr<const RootNode> node_;
};

/// Exact. Nanoseconds where intervals decide; microseconds to a few hundred of them for zeros with up to six roots, two
/// of them nested. Where algebra gives up, a zero costs what the bound's bits do; throws std::length_error past 2^28.
SignAnswer sign_answer(const RootExpression& a);
inline int sign_of(const RootExpression& a) { return sign_answer(a).sign; }
inline int sign_of(const RootExpression& a, RungCounts& counts) { return counts.add(sign_answer(a)); }

/// -1, 0, 1 for a < b, a = b, a > b. Exact.
SignAnswer compare_answer(const RootExpression& a, const RootExpression& b);
inline int compare(const RootExpression& a, const RootExpression& b) { return compare_answer(a, b).sign; }
inline int compare(const RootExpression& a, const RootExpression& b, RungCounts& counts) {
  return counts.add(compare_answer(a, b));
}

/// The double nearest to a, ties to even; infinite past the range of doubles, +0 for what rounds to 0.
double nearest_double(const RootExpression& a);
/// Contains a; its ends are neighbours, two steps apart where a may be the double between them, equal only if they are
/// a. The whole line past the range of doubles.
Interval narrow_interval(const RootExpression& a);

/// The expression as a formula of integers, + - * / and sqrt(): "sqrt(2) + 3/4". As long as the expression without
/// sharing.
std::string to_text(const RootExpression& a);

}  // namespace dymsum::exact
