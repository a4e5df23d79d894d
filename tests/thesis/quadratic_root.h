// Roots of quadratic polynomials with integer coefficients: rotation events are such roots in t = tan(theta / 2). A
// polynomial
//   q(t) = c0 + c1 t + c2 t^2
// is also the form q(u, v) = c0 u^2 + c1 u v + c2 v^2 on the points (u : v) = (1 : t) of the projective line, a circle
// that closes at t = infinity, so half turns need no exception: q vanishes at infinity when c2 = 0, and has one sign at
// every point, infinity too. On this circle a form that changes sign does so at one point where it rises and at one
// where it falls, which names its roots whatever the degree of the polynomial.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "exact/big.h"
#include "exact/orient.h"

namespace dymsum::exact {

/// c0 + c1 t + c2 t^2.
class Quadratic {
 public:
  Quadratic() = default;
  Quadratic(Big c0, Big c1, Big c2);

  const Big& operator[](int k) const { return c_[k]; }
  /// The coefficients in doubles, times a common power of two that brings the largest into [1, 2); errors below 2^-51
  /// of each, plus 2^-1022.
  const std::array<double, 3>& approx() const { return approx_; }
  bool is_zero() const { return sign(c_[0]) == 0 && sign(c_[1]) == 0 && sign(c_[2]) == 0; }
  /// c1^2 - 4 c0 c2.
  Big discriminant() const;
  /// t^2 q(1 / t).
  Quadratic reversed() const { return {c_[2], c_[1], c_[0]}; }
  friend bool operator==(const Quadratic& a, const Quadratic& b) { return a.c_ == b.c_; }

 private:
  std::array<Big, 3> c_{};
  std::array<double, 3> approx_{};
};

/// How a form passes through zero at a root, as t grows.
enum class Slope : int {
  falling = -1,
  touching = 0,  ///< a double root
  rising = 1,
};

/// A real root, or infinity. A value: its polynomial may be any multiple; compare by compare().
class QuadraticRoot {
 public:
  /// The root of q with this slope; nothing where there is none, or where q vanishes identically.
  static std::optional<QuadraticRoot> of(const Quadratic& q, Slope slope);
  /// num / den; infinity for den = 0. Requires that not both are zero.
  static QuadraticRoot rational(const Big& num, const Big& den);

  const Quadratic& form() const { return q_; }
  Slope slope() const { return static_cast<Slope>(slope_); }
  bool is_infinite() const;
  /// A point (u : v), in doubles, u >= 0, the larger magnitude in [1, 2]: each component errs by less than 2^-49 of
  /// itself, plus 2^-1000.
  const std::array<double, 2>& approx() const { return approx_; }
  /// 1 / t.
  QuadraticRoot reciprocal() const;

 private:
  friend SignAnswer sign_answer_at(const QuadraticRoot& root, const Quadratic& p);
  QuadraticRoot(Quadratic q, int slope, Big discriminant);
  bool from_constant() const;
  int exact_sign(const Quadratic& p) const;

  Quadratic q_;
  int slope_ = 0;
  Big discriminant_;
  std::array<double, 2> approx_{};
};

/// The roots of q, the finite ones ascending, then infinity; none for q = 0 (every point is one). Double roots come
/// once.
std::vector<QuadraticRoot> roots_of(const Quadratic& q);

/// The sign of the form p at a root of another. Exact: with D the discriminant it is that of U + V sqrt(D), from the
/// signs of U, V and U^2 - V^2 D. Doubles decide first. For coefficients of q and p below 2^N, U^2 has less than 6 N +
/// 12 bits.
SignAnswer sign_answer_at(const QuadraticRoot& root, const Quadratic& p);
inline int sign_at(const QuadraticRoot& root, const Quadratic& p) { return sign_answer_at(root, p).sign; }
inline int sign_at(const QuadraticRoot& root, const Quadratic& p, RungCounts& counts) {
  return counts.add(sign_answer_at(root, p));
}

/// -1, 0, 1 for a < b, a = b, a > b, infinity being larger than all numbers.
SignAnswer compare_answer(const QuadraticRoot& a, const QuadraticRoot& b);
inline int compare(const QuadraticRoot& a, const QuadraticRoot& b) { return compare_answer(a, b).sign; }
inline int compare(const QuadraticRoot& a, const QuadraticRoot& b, RungCounts& counts) {
  return counts.add(compare_answer(a, b));
}

/// The same for the angles theta = 2 atan(t) in [0, 2 pi): first t >= 0, then infinity, then t < 0.
SignAnswer compare_turns_answer(const QuadraticRoot& a, const QuadraticRoot& b);
inline int compare_turns(const QuadraticRoot& a, const QuadraticRoot& b) { return compare_turns_answer(a, b).sign; }
inline int compare_turns(const QuadraticRoot& a, const QuadraticRoot& b, RungCounts& counts) {
  return counts.add(compare_turns_answer(a, b));
}

/// A multiple of a power of two strictly between two finite roots; its denominator is of the order of the inverse of
/// their distance. Requires a < b.
BigRational between(const QuadraticRoot& a, const QuadraticRoot& b);

}  // namespace dymsum::exact
