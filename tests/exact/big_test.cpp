#include "exact/big.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "exact/polynomials.h"

namespace dymsum::exact {
namespace {

constexpr std::uint64_t kBigSeed = 77;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

BigRational from_mpq(const mpq_class& v) {
  return BigRational(BigInteger(v.get_num().get_str()), BigInteger(v.get_den().get_str()));
}

static_assert(std::is_convertible_v<Int<29>, Big> && std::is_convertible_v<Int<508>, Big>);
static_assert(!std::is_convertible_v<std::int64_t, Big> && !std::is_convertible_v<double, Big>);

/// `d` is the double nearest to v with ties to even, judged by its neighbours alone.
void expect_nearest(const mpq_class& v, double d) {
  const mpq_class limit = mpq_class(mpz_class(1) << 1024) - mpq_class(mpz_class(1) << 970);
  if (abs(v) >= limit) {
    ASSERT_EQ(d, sgn(v) * kInfinity) << v;
    return;
  }
  ASSERT_TRUE(std::isfinite(d)) << v;
  const mpq_class error = abs(mpq_class(d) - v);
  for (double neighbour : {std::nextafter(d, kInfinity), std::nextafter(d, -kInfinity)}) {
    // past the largest double stands 2^1024
    const mpq_class there =
        std::isfinite(neighbour) ? mpq_class(neighbour) : mpq_class((neighbour > 0 ? 1 : -1) * (mpz_class(1) << 1024));
    const mpq_class other = abs(there - v);
    ASSERT_LE(error, other) << v << ' ' << d;
    if (error == other) {
      ASSERT_EQ(std::bit_cast<std::uint64_t>(d) % 2, 0u) << v << ' ' << d;
    }
  }
  if (d == 0) {
    ASSERT_FALSE(std::signbit(d)) << v;
  }
}

TEST(Big, ArithmeticAndConversionsAgreeWithGmp) {
  std::mt19937_64 random = seeded(kBigSeed);
  for (int i = 0; i < 3000; ++i) {
    const mpz_class x = random_integer(random, 1500), y = random_integer(random, i % 2 ? 1500 : 60);
    const Big a = big(x), b = big(y);
    ASSERT_EQ(to_mpz(a + b), x + y);
    ASSERT_EQ(to_mpz(a - b), x - y);
    ASSERT_EQ(to_mpz(a * b), x * y);
    ASSERT_EQ(to_mpz(-a), -x);
    ASSERT_EQ(to_mpz(abs(a)), mpz_class(abs(x)));
    ASSERT_EQ(to_mpz(shift_left<67>(a)), x << 67);
    ASSERT_EQ(a < b, x < y);
    ASSERT_EQ(a == b, x == y);
    ASSERT_EQ(sign(a), sgn(x));
    const double d = to_double(a);
    expect_nearest(x, d);
  }
}

template <int B>
void check_from_int() {
  std::mt19937_64 random = seeded(kBigSeed);
  for (const mpz_class& x : hard_integers(random, B, 50)) {
    ASSERT_EQ(to_mpz(to_big(from_mpz<B>(x))), x) << B;
    ASSERT_EQ(to_mpz(Big(from_mpz<B>(x))), x) << B;
    ASSERT_EQ(to_mpz(Big::from_int64(-2) * from_mpz<B>(x)), -2 * x) << B;
    ASSERT_EQ(to_mpz(from_mpz<B>(x) - Big::from_int64(7)), x - 7) << B;
  }
}

TEST(Big, FixedWidthsConvertAtEveryStorage) {
  check_from_int<1>();
  check_from_int<62>();
  check_from_int<63>();
  check_from_int<126>();
  check_from_int<127>();
  check_from_int<254>();
  check_from_int<508>();
  EXPECT_EQ(to_mpz(Big::from_int64(INT64_MIN)), -(mpz_class(1) << 63));
}

TEST(Big, DyadicDifferences) {
  EXPECT_EQ(to_mpz(Big::from_dyadic_difference(-3, 200, 5, 2)), mpz_class(-3) * (mpz_class(1) << 200) - 20);
}

TEST(Rounding, DoublesAreTheirOwnNearest) {
  std::mt19937_64 random = seeded(kBigSeed);
  int subnormal = 0;
  for (int i = 0; i < 20000; ++i) {
    const double d = std::bit_cast<double>(i % 8 == 0 ? random() & 0x800fffffffffffff : random());
    if (!std::isfinite(d) || d == 0) continue;
    subnormal += std::fpclassify(d) == FP_SUBNORMAL;
    ASSERT_EQ(to_mpq(exact_value(d)), mpq_class(d));
    ASSERT_EQ(round_to_double(exact_value(d)), d);
  }
  EXPECT_GT(subnormal, 1000);
}

TEST(Rounding, HalfwaysAndTheirNeighbourhoodGoToEven) {
  std::mt19937_64 random = seeded(kBigSeed + 1);
  const mpq_class nudge(mpz_class(1), mpz_class(1) << 2000);
  for (int i = 0; i < 3000; ++i) {
    double d = std::bit_cast<double>(random());
    if (i % 4 == 0) d = std::bit_cast<double>(random() & 0x800fffffffffffff);       // subnormal
    if (i % 4 == 1) d = std::ldexp(1.0, static_cast<int>(random() % 2098) - 1074);  // the spacing changes here
    if (i % 4 == 2) d = std::bit_cast<double>(random() & 0x8000ffffffffffff);       // deep subnormal
    if (!std::isfinite(d)) continue;
    const double next = std::nextafter(d, i % 2 ? kInfinity : -kInfinity);
    if (!std::isfinite(next)) continue;
    const mpq_class half = (mpq_class(d) + mpq_class(next)) / 2;
    for (const mpq_class& v : {half, mpq_class(half + nudge), mpq_class(half - nudge)}) {
      expect_nearest(v, round_to_double(from_mpq(v)));
    }
  }
}

TEST(Rounding, RandomFractions) {
  std::mt19937_64 random = seeded(kBigSeed + 2);
  for (int i = 0; i < 4000; ++i) {
    const mpz_class den = abs(random_integer(random, i % 3 ? 1200 : 90)) + 1;
    mpq_class v(random_integer(random, i % 2 ? 1200 : 90), den);
    v.canonicalize();
    expect_nearest(v, round_to_double(from_mpq(v)));
  }
}

TEST(Rounding, EndsOfTheRange) {
  const mpz_class one = 1;
  const mpq_class limit = mpq_class(one << 1024) - mpq_class(one << 970);
  const mpq_class tiny(one, one << 1075), hair(one, one << 3000);
  EXPECT_EQ(round_to_double(from_mpq(limit)), kInfinity);
  EXPECT_EQ(round_to_double(from_mpq(-limit)), -kInfinity);
  EXPECT_EQ(round_to_double(from_mpq(limit - hair)), std::numeric_limits<double>::max());
  EXPECT_EQ(round_to_double(from_mpq(hair - limit)), std::numeric_limits<double>::lowest());
  EXPECT_EQ(round_to_double(from_mpq(mpq_class(one << 5000))), kInfinity);
  EXPECT_EQ(round_to_double(from_mpq(tiny)), 0.0);  // a tie between 0 and the smallest subnormal
  EXPECT_EQ(round_to_double(from_mpq(tiny + hair)), 0x1p-1074);
  EXPECT_EQ(round_to_double(from_mpq(3 * tiny)), 0x1p-1073);
  EXPECT_EQ(round_to_double(from_mpq(-tiny)), 0.0);
  EXPECT_FALSE(std::signbit(round_to_double(from_mpq(-tiny))));
  EXPECT_FALSE(std::signbit(round_to_double(from_mpq(-hair))));
  EXPECT_EQ(round_to_double(BigRational(0)), 0.0);
  EXPECT_THROW((void)exact_value(kInfinity), std::domain_error);
  EXPECT_THROW((void)exact_value(std::nan("")), std::domain_error);
}

TEST(Rationals, PublicValuesAreCanonicalAndRoundTrip) {
  EXPECT_EQ(to_rational(BigRational(-6, 4)), *Rational::of(-3, 2));
  EXPECT_EQ(to_rational(ratio(Big::from_int64(6), Big::from_int64(-4))), *Rational::of(-3, 2));
  EXPECT_EQ(to_rational(BigRational(0)), Rational{});
  EXPECT_THROW((void)ratio(Big::from_int64(1), Big{}), std::domain_error);
  std::mt19937_64 random = seeded(kBigSeed + 3);
  for (int i = 0; i < 500; ++i) {
    mpq_class v(random_integer(random, 300), abs(random_integer(random, 300)) + 1);
    v.canonicalize();
    const Rational r = to_rational(from_mpq(v));
    ASSERT_EQ(r.numerator(), v.get_num().get_str());
    ASSERT_EQ(r.denominator(), v.get_den().get_str());
    ASSERT_EQ(to_mpq(exact_value(r)), v);
    expect_nearest(v, r.to_double());
  }
}

}  // namespace
}  // namespace dymsum::exact
