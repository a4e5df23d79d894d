// Common divisors, multiplicities, and the proofs modulo primes against products whose factors are known; doubles
// against GMP's rationals.
#include "exact/polynomial.h"

#include <gtest/gtest.h>

#include <cmath>

#include "exact/polynomials.h"
#include "exact/root_bracket.h"

namespace dymsum::exact {
namespace {

constexpr std::uint64_t kPolynomialSeed = 707;

mpq_class value_of_polynomial(const Polynomial& p, const mpq_class& x) {
  mpq_class v = 0;
  for (int k = p.degree(); k >= 0; --k) v = v * x + mpq_class(to_mpz(p[k]));
  return v;
}

TEST(Polynomial, values_and_derivatives) {
  std::mt19937_64 random = seeded(kPolynomialSeed);
  for (int i = 0; i < 300; ++i) {
    const Polynomial p = random_polynomial(random, i % 7, 90);
    const std::int64_t num = static_cast<int>(random() % 2001) - 1000, den = 1 + static_cast<int>(random() % 50);
    ASSERT_EQ(p.sign_at(big(num), big(den)), sgn(value_of_polynomial(p, mpq_class(num, den))));
    const mpq_class scaled =
        value_of_polynomial(p, mpq_class(num, 32)) * (mpq_class(1) << (5 * std::max(0, p.degree())));
    ASSERT_EQ(mpq_class(p.value_at_dyadic(num, 5).str()), scaled);
  }
  EXPECT_EQ(poly({7, 1, 2, 3}).derivative(), poly({1, 4, 9}));
  EXPECT_EQ(poly({7}).derivative(), Polynomial());
  EXPECT_EQ(Polynomial().derivative(), Polynomial());
  EXPECT_EQ(primitive_part(poly({-6, 0, 9})), poly({-2, 0, 3}));
}

TEST(Polynomial, doubles_err_by_what_is_promised) {
  std::mt19937_64 random = seeded(kPolynomialSeed + 1);
  for (int i = 0; i < 2000; ++i) {
    const Polynomial p = random_polynomial(random, i % 7, 1 + i % 700);
    if (p.is_zero()) continue;
    double top = 0;
    int at = 0;
    for (int k = 0; k <= p.degree(); ++k) {
      const double a = p.approx()[static_cast<std::size_t>(k)];
      if (std::abs(a) > top) at = k, top = std::abs(a);
    }
    ASSERT_TRUE(top >= 1 && top <= 2);
    // the power of two by which the largest coefficient was scaled: one more where rounding reached the next power
    const mpz_class largest = abs(to_mpz(p[at]));
    mpz_class unit = mpz_class(1) << static_cast<unsigned>(mpz_sizeinbase(largest.get_mpz_t(), 2) - 1);
    if (4 * mpq_class(top) * unit < 3 * largest) unit *= 2;
    for (int k = 0; k <= p.degree(); ++k) {
      const mpq_class exact = mpq_class(to_mpz(p[k])) / unit;
      const mpq_class error = abs(mpq_class(p.approx()[static_cast<std::size_t>(k)]) - exact);
      ASSERT_LE(error, abs(exact) * mpq_class(0x1p-51) + mpq_class(0x1p-1022)) << i;
    }
  }
}

TEST(Polynomial, common_divisors_of_products) {
  std::mt19937_64 random = seeded(kPolynomialSeed + 2);
  std::size_t proved = 0;
  for (int i = 0; i < 400; ++i) {
    const int bits = 2 + i % 100, shared = i % 4;
    const Polynomial g = generic_polynomial(random, shared, bits), a = generic_polynomial(random, i % 3, bits),
                     b = generic_polynomial(random, (i + 1) % 4, bits);
    if (g.is_zero() || a.is_zero() || b.is_zero()) continue;
    const Polynomial ga = times(g, a), gb = times(g, b), d = gcd(ga, gb);
    ASSERT_EQ(gcd(gb, ga), d);
    ASSERT_EQ(d, primitive_part(d));
    ASSERT_GT(sign(d[d.degree()]), 0);
    for (const Polynomial& p : {ga, gb}) ASSERT_TRUE(pseudo_remainder(p, d).is_zero()) << i;
    ASSERT_TRUE(pseudo_remainder(d, g).is_zero()) << "every common divisor divides it";
    ASSERT_EQ(d.degree() - g.degree(), gcd(a, b).degree());
    ASSERT_TRUE(!proved_coprime(ga, gb) || d == poly({1}));
    proved += proved_coprime(ga, gb);
  }
  EXPECT_GT(proved, 50u);
  EXPECT_EQ(gcd(Polynomial(), Polynomial()), Polynomial());
  EXPECT_EQ(gcd(Polynomial(), poly({4, -6})), poly({-2, 3}));
  EXPECT_EQ(gcd(poly({8}), poly({12})), poly({1}));
  EXPECT_FALSE(proved_coprime(Polynomial(), poly({1})));
  // both leading coefficients vanish modulo the prime, or the remainders do
  const std::int64_t prime = (std::int64_t{1} << 61) - 1;
  EXPECT_FALSE(proved_coprime(poly({1, prime}), poly({2, prime})));
  EXPECT_FALSE(proved_coprime(poly({1, 1}), poly({1 + prime, 1})));
}

TEST(Polynomial, factors_by_multiplicity) {
  std::mt19937_64 random = seeded(kPolynomialSeed + 3);
  const Polynomial x = poly({-1, 3}), y = poly({-2, 0, 7}), z = poly({5, 1});
  // -6 x z^2 y^1, x^3 z^2, y^3, z^6
  auto f = square_free_factors(times(times(poly({-6}), times(x, y)), times(z, z)));
  ASSERT_EQ(f.size(), 2u);
  EXPECT_TRUE(f[0] == times(x, y) || f[0] == times(poly({-1}), times(x, y)));
  EXPECT_EQ(f[1], z);
  f = square_free_factors(times(times(x, times(x, x)), times(z, z)));
  ASSERT_EQ(f.size(), 3u);
  EXPECT_EQ(f[0].degree(), 0);
  EXPECT_EQ(f[1], z);
  EXPECT_EQ(f[2], x);
  f = square_free_factors(times(y, times(y, y)));
  ASSERT_EQ(f.size(), 3u);
  EXPECT_EQ(f[2], y);
  f = square_free_factors(times(times(z, times(z, z)), times(z, times(z, z))));
  ASSERT_EQ(f.size(), 6u);
  EXPECT_EQ(f[5], z);
  EXPECT_TRUE(square_free_factors(poly({3})).empty());
  EXPECT_TRUE(square_free_factors(Polynomial()).empty());
  for (int i = 0; i < 100; ++i) {
    const Polynomial p = generic_polynomial(random, 1 + i % 6, 40);
    f = square_free_factors(p);
    ASSERT_EQ(f.size(), 1u);
    ASSERT_EQ(f[0], primitive_part(p));
  }
}

TEST(Polynomial, signs_in_doubles_are_never_wrong) {
  std::mt19937_64 random = seeded(kPolynomialSeed + 4);
  std::size_t open = 0, decided = 0;
  for (int i = 0; i < 20000; ++i) {
    // Near the rational roots of a product, where values cancel.
    const std::int64_t num = static_cast<int>(random() % 4001) - 2000, den = 1 + static_cast<int>(random() % 2000);
    Polynomial p = random_polynomial(random, i % 4, 40);
    for (int k = 0; k <= i % 3; ++k) p = times(p, linear(fraction(num, den)));
    if (p.degree() < 1) continue;
    const double root = static_cast<double>(num) / static_cast<double>(den);
    const double offset = static_cast<double>(random() % 64) - 32;
    const double t = root * (1 + std::ldexp(offset, -20 - static_cast<int>(random() % 34)));
    const auto s = filtered_sign(p, t, t);
    (s ? decided : open) += 1;
    ASSERT_TRUE(!s || *s == sgn(value_of_polynomial(p, mpq_class(t)))) << i;
    const double low = std::min(t, root), high = std::max(t, root);
    const auto both = filtered_sign(p, low - 1e-3, high + 1e-3);
    ASSERT_FALSE(both) << "there is a root inside";
  }
  EXPECT_GT(open, 2000u);
  EXPECT_GT(decided, 2000u);
}

}  // namespace
}  // namespace dymsum::exact
