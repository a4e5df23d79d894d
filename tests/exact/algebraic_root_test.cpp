// Real roots of integer polynomials against polynomials built from their roots and against Sturm's theorem in GMP's
// rationals.
#include "exact/algebraic_root.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "exact/polynomials.h"

namespace dymsum::exact {
namespace {

constexpr std::uint64_t kRootSeed = 606;

// The witness: Sturm's theorem over the rationals, which counts distinct roots in (a, b] also where some are multiple,
// unless a or b is a multiple one.
using Witness = std::vector<mpq_class>;

Witness witness(const Polynomial& p) {
  Witness w;
  for (int k = 0; k <= p.degree(); ++k) w.emplace_back(to_mpz(p[k]));
  return w;
}
mpq_class value(const Witness& w, const mpq_class& x) {
  mpq_class v = 0;
  for (std::size_t k = w.size(); k-- > 0;) v = v * x + w[k];
  return v;
}
Witness derivative(const Witness& w) {
  Witness d;
  for (std::size_t k = 1; k < w.size(); ++k) d.push_back(w[k] * static_cast<unsigned>(k));
  return d;
}
Witness remainder(Witness a, const Witness& b) {
  while (a.size() >= b.size()) {
    const mpq_class q = a.back() / b.back();
    for (std::size_t k = 0; k < b.size(); ++k) a[a.size() - b.size() + k] -= q * b[k];
    a.pop_back();
    while (!a.empty() && a.back() == 0) a.pop_back();
  }
  return a;
}
int variations(const std::vector<Witness>& chain, const mpq_class& x) {
  int count = 0, previous = 0;
  for (const Witness& w : chain) {
    const int s = sgn(value(w, x));
    count += s * previous < 0;
    if (s != 0) previous = s;
  }
  return count;
}
std::vector<Witness> sturm_chain(const Witness& w) {
  std::vector<Witness> chain{w, derivative(w)};
  while (chain.back().size() > 1) {
    Witness r = remainder(chain[chain.size() - 2], chain.back());
    if (r.empty()) break;
    for (mpq_class& c : r) c = -c;
    chain.push_back(r);
  }
  if (chain.back().empty()) chain.pop_back();
  return chain;
}
int count_roots(const Polynomial& p, double a, double b) {
  const auto chain = sturm_chain(witness(p));
  return variations(chain, mpq_class(a)) - variations(chain, mpq_class(b));
}

/// Brackets of any precision around the roots are what was claimed; the count is the witness's.
void check_roots(const Polynomial& p, double lo, double hi, const std::vector<AlgebraicRoot>& roots) {
  ASSERT_EQ(static_cast<int>(roots.size()), count_roots(p, lo, hi));
  const auto chain = sturm_chain(witness(p));
  for (const AlgebraicRoot& r : roots) {
    ASSERT_LE(r.low(), r.approx());
    ASSERT_LE(r.approx(), r.high());
    RootBracket b = r.bracket();
    b.refine_to(80);
    const mpq_class low = to_mpq(b.low().value()), high = to_mpq(b.high().value());
    ASSERT_LE(mpq_class(lo), high);
    ASSERT_LE(low, mpq_class(hi));
    if (b.is_point()) {
      ASSERT_EQ(sgn(value(witness(p), low)), 0);
      ASSERT_LT(mpq_class(lo), low);
    } else {
      ASSERT_EQ(variations(chain, low) - variations(chain, high), 1);
      if (r.low() != r.high()) {
        ASSERT_LT(mpq_class(r.low()), high);
        ASSERT_LT(low, mpq_class(r.high()));
      }
    }
  }
  for (std::size_t i = 1; i < roots.size(); ++i) ASSERT_EQ(compare(roots[i - 1], roots[i]), -1);
}

TEST(AlgebraicRoot, random_polynomials_have_the_roots_that_sturm_counts) {
  std::mt19937_64 random = seeded(kRootSeed);
  RungCounts generic, skew;
  std::size_t roots = 0, wide = 0;
  for (int i = 0; i < 3000; ++i) {
    const int degree = 1 + i % 6, bits = i % 4 == 0 ? 60 : i % 4 == 1 ? 300 : i % 4 == 2 ? 120 : 10;
    // Coefficients of any sizes have roots that are 2^-300, which halving does not reach in doubles.
    RungCounts& counts = i % 3 ? generic : skew;
    const Polynomial p = i % 3 ? generic_polynomial(random, degree, bits) : random_polynomial(random, degree, bits);
    if (p.is_zero()) continue;
    const double lo = i % 5 == 0 ? -0x1p20 : -1, hi = i % 7 == 0 ? 0x1p20 : 1;
    const auto found = roots_in(p, lo, hi, counts);
    ASSERT_NO_FATAL_FAILURE(check_roots(p, lo, hi, found)) << i;
    roots += found.size();
    for (const AlgebraicRoot& r : found) wide += r.high() - r.low() > 0x1p-40 * std::max(std::abs(r.low()), 0x1p-40);
  }
  EXPECT_GT(roots, 2000u);
  EXPECT_GT(generic.filtered(), 50 * generic.exact()) << generic.filtered() << " " << generic.exact();
  EXPECT_GT(skew.filtered(), skew.exact());
  EXPECT_GT(skew.exact(), 50u);
  EXPECT_LT(wide, roots / 100);
}

TEST(AlgebraicRoot, generic_polynomials_of_rotation_events_never_leave_doubles) {
  std::mt19937_64 random = seeded(kRootSeed + 1);
  RungCounts counts;
  std::vector<AlgebraicRoot> all;
  for (int i = 0; i < 4000; ++i)
    for (const AlgebraicRoot& r : roots_in(generic_polynomial(random, i % 2 ? 2 : 4, 60 + i % 240), -1, 1, counts))
      all.push_back(r);
  EXPECT_GT(all.size(), 2000u);
  EXPECT_EQ(counts.filtered(), 4000u);
  RungCounts orders;
  std::sort(all.begin(), all.end(), [&](const auto& a, const auto& b) { return compare(a, b, orders) < 0; });
  EXPECT_EQ(orders.exact(), 0u);
  for (const AlgebraicRoot& r : all) ASSERT_LT(r.high() - r.low(), 0x1p-30);
}

TEST(AlgebraicRoot, rational_roots_come_with_their_multiplicities) {
  std::mt19937_64 random = seeded(kRootSeed + 2);
  RungCounts counts;
  for (int i = 0; i < 1500; ++i) {
    std::map<BigRational, int> multiplicities;
    Polynomial p = poly({i % 2 ? 3 : -1});
    for (int left = 1 + static_cast<int>(random() % 6); left > 0;) {
      const int most = i % 3 == 0 ? 12 : 1 << 20;
      const int num = static_cast<int>(random() % (2 * most)) - most, den = 1 + static_cast<int>(random() % most);
      const BigRational x = fraction(num, den);
      const int times_x = 1 + static_cast<int>(random() % static_cast<unsigned>(std::min(left, 4)));
      for (int k = 0; k < times_x; ++k) p = times(p, linear(x));
      multiplicities[x] += times_x;
      left -= times_x;
    }
    const double lo = i % 4 == 0 ? -1 : -1000, hi = i % 4 == 1 ? 1 : 1000;
    const auto roots = roots_in(p, lo, hi, counts);
    std::size_t at = 0;
    for (const auto& [x, m] : multiplicities) {
      if (x <= exact_value(lo) || x > exact_value(hi)) continue;
      ASSERT_LT(at, roots.size()) << i;
      const AlgebraicRoot& r = roots[at++];
      ASSERT_EQ(r.multiplicity(), m) << i;
      ASSERT_EQ(r.changes_sign(), m % 2 == 1);
      ASSERT_EQ(compare(r, x), 0) << i;
      ASSERT_EQ(rational_value(r), std::optional(x)) << i;
      ASSERT_EQ(sign_at(r, p), 0);
      ASSERT_EQ(compare(r, BigRational(x + fraction(1, std::int64_t{1} << 60))), -1);
      ASSERT_EQ(compare(r, BigRational(x - fraction(1, std::int64_t{1} << 60))), 1);
      ASSERT_LE(exact_value(r.low()), x);
      ASSERT_GE(exact_value(r.high()), x);
    }
    ASSERT_EQ(at, roots.size()) << i;
  }
  EXPECT_GT(counts.exact(), 300u);
  EXPECT_GT(counts.filtered(), 100u);
}

TEST(AlgebraicRoot, touching_at_irrational_numbers_is_never_lost) {
  // (2 t^2 - k)^2 k': double roots at -+sqrt(k / 2)
  for (const std::int64_t scale : {1LL, 7LL, 1LL << 40}) {
    const Polynomial q = poly({-scale, 0, 2 * scale});
    RungCounts counts;
    const auto roots = roots_in(times(q, q), -1, 1, counts);
    EXPECT_EQ(counts.exact(), 1u);
    ASSERT_EQ(roots.size(), 2u);
    const auto simple = roots_in(q, -1, 1);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(roots[i].multiplicity(), 2);
      EXPECT_FALSE(roots[i].changes_sign());
      EXPECT_EQ(compare(roots[i], simple[i]), 0);
      EXPECT_FALSE(rational_value(roots[i]));
      EXPECT_LE(roots[i].high() - roots[i].low(), 0x1p-51);
    }
    const auto thrice = roots_in(times(q, times(q, q)), -1, 1);
    ASSERT_EQ(thrice.size(), 2u);
    EXPECT_EQ(thrice[0].multiplicity(), 3);
    EXPECT_TRUE(thrice[0].changes_sign());
    const auto mixed = roots_in(times(times(q, q), times(linear(fraction(1, 3)), linear(fraction(-1, 2)))), -1, 1);
    ASSERT_EQ(mixed.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(mixed[i].multiplicity(), i % 3 == 0 ? 2 : 1);
  }
}

TEST(AlgebraicRoot, touching_is_told_from_nearly_touching) {
  // (2 t^2 - 1)^2 2^k - e for e = 1, 0, -1: four, two and no roots
  for (const int k : {10, 40, 60, 200, 500}) {
    const Polynomial q = poly({-1, 0, 2}), square = times(q, q);
    for (const int e : {1, 0, -1}) {
      std::vector<Big> c;
      for (int i = 0; i <= 4; ++i) c.push_back(Big(BigInteger(square[i].value() << k)));
      c[0] = c[0] - big(e);
      const Polynomial p(c);
      const auto roots = roots_in(p, -1, 1);
      ASSERT_EQ(roots.size(), e == 1 ? 4u : e == 0 ? 2u : 0u) << k;
      ASSERT_NO_FATAL_FAILURE(check_roots(p, -1, 1, roots));
      for (const AlgebraicRoot& r : roots) ASSERT_EQ(r.multiplicity(), e == 0 ? 2 : 1);
    }
  }
}

TEST(AlgebraicRoot, the_lower_end_is_excluded_and_the_upper_one_included) {
  const Polynomial p = times(times(poly({1, 1}), poly({-1, 1})), poly({-1, 0, 3}));
  for (const Polynomial& q : {p, times(p, poly({1, 1})), times(p, poly({1, -2, 1}))}) {
    const auto roots = roots_in(q, -1, 1);
    ASSERT_EQ(roots.size(), 3u);
    EXPECT_EQ(compare(roots[2], BigRational(1)), 0);
    EXPECT_EQ(roots[2].low(), 1);
    EXPECT_EQ(roots[2].high(), 1);
    EXPECT_EQ(roots_in(q, 1, 2).size(), 0u);
    EXPECT_EQ(roots_in(q, -2, -1).size(), 1u);
    EXPECT_EQ(roots_in(q, -2, -1)[0].approx(), -1);
    EXPECT_EQ(roots_in(q, 1, 1).size(), 0u);
    EXPECT_EQ(roots_in(q, 1, -1).size(), 0u);
  }
  // zero itself, as an end and inside
  const Polynomial t = poly({0, 0, 0, 5, 1});
  EXPECT_EQ(roots_in(t, 0, 1).size(), 0u);
  ASSERT_EQ(roots_in(t, -1, 0).size(), 1u);
  EXPECT_EQ(roots_in(t, -1, 1)[0].multiplicity(), 3);
  EXPECT_EQ(roots_in(t, -1, 1)[0].low(), 0);
  EXPECT_EQ(roots_in(t, -1, 1)[0].high(), 0);
  EXPECT_EQ(rational_value(roots_in(t, -1, 1)[0]), std::optional(BigRational(0)));
}

TEST(AlgebraicRoot, doubles_answer_beside_ends_that_are_roots) {
  // (8 t - 3)^2 (3 t^2 - 1) (t - 2), on ranges that end at 3/8 or at 2.
  const Polynomial p = times(times(times(poly({-3, 8}), poly({-3, 8})), poly({-1, 0, 3})), poly({-2, 1}));
  RungCounts counts;
  const auto above = roots_in(p, 0.375, 2, counts), below = roots_in(p, -1, 0.375, counts);
  ASSERT_EQ(above.size(), 2u);
  EXPECT_NEAR(above[0].approx(), std::sqrt(1 / 3.0), 1e-15);
  EXPECT_EQ(compare(above[1], BigRational(2)), 0);
  EXPECT_EQ(above[1].multiplicity(), 1);
  ASSERT_EQ(below.size(), 2u);
  EXPECT_NEAR(below[0].approx(), -std::sqrt(1 / 3.0), 1e-15);
  EXPECT_EQ(compare(below[1], BigRational(3, 8)), 0);
  EXPECT_EQ(below[1].multiplicity(), 2);
  EXPECT_FALSE(below[1].changes_sign());
  EXPECT_EQ(counts.filtered(), 2u);
  EXPECT_EQ(counts.exact(), 0u);
}

TEST(AlgebraicRoot, lower_degrees_zero_and_what_is_refused) {
  EXPECT_TRUE(Polynomial().is_zero());
  EXPECT_TRUE(poly({0, 0, 0}).is_zero());
  EXPECT_EQ(poly({0, 0, 0}), Polynomial());
  EXPECT_EQ(poly({1, 2, 0, 0}).degree(), 1);
  EXPECT_TRUE(roots_in(Polynomial(), -1, 1).empty());
  EXPECT_TRUE(roots_in(poly({5}), -1, 1).empty());
  ASSERT_EQ(roots_in(poly({-1, 2, 0, 0, 0}), -1, 1).size(), 1u);
  EXPECT_EQ(poly({1, 2, 0, 0, 0, 0, 0, 0}).degree(), 1);
  EXPECT_THROW(poly({1, 2, 3, 4, 5, 6, 7, 8}), std::invalid_argument);
  EXPECT_THROW(roots_in(poly({1, 2}), -HUGE_VAL, 1), std::domain_error);
  EXPECT_THROW(roots_in(poly({1, 2}), -1, std::nan("")), std::domain_error);
  const AlgebraicRoot half = AlgebraicRoot::of(0.5);
  EXPECT_THROW(between(half, half), std::invalid_argument);
  EXPECT_EQ(sign_at(half, Polynomial()), 0);
  EXPECT_EQ(sign_at(half, poly({-4})), -1);
}

/// t^2 (1 - e) - 1/2 (1 + e) over the integers, e = 2^-bits: its root is about (1 + e) sqrt(1/2).
Polynomial near_root_half(int bits) {
  const BigInteger one = BigInteger(1) << static_cast<unsigned>(bits);
  return Polynomial({Big(BigInteger(-one - 1)), Big(), Big(BigInteger(2 * one - 2))});
}

TEST(AlgebraicRoot, neighbours_that_doubles_cannot_tell) {
  for (const int bits : {20, 60, 120, 200, 700}) {
    const AlgebraicRoot a = roots_in(poly({-1, 0, 2}), 0, 1)[0], b = roots_in(near_root_half(bits), 0, 1)[0];
    EXPECT_EQ(compare(a, b), -1);
    EXPECT_EQ(compare(b, a), 1);
    EXPECT_EQ(compare_answer(a, b).rung, bits < 30 ? Rung::doubles : Rung::big);
    EXPECT_EQ(sign_at(b, poly({-1, 0, 2})), 1);
    EXPECT_EQ(sign_at(a, near_root_half(bits)), -1);
    const BigRational x = between(a, b);
    EXPECT_EQ(compare(a, x), -1);
    EXPECT_EQ(compare(b, x), 1);
    const int k = static_cast<int>(msb(denominator(x)));
    EXPECT_LE(std::abs(k - bits), 2);
    EXPECT_LT(compare(AlgebraicRoot::rational(BigRational(x - 1)), a), 0);
    // Both in one polynomial.
    const auto both = roots_in(times(poly({-1, 0, 2}), near_root_half(bits)), 0, 1);
    ASSERT_EQ(both.size(), 2u);
    EXPECT_EQ(compare(both[0], a), 0);
    EXPECT_EQ(compare(both[1], b), 0);
    EXPECT_EQ(between(both[0], both[1]), x) << "it depends on the numbers only";
    // A common divisor with its roots elsewhere.
    const Polynomial more = poly({1, 3});
    const auto c = roots_in(times(poly({-1, 0, 2}), more), 0, 1), d = roots_in(times(near_root_half(bits), more), 0, 1);
    EXPECT_EQ(compare(c[0], d[0]), -1);
    EXPECT_EQ(compare(d[0], c[0]), 1);
    EXPECT_EQ(sign_at(c[0], times(near_root_half(bits), more)), -1);
  }
}

TEST(AlgebraicRoot, equal_roots_of_different_polynomials) {
  std::mt19937_64 random = seeded(kRootSeed + 3);
  RungCounts counts;
  std::size_t shared = 0;
  for (int i = 0; i < 300; ++i) {
    const int bits = i % 2 ? 40 : 150;
    const Polynomial p = generic_polynomial(random, 2, bits), q = generic_polynomial(random, 2, bits),
                     r = generic_polynomial(random, 2, bits);
    const Polynomial pq = times(p, q), pr = times(p, r);
    const auto in_p = roots_in(p, -1, 1), in_pq = roots_in(pq, -1, 1), in_pr = roots_in(pr, -1, 1);
    for (const AlgebraicRoot& x : in_pq) {
      int matches = 0, expected = 0;
      for (const AlgebraicRoot& y : in_pr) matches += compare(x, y, counts) == 0;
      for (const AlgebraicRoot& y : in_p) expected += compare(x, y, counts) == 0;
      ASSERT_EQ(matches, expected) << i;
      ASSERT_EQ(sign_at(x, pr, counts) == 0, matches == 1) << i;
      ASSERT_EQ(sign_at(x, q, counts) == 0, matches == 0) << i;
      ASSERT_EQ(sign_at(x, pq, counts), 0);
      shared += static_cast<std::size_t>(matches);
    }
  }
  EXPECT_GT(shared, 100u);
  EXPECT_GT(counts.filtered(), 100u);
  EXPECT_GE(counts.exact(), 3 * shared);
}

TEST(AlgebraicRoot, signs_at_roots) {
  std::mt19937_64 random = seeded(kRootSeed + 4);
  RungCounts counts;
  for (int i = 0; i < 600; ++i) {
    const Polynomial p = generic_polynomial(random, 2 + i % 3, 80), q = random_polynomial(random, i % 7, 80);
    for (const AlgebraicRoot& r : roots_in(p, -1, 1)) {
      RootBracket b = r.bracket();
      b.refine_to(400);
      // q has no root within 2^-400 of one of p: its sign at the end of the bracket is the one at the root
      ASSERT_EQ(sign_at(r, q, counts), q.is_zero() ? 0 : q.sign_at(b.high().value())) << i;
      ASSERT_EQ(sign_at(r, times(p, linear(fraction(2, 1))), counts), 0);
    }
  }
  EXPECT_GT(counts.filtered(), 300u);
  EXPECT_GT(counts.exact(), 300u);
}

/// -r, by the polynomial at -t.
AlgebraicRoot negated(const AlgebraicRoot& r) {
  const Polynomial& f = r.polynomial();
  std::vector<Big> c;
  for (int k = 0; k <= f.degree(); ++k) c.push_back(k % 2 ? -f[k] : f[k]);
  for (const AlgebraicRoot& m : roots_in(Polynomial(c), -r.high() - 1, -r.low() + 1))
    if (m.low() < -r.low() && -r.high() < m.high()) return m;
  return AlgebraicRoot::rational(BigRational(-*rational_value(r)));
}

TEST(AlgebraicRoot, irrational_roots_are_not_rational) {
  std::mt19937_64 random = seeded(kRootSeed + 7);
  std::size_t proved = 0, irrational = 0, rational = 0;
  for (int i = 0; i < 200; ++i) {
    const Polynomial p = generic_polynomial(random, 2 + i % 4, 3 + i % 90);
    const BigRational x = fraction(static_cast<int>(random() % 200) - 100, 101 + static_cast<int>(random() % 100));
    proved += proved_without_rational_roots(p);
    EXPECT_FALSE(proved_without_rational_roots(times(p, linear(x))));
    for (const AlgebraicRoot& r : roots_in(times(p, linear(x)), -1, 1)) {
      const auto value = rational_value(r);
      ASSERT_TRUE(compare(r, x) != 0 || value == x);
      ASSERT_TRUE(!value || compare(r, *value) == 0);
      // where p has no rational root, x is the only one
      ASSERT_TRUE(!proved_without_rational_roots(p) || value.has_value() == (compare(r, x) == 0));
      ++(value ? rational : irrational);
    }
    for (const AlgebraicRoot& r : roots_in(p, -1, 1))
      ASSERT_FALSE(proved_without_rational_roots(p) && rational_value(r));
  }
  EXPECT_GT(proved, 100u);
  EXPECT_GT(irrational, 100u);
  EXPECT_GE(rational, 200u);
}

TEST(AlgebraicRoot, numbers_between_are_the_simplest) {
  std::mt19937_64 random = seeded(kRootSeed + 5);
  std::vector<AlgebraicRoot> roots;
  for (int i = 0; i < 40; ++i)
    for (const AlgebraicRoot& r : roots_in(generic_polynomial(random, 4, 50), i % 4 ? -1 : -100, i % 3 ? 1 : 100))
      roots.push_back(r);
  for (int n = -8; n <= 8; ++n) roots.push_back(AlgebraicRoot::rational(fraction(n, 4)));
  std::size_t checked = 0;
  for (const AlgebraicRoot& a : roots)
    for (const AlgebraicRoot& b : roots) {
      if (compare(a, b) >= 0) continue;
      const BigRational x = between(a, b);
      ASSERT_EQ(compare(a, x), -1);
      ASSERT_EQ(compare(b, x), 1);
      ASSERT_EQ(between(negated(b), negated(a)), -x);
      const BigInteger den = denominator(x);
      if (den > 1) {  // neighbours with half the denominator are not between
        const BigRational step(1, den);
        ASSERT_GE(compare(a, BigRational(x - step)), 0);
        ASSERT_LE(compare(b, BigRational(x + step)), 0);
      } else if (x != 0) {  // the integer nearer to 0 is not between
        const BigRational nearer = x > 0 ? BigRational(x - 1) : BigRational(x + 1);
        ASSERT_TRUE(compare(a, nearer) >= 0 || compare(b, nearer) <= 0);
      }
      ++checked;
    }
  EXPECT_GT(checked, 1000u);
}

TEST(AlgebraicRoot, compare_is_a_total_order) {
  std::mt19937_64 random = seeded(kRootSeed + 6);
  std::vector<AlgebraicRoot> roots;
  const Polynomial shared = poly({-1, 0, 3});
  for (int i = 0; i < 12; ++i) {
    const Polynomial p = times(i % 2 ? shared : times(shared, shared), random_polynomial(random, 2, 3 + i % 3));
    for (const AlgebraicRoot& r : roots_in(p, -2, 2)) roots.push_back(r);
    roots.push_back(AlgebraicRoot::rational(fraction(i - 6, 3)));
  }
  std::shuffle(roots.begin(), roots.end(), random);
  std::sort(roots.begin(), roots.end(), [](const auto& a, const auto& b) { return compare(a, b) < 0; });
  std::size_t equal = 0;
  for (std::size_t i = 0; i < roots.size(); ++i)
    for (std::size_t k = 0; k < roots.size(); ++k) {
      const int s = compare(roots[i], roots[k]);
      ASSERT_EQ(s, -compare(roots[k], roots[i]));
      ASSERT_TRUE(i < k ? s <= 0 : i > k || s == 0);
      ASSERT_TRUE(s >= 0 || k + 1 == roots.size() || compare(roots[i], roots[k + 1]) < 0) << "transitive";
      equal += i < k && s == 0;
    }
  EXPECT_GT(equal, 30u);
}

TEST(AlgebraicRoot, rationals_of_any_size) {
  const BigInteger huge = BigInteger(1) << 2000;
  const AlgebraicRoot a = AlgebraicRoot::rational(BigRational(huge));
  const AlgebraicRoot b = AlgebraicRoot::rational(BigRational(huge + 2));
  const AlgebraicRoot tiny = AlgebraicRoot::rational(BigRational(1, huge));
  const AlgebraicRoot third = AlgebraicRoot::rational(fraction(-1, 3));
  EXPECT_EQ(compare(a, b), -1);
  EXPECT_EQ(compare(a, a), 0);
  EXPECT_EQ(between(a, b), BigRational(huge + 1));
  EXPECT_EQ(rational_value(b), std::optional(BigRational(huge + 2)));
  EXPECT_EQ(compare(tiny, BigRational(0)), 1);
  EXPECT_EQ(between(AlgebraicRoot::of(0), tiny), BigRational(1, BigInteger(huge * 2)));
  EXPECT_EQ(rational_value(tiny), std::optional(BigRational(1, huge)));
  EXPECT_EQ(between(third, a), BigRational(0));
  EXPECT_EQ(between(a, AlgebraicRoot::rational(BigRational(huge * 4))), BigRational(huge + 1));
  EXPECT_TRUE(std::isfinite(a.approx()));
  EXPECT_EQ(compare(third, -1.0 / 3), compare(third, exact_value(-1.0 / 3)));
  EXPECT_EQ(compare(third, 0.25), -1);
  EXPECT_EQ(compare(a, 1e300), 1);
  EXPECT_EQ(compare(AlgebraicRoot::of(0.5), 0.5), 0);
  EXPECT_EQ(AlgebraicRoot::of(0.1).low(), 0.1);
  EXPECT_EQ(AlgebraicRoot::of(0.1).high(), 0.1);
}

}  // namespace
}  // namespace dymsum::exact
