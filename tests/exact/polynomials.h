// Polynomials to test with: from small coefficients, from their roots, and at random.
#pragma once

#include <cstdint>
#include <vector>

#include "exact/gmp_bridge.h"
#include "exact/polynomial.h"

namespace dymsum::exact {

inline mpz_class to_mpz(const Big& v) { return mpz_class(v.value().str()); }
inline mpq_class to_mpq(const BigRational& v) { return mpq_class(v.str()); }
inline Big big(const mpz_class& v) { return Big(BigInteger(v.get_str())); }
inline Big big(std::int64_t v) { return Big::from_int64(v); }
inline BigRational fraction(std::int64_t num, std::int64_t den) { return ratio(big(num), big(den)); }

inline Polynomial poly(const std::vector<std::int64_t>& c) {
  std::vector<Big> terms;
  for (const std::int64_t v : c) terms.push_back(big(v));
  return Polynomial(terms);
}

inline Polynomial times(const Polynomial& a, const Polynomial& b) {
  std::vector<Big> c(a.is_zero() || b.is_zero() ? 0 : static_cast<std::size_t>(a.degree() + b.degree() + 1));
  for (int i = 0; i <= a.degree(); ++i)
    for (int k = 0; k <= b.degree(); ++k) {
      Big& term = c[static_cast<std::size_t>(i + k)];
      term = term + a[i] * b[k];
    }
  return Polynomial(c);
}

inline Polynomial linear(const BigRational& root) {
  return Polynomial({Big(BigInteger(-numerator(root))), Big(denominator(root))});
}

inline Polynomial random_polynomial(std::mt19937_64& random, int degree, int bits) {
  std::vector<Big> c;
  for (int k = 0; k <= degree; ++k) c.push_back(big(random_integer(random, bits)));
  return Polynomial(c);
}

/// Coefficients of about the same size, roots anywhere: what events in general position look like.
inline Polynomial generic_polynomial(std::mt19937_64& random, int degree, int bits) {
  std::vector<Big> c;
  const mpz_class top = mpz_class(1) << bits;
  for (int k = 0; k <= degree; ++k) {
    mpz_class v = 0;
    for (int have = 0; have < bits; have += 32) v = (v << 32) + static_cast<std::uint32_t>(random());
    c.push_back(big(mpz_class(v % top * (random() % 2 ? 1 : -1))));
  }
  return Polynomial(c);
}

}  // namespace dymsum::exact
