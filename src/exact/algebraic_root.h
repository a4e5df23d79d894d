// Real roots of integer polynomials of degree at most 6, as exact values: rotation events of polygons are such roots in
// t = tan(theta / 2), mostly of degree 2 and 4. Doubles with proved bounds answer for generic polynomials; what they
// leave open is settled in integers of any size, and nothing is decided by a tolerance.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "exact/orient.h"
#include "exact/polynomial.h"
#include "exact/root_bracket.h"

namespace dymsum::exact {

/// A real root. A value, cheap to copy and never changed by a question, so threads may share it; its polynomial may be
/// any that has the root; compare by compare().
class AlgebraicRoot {
 public:
  /// x itself, a simple root of a linear polynomial. compare, sign_at and between thereby take rationals on any side.
  static AlgebraicRoot rational(const BigRational& x);
  static AlgebraicRoot of(double x) { return rational(exact_value(x)); }

  /// A polynomial of which this is a simple root: the one it was found for or, from the exact path, a square-free
  /// factor of that.
  const Polynomial& polynomial() const { return f_; }
  /// Its multiplicity as a root of the polynomial that it was found for.
  int multiplicity() const { return multiplicity_; }
  /// That polynomial changes sign here; false where it touches zero.
  bool changes_sign() const { return multiplicity_ % 2 != 0; }

  /// low() < root < high(), or all three are equal. Where the exact path answered they are at most some units in the
  /// last place apart, and equal for every root that is a double; where doubles did, as near as signs in doubles can
  /// decide. One of them is infinite past the double range.
  double low() const { return low_; }
  double high() const { return high_; }
  /// A finite double in [low(), high()].
  double approx() const;
  /// An interval of any precision, to be refined by the caller.
  RootBracket bracket() const;

 private:
  friend std::vector<AlgebraicRoot> roots_in(const Polynomial& p, double lo, double hi, RungCounts& counts);
  AlgebraicRoot(Polynomial f, double low, double high);
  AlgebraicRoot(const RootBracket& bracket, int multiplicity);

  Polynomial f_;
  double low_ = 0, high_ = 0;
  int multiplicity_ = 1;
  std::shared_ptr<const RootBracket> bracket_;  // null where (low, high) isolates the root from the others of f
};

/// All distinct real roots of p in (lo, hi], ascending, with their multiplicities; none for p = 0, of which every
/// number is a root, and none unless lo < hi. Throws std::domain_error unless lo and hi are finite.
/// One count per call. Doubles decide when all roots between the ends are simple and well apart, from each other and
/// from the ends, and |lo|, |hi| <= 2^64; by some dozens of evaluations per root. Ends that are roots are divided out
/// first. Else square-free factors, Sturm's chain of each, and of
/// the order of log2(1 / gap) exact signs, gap being the smallest distance of two roots.
std::vector<AlgebraicRoot> roots_in(const Polynomial& p, double lo, double hi, RungCounts& counts);
std::vector<AlgebraicRoot> roots_in(const Polynomial& p, double lo, double hi);

/// -1, 0, 1 for a < b, a = b, a > b. Doubles decide when the bounds are apart. Else a = b exactly when a common divisor
/// of both polynomials changes sign where the brackets overlap; distinct roots are refined until the brackets are
/// apart, which ends as their distance is positive: by Mahler's bound for the square-free part of the product of the
/// polynomials, of degree n <= 12 with coefficients of B bits, more than 2^-(n (B + log2 n) + 1).
SignAnswer compare_answer(const AlgebraicRoot& a, const AlgebraicRoot& b);
inline int compare(const AlgebraicRoot& a, const AlgebraicRoot& b) { return compare_answer(a, b).sign; }
inline int compare(const AlgebraicRoot& a, const AlgebraicRoot& b, RungCounts& counts) {
  return counts.add(compare_answer(a, b));
}
inline bool operator==(const AlgebraicRoot& a, const AlgebraicRoot& b) { return compare(a, b) == 0; }

/// The sign of a - x, x finite.
SignAnswer compare_answer(const AlgebraicRoot& a, double x);
SignAnswer compare_answer(const AlgebraicRoot& a, const BigRational& x);
inline int compare(const AlgebraicRoot& a, double x) { return compare_answer(a, x).sign; }
inline int compare(const AlgebraicRoot& a, const BigRational& x) { return compare_answer(a, x).sign; }

/// The sign of p at the root. Doubles on [low, high] decide first. Else it is 0 exactly when a common divisor of p and
/// the root's polynomial changes sign in its bracket; otherwise the bracket is refined until p has one sign on it.
SignAnswer sign_answer_at(const AlgebraicRoot& root, const Polynomial& p);
inline int sign_at(const AlgebraicRoot& root, const Polynomial& p) { return sign_answer_at(root, p).sign; }
inline int sign_at(const AlgebraicRoot& root, const Polynomial& p, RungCounts& counts) {
  return counts.add(sign_answer_at(root, p));
}

/// The n / 2^k strictly between a and b with the smallest k >= 0; of integers the one nearest to 0. It depends on the
/// two numbers only. Requires a < b; throws std::invalid_argument otherwise.
BigRational between(const AlgebraicRoot& a, const AlgebraicRoot& b);

/// The value of a rational root, nothing for irrational ones. Most polynomials without rational roots have none modulo
/// some small prime either. Else, c being the leading coefficient, c times a rational root is an integer, and a bracket
/// narrower than 1 / c leaves one candidate to evaluate.
std::optional<BigRational> rational_value(const AlgebraicRoot& root);

// Values of integer polynomials at one real root of another one, as a number for code that is written for Int and Big:
// sums and products are those of polynomials, signs are exact.

/// c0, c1, ...: an integer polynomial of any degree, without leading zeros.
using Terms = std::vector<BigInteger>;
Terms sum_of(const Terms& a, const Terms& b);
Terms difference_of(const Terms& a, const Terms& b);
Terms product_of(const Terms& a, const Terms& b);
/// a / b; a itself where b is no factor of it. Requires a primitive b (so that quotients have integer coefficients).
bool divide_exactly(Terms& a, const Terms& b);

/// A real root of a polynomial, with the sign and the value of others there. Brackets are refined as signs need it, so
/// no two threads may ask at once.
class RootPoint {
 public:
  explicit RootPoint(const AlgebraicRoot& root);
  /// -1, 0 or 1. Multiprecision intervals decide first; else 0 exactly when a common divisor has the root.
  int sign_of(const Terms& p) const;
  /// The value within 2^-52 of its size.
  double nearest(const Terms& p) const;
  /// p here, times 2^scale, and a bound of the value's error.
  struct Enclosure {
    BigInteger value, error;
    unsigned long scale = 0;
  };
  /// The value enclosed by a bracket at most 2^-bits wide.
  Enclosure enclose(const Terms& p, unsigned bits) const;

 private:
  AlgebraicRoot root_;
  mutable RootBracket bracket_;
};

/// The value of a polynomial at a root; where `at` is null a polynomial, which has no sign.
class RootValue {
 public:
  RootValue() = default;
  explicit RootValue(Terms terms, const RootPoint* at = nullptr) : terms_(std::move(terms)), at_(at) {}
  template <int B>
  RootValue(const Int<B>& v)  // NOLINT(google-explicit-constructor)
      : RootValue(to_big(v)) {}
  RootValue(const Big& v) {  // NOLINT(google-explicit-constructor)
    if (exact::sign(v) != 0) terms_ = {v.value()};
  }
  static RootValue from_int64(std::int64_t v) { return RootValue(Big::from_int64(v)); }

  const Terms& terms() const { return terms_; }
  const RootPoint* at() const { return at_; }

  friend RootValue operator+(const RootValue& a, const RootValue& b) {
    return RootValue(sum_of(a.terms_, b.terms_), a.at_ != nullptr ? a.at_ : b.at_);
  }
  friend RootValue operator-(const RootValue& a, const RootValue& b) {
    return RootValue(difference_of(a.terms_, b.terms_), a.at_ != nullptr ? a.at_ : b.at_);
  }
  friend RootValue operator*(const RootValue& a, const RootValue& b) {
    return RootValue(product_of(a.terms_, b.terms_), a.at_ != nullptr ? a.at_ : b.at_);
  }
  friend RootValue operator-(const RootValue& a) { return RootValue() - a; }
  friend bool operator==(const RootValue& a, const RootValue& b);

 private:
  Terms terms_;
  const RootPoint* at_ = nullptr;
};

/// Requires a root, but for constants.
int sign(const RootValue& v);
double to_double(const RootValue& v);
/// No value at a root is one: throws std::logic_error.
Big to_big(const RootValue& v);

}  // namespace dymsum::exact
