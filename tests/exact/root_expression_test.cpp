// Square-root expressions: identities that are exactly zero, numbers that are nearly so, and random formulas against
// roots taken to thousands of bits by integers alone.
#include "exact/root_expression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <stdexcept>
#include <vector>

#include "exact/root_field.h"

namespace dymsum::exact {
namespace {

using Root = RootExpression;

Root root(std::int64_t n) { return sqrt(Root(n)); }
Root two_to(int e) { return Root(std::ldexp(1.0, e)); }

BigInteger integer_of_bits(std::mt19937_64& random, unsigned bits) {
  BigInteger n = 1;
  for (unsigned k = 1; k < bits; ++k) n = 2 * n + (random() & 1);
  return n;
}

TEST(RootExpression, zeros_are_zero) {
  const Root nested = sqrt(Root(5) + Root(2) * root(6));
  const Root golden = (Root(1) + root(5)) / Root(2);
  for (const Root& zero : {
           nested - root(2) - root(3),
           root(8) - Root(2) * root(2),
           root(2) * root(3) - root(6),
           root(2) + root(3) - sqrt(Root(5) + Root(2) * root(6)),
           sqrt(Root(3) + Root(2) * root(2)) - Root(1) - root(2),
           golden * golden - golden - Root(1),
           Root(1) / (root(3) - root(2)) - root(3) - root(2),
           Root(1) / golden - golden + Root(1),
           root(12) / root(3) - Root(2),
           sqrt(Root(1) / Root(3)) - root(3) / Root(3),
           sqrt(Root(0.5)) - Root(0.5) * root(2),
           sqrt(sqrt(Root(4)) + sqrt(Root(9))) - root(5),
           sqrt(Root(2) + sqrt(Root(2) + root(2))) * sqrt(Root(2) - sqrt(Root(2) + root(2))) - sqrt(Root(2) - root(2)),
           sqrt(Root(112) + Root(70) * root(2) + (Root(46) + Root(34) * root(2)) * root(5)) -
               (Root(5) + Root(4) * root(2) + (Root(3) + root(2)) * root(5)),
           // Shanks 1974.
           root(5) + sqrt(Root(22) + Root(2) * root(5)) - sqrt(Root(11) + Root(2) * root(29)) -
               sqrt(Root(16) - Root(2) * root(29) + Root(2) * sqrt(Root(55) - Root(10) * root(29))),
       }) {
    EXPECT_EQ(sign_of(zero), 0) << to_text(zero);
    EXPECT_EQ(nearest_double(zero), 0);
    EXPECT_FALSE(std::signbit(nearest_double(zero)));
    EXPECT_EQ(narrow_interval(zero).high(), 0);
    // And a little beside zero.
    EXPECT_EQ(sign_of(zero + two_to(-200)), 1) << to_text(zero);
    EXPECT_EQ(sign_of(zero - two_to(-1000)), -1) << to_text(zero);
    EXPECT_EQ(nearest_double(zero + two_to(-1000)), 0x1p-1000);
  }
}

TEST(RootExpression, algebra_and_separation_bound_agree) {
  // The bound alone, as it decides where algebra gives up.
  const auto zero_by_bound = [](const Root& e) {
    const RootParts parts(e.node());
    const auto bits = static_cast<std::int64_t>(parts.separation_bits());
    EXPECT_LT(bits, 1 << 20) << to_text(e);
    for (unsigned precision = 64;; precision *= 2) {
      const std::optional<Ball> value = parts.value(precision);
      if (value && value->sign().value_or(0) != 0) {
        EXPECT_GT(value->top(), -bits) << to_text(e);
        return false;
      }
      if (value && value->top() <= -bits) return true;
    }
  };
  std::mt19937_64 random(3);
  int zeros = 0;
  for (int k = 0; k < 300; ++k) {
    const auto small = [&] { return Root(static_cast<std::int64_t>(random() % 12) + 1); };
    const Root x = small(), y = small(), z = small();
    const Root s = sqrt(x), t = sqrt(y);
    for (const Root& e : {sqrt(x + y + Root(2) * sqrt(x * y)) - s - t, sqrt(x * y * z) - s * t * sqrt(z),
                          sqrt(x + t) - sqrt(z), x / (s + t) - z / t, s + t - sqrt(z) - sqrt(small())}) {
      const RootParts parts(e.node());
      const std::optional<bool> zero = is_zero_by_algebra(parts);
      ASSERT_TRUE(zero.has_value());
      EXPECT_EQ(*zero, zero_by_bound(e)) << to_text(e);
      EXPECT_EQ(*zero, sign_of(e) == 0) << to_text(e);
      zeros += *zero;
    }
  }
  EXPECT_GT(zeros, 600);
  EXPECT_LT(zeros, 1200);
}

/// Asked directly: a sign asks algebra only about what is close to zero.
bool zero_by_algebra(const Root& e) { return is_zero_by_algebra(RootParts(e.node())).value(); }

TEST(RootExpression, algebra_tells_zeros_from_their_conjugates) {
  const Root nested = sqrt(Root(5) + Root(2) * root(6)), a = root(2) - root(5), b = root(2) - root(3);
  EXPECT_TRUE(zero_by_algebra(nested - root(2) - root(3)));
  EXPECT_FALSE(zero_by_algebra(nested + root(2) + root(3)));
  EXPECT_FALSE(zero_by_algebra(nested - root(2) + root(3)));
  EXPECT_FALSE(zero_by_algebra(sqrt(Root(2) + root(2)) * root(3)));
  // Numerators and denominators that are negative.
  EXPECT_TRUE(zero_by_algebra(sqrt(a / b) - sqrt(-a) / sqrt(-b)));
  EXPECT_FALSE(zero_by_algebra(sqrt(a / b) + sqrt(-a) / sqrt(-b)));
  EXPECT_TRUE(zero_by_algebra(sqrt(Root(1) / (a * a)) * a + Root(1)));
}

TEST(RootExpression, the_separation_bound_holds_where_it_is_nearly_reached) {
  // sqrt(n^2 + 1) - n is a little less than 1 / 2n, and its u a little more than 2n.
  for (unsigned k = 1; k < 400; k += 7) {
    const BigInteger n = BigInteger(1) << k;
    const Root e = sqrt(Root(BigInteger(n * n + 1))) - Root(n);
    EXPECT_GT(RootParts(e.node()).separation_bits(), k + 1);
    EXPECT_LT(RootParts(e.node()).separation_bits(), k + 4);
    EXPECT_GT(RootParts((e / (root(2) * Root(n))).node()).separation_bits(), 2 * k + 1);
  }
}

TEST(RootExpression, where_algebra_gives_up_the_bound_decides) {
  // More terms than algebra cares for: 2^18 products of roots, twice.
  Root x(1);
  for (const int p : {2, 3, 5, 7, 11, 13, 17, 19, 23}) x *= Root(1) + root(p);
  const Root e = square(x) - x * x;
  EXPECT_EQ(sign_of(e), 0);
  const Root d = sqrt(x * x) - x;
  EXPECT_FALSE(is_zero_by_algebra(RootParts(d.node())).has_value());
  EXPECT_EQ(sign_of(d), 0);
  EXPECT_EQ(sign_of(d + two_to(-700)), 1);
}

TEST(RootExpression, nearly_zero_is_told_by_precision_and_algebra_is_asked_about_zeros_alone) {
  // sqrt(a +- 2 sqrt(b)) with squares that differ by 2^-bits, as radii of discs between edges that are nearly in line.
  const auto nested = [](std::int64_t a, std::int64_t b) { return sqrt(Root(a) + Root(2) * root(b)); };
  const Root zero = nested(5, 6) + nested(9, 14) - root(2) - root(3) - root(2) - root(7);
  using By = NodeAnswer::By;
  const auto answer_of = [](const Root& e) { return answer_of_node(e.node()); };
  std::map<By, int> decided;
  for (int bits = 70; bits < 900; bits += 10) {
    const NodeAnswer answer = answer_of(zero + two_to(-bits));
    EXPECT_EQ(answer.sign, 1);
    ++decided[answer.by];
  }
  EXPECT_EQ(decided, (std::map<By, int>{{By::precision, 44}, {By::precision_at_last, 39}}));
  EXPECT_EQ(answer_of(zero).sign, 0);
  EXPECT_EQ(answer_of(zero).by, By::algebra);
  EXPECT_EQ(answer_of(nested(5, 6) - root(2)).by, By::doubles);
}

TEST(RootExpression, nearly_zero_is_not_zero) {
  // sqrt(n^2 + 1) - n is close to 1 / 2n; combinations of neighbours cancel to higher orders.
  for (const unsigned bits : {20U, 60U, 100U, 250U, 600U}) {
    const BigInteger n = BigInteger(1) << bits;
    const auto r = [](const BigInteger& v) { return sqrt(Root(v)); };
    const Root first = r(n * n + 1) - Root(n), second = r(n + 1) + r(n - 1) - Root(2) * r(n),
               third = r(n + 3) - Root(3) * r(n + 2) + Root(3) * r(n + 1) - r(n);
    EXPECT_EQ(sign_of(first), 1);
    EXPECT_EQ(sign_of(second), -1);
    EXPECT_EQ(sign_of(third), 1);
    EXPECT_EQ(sign_of(first - Root(1) / Root(BigInteger(2 * n))), -1);
  }
  EXPECT_EQ(compare(root(10) + root(11), root(5) + root(18)), 1);
  const Root x = sqrt(Root(5) + Root(2) * root(6)), y = root(2) + root(3);
  for (const int e : {-60, -200, -900}) {
    EXPECT_EQ(compare(x, y + two_to(e)), -1);
    EXPECT_EQ(compare(x, y * (Root(1) - two_to(e))), 1);
    EXPECT_EQ(compare(sqrt(Root(5) + Root(2) * root(6) + two_to(e)), y), 1);
  }
  EXPECT_EQ(compare(x, y), 0);
}

/// floor(sqrt(num / den) 2^bits), an answer that shares nothing with balls: bits of the result one by one.
BigInteger root_by_bits(const BigInteger& n) {
  BigInteger low = 0;
  for (auto k = static_cast<int>(n.is_zero() ? 0 : msb(n) / 2); k >= 0; --k) {
    const BigInteger next = low + (BigInteger(1) << static_cast<unsigned>(k));
    if (next * next <= n) low = next;
  }
  return low;
}

constexpr unsigned kFixedBits = 1500;
/// Fixed point numbers that err by far less than 2^-1300 in formulas of small numbers.
BigInteger fixed_root(const BigInteger& v) { return root_by_bits(BigInteger(v << kFixedBits)); }
BigInteger fixed_product(const BigInteger& a, const BigInteger& b) { return (a * b) / (BigInteger(1) << kFixedBits); }

TEST(RootExpression, random_formulas_against_fixed_point) {
  std::mt19937_64 random(4);
  struct Both {
    Root e;
    BigInteger fixed;
  };
  int zeros = 0, exact = 0;
  for (int round = 0; round < 80; ++round) {
    std::vector<Both> pool;
    for (int k = 0; k < 4; ++k) {
      const auto n = static_cast<std::int64_t>(random() % 9) + 1;
      const BigInteger fixed = BigInteger(n) << kFixedBits;
      pool.push_back(k < 2 ? Both{Root(n), fixed} : Both{root(n), fixed_root(fixed)});
    }
    for (int k = 0; k < 7; ++k) {
      const Both &x = pool[random() % pool.size()], &y = pool[random() % pool.size()];
      const BigInteger size = boost::multiprecision::abs(y.fixed);
      Both next;
      switch (random() % 6) {
        case 0:
          next = {x.e + y.e, x.fixed + y.fixed};
          break;
        case 1:
          next = {x.e - y.e, x.fixed - y.fixed};
          break;
        case 2:
          next = {x.e * y.e, fixed_product(x.fixed, y.fixed)};
          break;
        case 3:
          // Not by what is small: the fixed point would lose too much.
          if (size < (BigInteger(1) << (kFixedBits - 20))) continue;
          next = {x.e / y.e, (x.fixed << kFixedBits) / y.fixed};
          break;
        default:
          if (x.fixed < (BigInteger(1) << (kFixedBits - 20))) continue;
          next = {sqrt(x.e), fixed_root(x.fixed)};
          break;
      }
      if (RootParts(next.e.node()).separation_bits() < 1200) pool.push_back(next);
    }
    for (const Both& x : pool) {
      for (const Both& y : pool) {
        const Root d = x.e - y.e;
        if (RootParts(d.node()).separation_bits() > 1200) continue;
        RungCounts counts;
        const int sign = sign_of(d, counts);
        const BigInteger fixed = x.fixed - y.fixed;
        const bool tiny = boost::multiprecision::abs(fixed) < (BigInteger(1) << (kFixedBits - 1250));
        EXPECT_EQ(sign, tiny ? 0 : fixed.sign()) << to_text(d);
        EXPECT_EQ(compare(x.e, y.e), sign);
        zeros += sign == 0;
        exact += counts.exact() != 0;
      }
      // Its doubles.
      const Interval narrow = narrow_interval(x.e);
      const BigRational v(x.fixed, BigInteger(1) << kFixedBits), hair(1, BigInteger(1) << (kFixedBits - 250));
      EXPECT_TRUE(exact_value(narrow.low()) <= v + hair && v - hair <= exact_value(narrow.high())) << to_text(x.e);
      EXPECT_TRUE(std::nextafter(std::nextafter(narrow.low(), narrow.high()), narrow.high()) == narrow.high());
      if (sign_of(x.e) != 0) {
        EXPECT_EQ(nearest_double(x.e), round_to_double(v)) << to_text(x.e);
      }
    }
  }
  EXPECT_GT(zeros, 300);
  EXPECT_GT(exact, 100);
}

TEST(RootExpression, roots_that_depend_on_each_other) {
  std::mt19937_64 random(6);
  for (int k = 0; k < 60; ++k) {
    const unsigned bits = 20 + static_cast<unsigned>(random() % 220);
    const BigInteger a = integer_of_bits(random, bits), b = integer_of_bits(random, bits),
                     m = integer_of_bits(random, 1 + static_cast<unsigned>(random() % 60)), c = a * b * m * m;
    const Root ra = sqrt(Root(a)), rb = sqrt(Root(b)), rc = sqrt(Root(c)), mab = Root(BigInteger(m * a * b));
    EXPECT_EQ(sign_of(ra * rb * rc - mab), 0);
    EXPECT_EQ(sign_of(rc / ra - Root(m) * rb), 0);
    EXPECT_EQ(sign_of(rc / ra - Root(m) * rb - Root(1) / Root(c)), -1);
    EXPECT_EQ(sign_of(sqrt(Root(BigInteger(c + 1))) - Root(m) * ra * rb), 1);
    EXPECT_EQ(sign_of(sqrt(Root(a) + Root(b) + Root(2) * ra * rb) - ra - rb), 0);
  }
}

TEST(SquareClasses, find_dependencies_and_nothing_else) {
  SquareClasses classes;
  std::uint32_t members = 0;
  for (const int n : {6, 10, 67 * 67 * 67, 3, 71 * 67}) {
    const auto known = classes.members().size();
    const auto relation = classes.add(n);
    ASSERT_TRUE(relation.has_value());
    EXPECT_EQ(classes.members().size(), known + 1) << n;
    members |= relation->members;
  }
  EXPECT_EQ(members, 31U);
  const auto relation = classes.add(4 * 2 * 71);  // with 6, 3, 67^3 and 71 * 67
  ASSERT_TRUE(relation.has_value());
  EXPECT_EQ(classes.members().size(), 5U);
  EXPECT_EQ(relation->members, 0b11101U);
  EXPECT_EQ(relation->root * relation->root, BigInteger(4 * 2 * 71) * 6 * 67 * 67 * 67 * 3 * 71 * 67);
  std::mt19937_64 random(8);
  for (int k = 0; k < 500; ++k) {
    const BigInteger n = integer_of_bits(random, 1 + static_cast<unsigned>(k)), square = n * n;
    EXPECT_EQ(root_of_square(square), n);
    EXPECT_FALSE(root_of_square(square + 1).has_value());
    EXPECT_EQ(square_characters(square), 0U);
    const BigInteger other = integer_of_bits(random, 200);
    EXPECT_EQ(square_characters(n * other), square_characters(n) ^ square_characters(other));
  }
}

TEST(RootExpression, refuses_what_is_no_number) {
  EXPECT_THROW((void)root(-1), std::domain_error);
  EXPECT_THROW((void)sqrt(root(2) - root(3)), std::domain_error);
  EXPECT_THROW((void)sqrt(root(8) - Root(2) * root(2) - two_to(-300)), std::domain_error);
  EXPECT_THROW((void)(Root(1) / Root(0)), std::domain_error);
  EXPECT_THROW((void)(Root(1) / (root(8) - Root(2) * root(2))), std::domain_error);
  EXPECT_THROW((void)Root(std::nan("")), std::domain_error);
  EXPECT_EQ(sign_of(sqrt(root(8) - Root(2) * root(2))), 0);
}

TEST(RootExpression, huge_and_tiny_numbers) {
  const Root huge = two_to(900), tiny = two_to(-1000);
  EXPECT_EQ(sign_of(sqrt(huge) - two_to(450)), 0);
  EXPECT_EQ(sign_of(sqrt(huge * Root(2)) - two_to(450) * root(2)), 0);
  EXPECT_EQ(sign_of(sqrt(huge * Root(2)) + tiny - two_to(450) * root(2)), 1);
  EXPECT_EQ(sign_of(sqrt(huge * Root(2) + tiny) - two_to(450) * root(2)), 1);
  EXPECT_EQ(sign_of(huge * root(3) / tiny - root(3) * huge * two_to(1000)), 0);
  EXPECT_EQ(nearest_double(sqrt(tiny * tiny * Root(2))), std::ldexp(std::sqrt(2.0), -1000));
  EXPECT_EQ(nearest_double(root(2) * tiny * two_to(-74)), 0x1p-1074);
  EXPECT_EQ(nearest_double(root(2) * tiny * two_to(-76)), 0);
  EXPECT_EQ(nearest_double(root(2) * huge * huge), std::numeric_limits<double>::infinity());
  EXPECT_EQ(nearest_double(-(root(2) * huge * huge)), -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(narrow_interval(root(2) * huge * huge).is_whole());
  EXPECT_EQ(compare(root(2) * huge * huge, root(3) * huge * huge), -1);
}

TEST(RootExpression, nearest_doubles_at_ties) {
  // sqrt(2) - sqrt(2) + x, hidden from intervals, for x in the middle of two doubles, and a hair beside it.
  const Root zero = sqrt(Root(3) + Root(2) * root(2)) - Root(1) - root(2);
  for (const double x : {1.0, 1 + 0x1p-52, 0x1p-1074, 3 * 0x1p-1074, 0x1.fffffffffffffp1022}) {
    const double up = std::nextafter(x, std::numeric_limits<double>::infinity());
    const BigRational midpoint = (exact_value(x) + exact_value(up)) / 2;
    const Root hair = Root(midpoint) * two_to(-200);
    for (const int sign : {1, -1}) {
      const Root e = (zero + Root(midpoint)) * Root(sign);
      EXPECT_EQ(nearest_double(e), sign * round_to_double(midpoint)) << x;
      EXPECT_EQ(nearest_double(e + Root(sign) * hair), sign * up) << x;
      EXPECT_EQ(nearest_double(e - Root(sign) * hair), sign * x) << x;
    }
  }
}

TEST(RootExpression, texts) {
  EXPECT_EQ(to_text(root(2) + Root(0.75)), "sqrt(2) + 3/4");
  EXPECT_EQ(to_text(root(4)), "2");
  EXPECT_EQ(to_text(Root(2) / Root(3) * (Root(3) / Root(-4))), "-1/2");
  EXPECT_EQ(to_text(Root(3) / Root(4) * (Root(2) / Root(3))), "1/2");
  EXPECT_EQ(to_text(Root(1) / Root(6) + Root(1) / Root(3)), "1/2");
  EXPECT_EQ(to_text(Root(1) / Root(10) - Root(4) / Root(15)), "-1/6");
  EXPECT_EQ(to_text((root(2) + Root(1)) * root(3) / (root(5) - Root(-3))),
            "(sqrt(2) + 1) * sqrt(3) / (sqrt(5) - (-3))");
  EXPECT_EQ(to_text(-root(2) + Root(-1)), "-sqrt(2) + (-1)");
  EXPECT_EQ(to_text(root(2) - (root(3) - root(5))), "sqrt(2) - (sqrt(3) - sqrt(5))");
  EXPECT_EQ(to_text(sqrt(Root(0.5))), "1/2 * sqrt(2)");
}

/// The same formula for both types.
template <class T>
T radius_between(const BigInteger& a, const BigInteger& b, double c) {
  return T(a) / (sqrt(T(b)) + square(T(c)) - T(2)) + -T(1);
}

TEST(RootExpression, has_the_vocabulary_of_intervals) {
  const Interval i = radius_between<Interval>(7, 11, 0.5);
  const Root e = radius_between<Root>(7, 11, 0.5);
  EXPECT_TRUE(i.low() <= nearest_double(e) && nearest_double(e) <= i.high());
  RungCounts counts;
  EXPECT_EQ(sign_of(e, counts), 1);
  EXPECT_EQ(sign_of(sqrt(e) * sqrt(e + Root(0)) - e, counts), 0);
  EXPECT_EQ(compare(e, e + two_to(-80), counts), -1);
  EXPECT_EQ(counts, (RungCounts{2, 0, 0, 1}));
}

}  // namespace
}  // namespace dymsum::exact
