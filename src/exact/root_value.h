// Values of integer polynomials at one real root of another one, as a number for code that is written for Int and Big:
// sums and products are those of polynomials, signs are exact.
#pragma once

#include <memory>
#include <vector>

#include "exact/algebraic_root.h"

namespace dymsum::exact {

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
