// Polynomials of degree at most 6 with integer coefficients, as rotation events have them in t = tan(theta / 2), and
// the divisions that determine which roots two of them share and how often one of them has each of its roots.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "exact/big.h"

namespace dymsum::exact {

/// c0 + c1 t + ... + cn t^n with cn != 0, or zero. An immutable value: copies share the coefficients, threads may too.
class Polynomial {
 public:
  static constexpr int kMaxDegree = 6;

  Polynomial();
  /// c0, c1, ...; leading zeros are dropped. Throws std::invalid_argument for a degree above kMaxDegree.
  explicit Polynomial(std::vector<Big> coefficients);

  bool is_zero() const { return data_->degree < 0; }
  /// -1 for zero.
  int degree() const { return data_->degree; }
  /// The coefficient of t^k, 0 above the degree. Requires 0 <= k <= kMaxDegree.
  const Big& operator[](int k) const { return data_->c[static_cast<std::size_t>(k)]; }
  /// The coefficients in doubles, times a common power of two that brings the largest into [1, 2]; each errs by at most
  /// 2^-51 of itself plus 2^-1022.
  const std::array<double, kMaxDegree + 1>& approx() const { return data_->approx; }

  Polynomial derivative() const;
  /// The exact sign at num / den. Requires den > 0.
  int sign_at(const Big& num, const Big& den) const;
  int sign_at(const BigRational& x) const;
  /// 2^(shift n) times the value at x / 2^shift, n the degree.
  BigInteger value_at_dyadic(const BigInteger& x, unsigned shift) const;

  /// The same coefficients; immediate for copies of one value.
  friend bool operator==(const Polynomial& a, const Polynomial& b) {
    return a.data_ == b.data_ || a.data_->c == b.data_->c;
  }

 private:
  struct Data {
    std::array<Big, kMaxDegree + 1> c;
    std::array<double, kMaxDegree + 1> approx{};
    int degree = -1;
  };
  std::shared_ptr<const Data> data_;
};

/// p divided by the positive greatest common divisor of its coefficients; zero for zero.
Polynomial primitive_part(const Polynomial& p);

/// A positive multiple of a, less a multiple of b, of a degree below b's; primitive. Requires b != 0.
Polynomial pseudo_remainder(const Polynomial& a, const Polynomial& b);

/// The greatest common divisor: primitive, its leading coefficient positive; zero when both are zero. By subresultants
/// (Knuth, TAOCP 2, 4.6.1, Algorithm C), which are determinants: for degrees n and coefficients of B bits they have at
/// most 2 n (B + log2 n) bits.
Polynomial gcd(const Polynomial& a, const Polynomial& b);

/// True only if a and b have no common factor of positive degree: they have none modulo the prime 2^61 - 1, which does
/// not divide a's leading coefficient, so that a common factor would keep its degree. False says nothing.
bool proved_coprime(const Polynomial& a, const Polynomial& b);

/// True only if f has no rational root: it has no root modulo some small prime that does not divide the leading
/// coefficient, to which a rational root would be carried. False says nothing; an irreducible f of degree n >= 2 has
/// none modulo at least one prime in n (Cameron and Cohen, 1992), of which a dozen are tried.
bool proved_without_rational_roots(const Polynomial& f);

/// f1, f2, ..., primitive, square-free and pairwise coprime, such that p is a constant times f1 f2^2 f3^3 ...: the
/// roots of fk are the roots of p of multiplicity k. None for constants. Yun's algorithm (SYMSAC 1976).
std::vector<Polynomial> square_free_factors(const Polynomial& p);

}  // namespace dymsum::exact
