// Roots of integer quadratics against 600-bit floating point, whose answers are proved for the coefficients that occur
// here.
#include "thesis/quadratic_root.h"

#include <gtest/gtest.h>

#include <cmath>

#include "exact/gmp_bridge.h"

namespace dymsum::exact {
namespace {

constexpr std::uint64_t kQuadraticSeed = 404;
constexpr int kBits = 600;

mpz_class mpz_of(const Big& v) { return mpz_class(v.value().str()); }
Big big(const mpz_class& v) { return Big(BigInteger(v.get_str())); }
Quadratic small(int c0, int c1, int c2) { return {Big::from_int64(c0), Big::from_int64(c1), Big::from_int64(c2)}; }

/// Values below 2^-kBits / 3 count as zero: for integers of a few bits no other number is as small.
int sign_of(const mpf_class& v, int zero_bits = kBits / 3) {
  mpf_class limit(1, kBits);
  mpf_div_2exp(limit.get_mpf_t(), limit.get_mpf_t(), static_cast<unsigned>(zero_bits));
  return abs(v) < limit ? 0 : sgn(v);
}

/// A root as a position on the line, by the schoolbook formula, and its polynomial.
struct QuadraticWitness {
  bool infinite = false;
  mpf_class t{0, kBits};
  QuadraticRoot root;
};

std::vector<QuadraticWitness> witnesses(const Quadratic& q) {
  std::vector<QuadraticWitness> all;
  const mpf_class c0(mpz_of(q[0]), kBits), c1(mpz_of(q[1]), kBits), c2(mpz_of(q[2]), kBits);
  for (const Slope slope : {Slope::falling, Slope::touching, Slope::rising}) {
    const auto root = QuadraticRoot::of(q, slope);
    const mpf_class d = c1 * c1 - 4 * c0 * c2;
    const bool expected = !q.is_zero() && (slope == Slope::touching ? sgn(d) == 0 : sgn(d) > 0);
    EXPECT_EQ(root.has_value(), expected);
    if (!root) continue;
    QuadraticWitness w{false, mpf_class(0, kBits), *root};
    const int s = static_cast<int>(slope);
    if (sgn(c2) != 0) {
      w.t = (-c1 + s * sqrt(d)) / (2 * c2);
    } else if (s != 0 && s == sgn(c1)) {
      w.t = -c0 / c1;
    } else {
      w.infinite = true;
    }
    EXPECT_EQ(root->is_infinite(), w.infinite);
    all.push_back(w);
  }
  return all;
}

int witness_sign(const QuadraticWitness& w, const Quadratic& p, int zero_bits = kBits / 3) {
  const mpf_class p0(mpz_of(p[0]), kBits), p1(mpz_of(p[1]), kBits), p2(mpz_of(p[2]), kBits);
  return w.infinite ? sgn(p2) : sign_of(p0 + w.t * (p1 + w.t * p2), zero_bits);
}
int witness_compare(const QuadraticWitness& a, const QuadraticWitness& b, int zero_bits = kBits / 3) {
  if (a.infinite || b.infinite) return int(a.infinite) - int(b.infinite);
  return sign_of(a.t - b.t, zero_bits);
}
int witness_turns(const QuadraticWitness& a, const QuadraticWitness& b) {
  const auto part = [](const QuadraticWitness& w) { return w.infinite ? 1 : sign_of(w.t) >= 0 ? 0 : 2; };
  return part(a) != part(b) ? (part(a) < part(b) ? -1 : 1) : witness_compare(a, b);
}

std::vector<Quadratic> all_small(int most) {
  std::vector<Quadratic> all;
  for (int a = -most; a <= most; ++a)
    for (int b = -most; b <= most; ++b)
      for (int c = -most; c <= most; ++c) all.push_back(small(a, b, c));
  return all;
}

TEST(QuadraticRoot, small_coefficients_exhaustively) {
  const std::vector<Quadratic> forms = all_small(3);
  std::vector<QuadraticWitness> roots;
  for (const Quadratic& q : forms)
    for (const QuadraticWitness& w : witnesses(q)) roots.push_back(w);
  ASSERT_GT(roots.size(), 300u);
  RungCounts signs, orders;
  std::size_t equal = 0, zero = 0;
  for (const QuadraticWitness& w : roots) {
    for (const Quadratic& p : forms) {
      const int s = sign_at(w.root, p, signs);
      ASSERT_EQ(s, witness_sign(w, p));
      zero += s == 0;
    }
    for (const QuadraticWitness& x : roots) {
      const int s = compare(w.root, x.root, orders);
      ASSERT_EQ(s, witness_compare(w, x));
      equal += s == 0;
      ASSERT_EQ(compare_turns(w.root, x.root), witness_turns(w, x));
    }
  }
  EXPECT_GT(signs.filtered(), 10 * signs.exact());
  EXPECT_GE(signs.exact(), zero);
  EXPECT_GT(zero, forms.size());
  EXPECT_GT(equal, 2 * roots.size()) << "multiples of one polynomial have equal roots";
}

TEST(QuadraticRoot, approximations_and_reciprocals) {
  std::mt19937_64 random = seeded(kQuadraticSeed);
  for (int i = 0; i < 2000; ++i) {
    const int bits = i % 3 == 0 ? 4 : i % 3 == 1 ? 60 : 200;
    const Quadratic q(big(random_integer(random, bits)), big(random_integer(random, bits)),
                      big(random_integer(random, bits)));
    for (const QuadraticWitness& w : witnesses(q)) {
      const auto [u, v] = w.root.approx();
      ASSERT_GE(u, 0);
      ASSERT_LE(std::max(u, std::abs(v)), 2);
      ASSERT_GE(std::max(u, std::abs(v)), 1);
      if (w.infinite) {
        ASSERT_EQ(u, 0);
      } else {
        ASSERT_LE(abs(mpf_class(v, kBits) - w.t * mpf_class(u, kBits)), mpf_class(0x1p-48, kBits) * abs(w.t) * u);
      }
      const QuadraticRoot r = w.root.reciprocal();
      for (const Quadratic& p : {q, small(1, 2, -3), small(-1, 0, 2)})
        ASSERT_EQ(sign_at(r, p), sign_at(w.root, p.reversed()));
    }
  }
}

TEST(QuadraticRoot, large_and_neighbouring_coefficients) {
  std::mt19937_64 random = seeded(kQuadraticSeed + 1);
  RungCounts counts;
  for (int i = 0; i < 1500; ++i) {
    const int bits = i % 2 ? 30 : 100;
    const mpz_class a = random_integer(random, bits), b = random_integer(random, bits),
                    c = random_integer(random, bits);
    // The same roots, and roots that differ in the last digits only.
    const mpz_class k = 1 + (random() % 1000);
    const auto near = [&](const mpz_class& v) { return mpz_class(v * k + (i % 3 == 0 ? 0 : int(random() % 3) - 1)); };
    const Quadratic q(big(a), big(b), big(c)), p(big(near(a)), big(near(b)), big(near(c)));
    for (const QuadraticWitness& w : witnesses(q)) {
      ASSERT_EQ(sign_at(w.root, p, counts), witness_sign(w, p, 300)) << i;
      ASSERT_EQ(sign_at(w.root, q, counts), 0) << i;
      for (const QuadraticWitness& x : witnesses(p))
        ASSERT_EQ(compare(w.root, x.root, counts), witness_compare(w, x, 300)) << i;
    }
  }
  EXPECT_GT(counts.filtered(), 100u);
  EXPECT_GT(counts.exact(), 1000u);
}

TEST(QuadraticRoot, double_roots_are_told_from_pairs) {
  // (k t - 1)^2, and the same less one: two roots 1/k -+ 1/k^2 that doubles cannot tell from one.
  for (const std::int64_t k : {3LL, 1000LL, 1LL << 30}) {
    const mpz_class square = mpz_class(std::to_string(k)) * mpz_class(std::to_string(k));
    const Quadratic twice(Big::from_int64(1), Big::from_int64(-2 * k), big(square));
    ASSERT_EQ(roots_of(twice).size(), 1u);
    EXPECT_EQ(roots_of(twice)[0].slope(), Slope::touching);
    EXPECT_EQ(compare(roots_of(twice)[0], QuadraticRoot::rational(Big::from_int64(1), Big::from_int64(k))), 0);
    const mpz_class scale = square * square;
    const Quadratic pair(big(scale - 1), big(scale * -2 * k), big(scale * square));
    const std::vector<QuadraticRoot> two = roots_of(pair);
    ASSERT_EQ(two.size(), 2u);
    EXPECT_EQ(compare(two[0], roots_of(twice)[0]), -1);
    EXPECT_EQ(compare(two[1], roots_of(twice)[0]), 1);
    EXPECT_EQ(sign_at(roots_of(twice)[0], pair), -1);
    EXPECT_EQ(sign_at(two[0], twice), 1);
  }
  EXPECT_TRUE(roots_of(small(1, 0, 1)).empty());
}

TEST(QuadraticRoot, lower_degrees_infinity_and_nothing) {
  EXPECT_TRUE(roots_of(Quadratic()).empty());
  EXPECT_TRUE(small(0, 0, 0).is_zero());
  const std::vector<QuadraticRoot> line = roots_of(small(-3, 2, 0));
  ASSERT_EQ(line.size(), 2u);
  EXPECT_EQ(compare(line[0], QuadraticRoot::rational(Big::from_int64(3), Big::from_int64(2))), 0);
  EXPECT_TRUE(line[1].is_infinite());
  const std::vector<QuadraticRoot> constant = roots_of(small(5, 0, 0));
  ASSERT_EQ(constant.size(), 1u);
  EXPECT_TRUE(constant[0].is_infinite());
  EXPECT_EQ(constant[0].slope(), Slope::touching);
  EXPECT_EQ(compare(constant[0], line[1]), 0);
  EXPECT_EQ(sign_at(line[1], small(0, 0, -7)), -1);
  EXPECT_EQ(compare(QuadraticRoot::rational(Big::from_int64(-1), Big()), line[1]), 0);
  EXPECT_THROW(QuadraticRoot::rational(Big(), Big()), std::invalid_argument);
}

TEST(QuadraticRoot, numbers_between) {
  std::mt19937_64 random = seeded(kQuadraticSeed + 2);
  std::size_t checked = 0, tight = 0;
  const auto check = [&](const QuadraticRoot& a, const QuadraticRoot& b) {
    if (a.is_infinite() || b.is_infinite() || compare(a, b) >= 0) return;
    const BigRational x = between(a, b);
    const QuadraticRoot r = QuadraticRoot::rational(Big(numerator(x)), Big(denominator(x)));
    ASSERT_EQ(compare(a, r), -1);
    ASSERT_EQ(compare(r, b), -1);
    ++checked;
    tight += msb(denominator(x)) > 60;
  };
  std::vector<QuadraticRoot> roots;
  for (int i = 0; i < 60; ++i)
    for (const QuadraticRoot& r : roots_of(Quadratic(big(random_integer(random, 40)), big(random_integer(random, 40)),
                                                     big(random_integer(random, 40)))))
      roots.push_back(r);
  for (const QuadraticRoot& a : roots)
    for (const QuadraticRoot& b : roots) check(a, b);
  for (int i = 0; i < 200; ++i) {
    const mpz_class c0 = -1 - abs(random_integer(random, 120)), c1 = random_integer(random, 120),
                    c2 = 1 + abs(random_integer(random, 120));
    const Quadratic q(big(c0), big(c1), big(c2)), p(big(c0 - 1), big(c1), big(c2));
    for (const QuadraticRoot& a : roots_of(q))
      for (const QuadraticRoot& b : roots_of(p)) {
        check(a, b);
        check(b, a);
      }
  }
  EXPECT_GT(checked, 1000u);
  EXPECT_GT(tight, 20u) << "roots that are equal as doubles";
}

}  // namespace
}  // namespace dymsum::exact
