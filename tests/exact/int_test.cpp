#include "exact/int.h"

#include <gtest/gtest.h>

#include <cmath>
#include <compare>
#include <concepts>
#include <type_traits>
#include <utility>

#include "exact/gmp_bridge.h"

namespace dymsum::exact {
namespace {

constexpr std::uint64_t kIntSeed = 20240611;

// Result widths, storage, and that nothing narrower comes out.
static_assert(std::is_same_v<decltype(Int<29>{} + Int<29>{}), Int<30>>);
static_assert(std::is_same_v<decltype(Int<29>{} - Int<40>{}), Int<41>>);
static_assert(std::is_same_v<decltype(Int<29>{} * Int<40>{}), Int<69>>);
static_assert(std::is_same_v<decltype(-Int<29>{}), Int<29>>);
static_assert(std::is_same_v<decltype(shift_left<7>(Int<29>{})), Int<36>>);
static_assert(sizeof(Int<62>) == 8 && sizeof(Int<63>) == 16 && sizeof(Int<126>) == 16 && sizeof(Int<127>) == 24);
static_assert(sizeof(Int<252>) == 32 && sizeof(Int<254>) == 32 && sizeof(Int<255>) == 40 && sizeof(Int<508>) == 64);
static_assert(std::is_trivially_copyable_v<Int<29>> && std::is_trivially_copyable_v<Int<126>> &&
              std::is_trivially_copyable_v<Int<508>>);

// What must not compile: narrowing, raw machine integers and doubles, mixing with them, compound assignment.
template <class To, class From>
constexpr bool kConverts = std::is_convertible_v<From, To> || std::is_constructible_v<To, From>;
template <class To, class From>
constexpr bool kAssigns = std::is_assignable_v<To&, From>;
static_assert(kConverts<Int<30>, Int<29>> && kConverts<Int<508>, Int<29>> && kConverts<Int<127>, Int<126>>);
static_assert(!kConverts<Int<29>, Int<30>> && !kConverts<Int<62>, Int<63>> && !kConverts<Int<126>, Int<127>>);
static_assert(!kConverts<Int<507>, Int<508>> && !kConverts<Int<0>, Int<1>>);
static_assert(kAssigns<Int<30>, Int<29>> && !kAssigns<Int<29>, Int<30>> && !kAssigns<Int<252>, Int<253>>);
static_assert(!kConverts<Int<29>, int> && !kConverts<Int<62>, std::int64_t> && !kConverts<Int<62>, double>);
static_assert(!kConverts<std::int64_t, Int<29>> && !kConverts<double, Int<29>> && !kConverts<bool, Int<29>>);
template <class A, class B>
concept Adds = requires(A a, B b) {
  a + b;
};
template <class A, class B>
concept Multiplies = requires(A a, B b) {
  a* b;
};
template <class A, class B>
concept AddsInPlace = requires(A a, B b) {
  a += b;
};
template <class A, class B>
concept Compares = requires(A a, B b) {
  a < b;
};
static_assert(Adds<Int<29>, Int<61>> && Multiplies<Int<29>, Int<61>> && Compares<Int<29>, Int<508>>);
static_assert(!Adds<Int<29>, int> && !Multiplies<Int<29>, std::int64_t> && !Compares<Int<29>, int>);
static_assert(!AddsInPlace<Int<29>, Int<29>> && !Adds<Int<29>, double>);
template <class A, class B>
concept StoresSum = requires(A a, B b) {
  a = b + b;
};
static_assert(StoresSum<Int<30>, Int<29>> && !StoresSum<Int<29>, Int<29>>);

// It works at compile time.
static_assert(sign(Int<29>::from_int64(-3) * Int<61>::from_int64(5)) == -1);
static_assert(Int<508>::max() > Int<507>::max() && Int<200>::max() == shift_left<100>(Int<100>::max()));
static_assert(Int<300>{} == Int<2>::from_int64(0));

int ordering(std::strong_ordering o) { return o < 0 ? -1 : o > 0 ? 1 : 0; }

// One function for all widths: the tests below have some hundred instantiations.
void expect_results(int a, int c, const mpz_class& x, const mpz_class& y, const mpz_class& sum,
                    const mpz_class& difference, const mpz_class& product, int order, bool equal) {
  ASSERT_TRUE(sum == x + y && difference == x - y && product == x * y && order == sgn(mpz_class(x - y)) &&
              equal == (x == y))
      << "widths " << a << ' ' << c << " of " << x << " and " << y << ": sum " << sum << ", difference " << difference
      << ", product " << product << ", order " << order << ", equal " << equal;
}

template <int A, int C>
[[gnu::noinline]] void check_pair(std::mt19937_64& random) {
  const auto as = hard_integers(random, A, 12), cs = hard_integers(random, C, 12);
  for (const mpz_class& x : as) {
    const Int<A> a = from_mpz<A>(x);
    for (const mpz_class& y : cs) {
      const Int<C> c = from_mpz<C>(y);
      expect_results(A, C, x, y, to_mpz(a + c), to_mpz(a - c), to_mpz(a * c), ordering(a <=> c), a == c);
    }
  }
}

template <int A, int... Cs>
void check_row(std::mt19937_64& random, std::integer_sequence<int, Cs...>) {
  (check_pair<A, Cs>(random), ...);
}

template <int... As>
void check_table(std::uint64_t seed, std::integer_sequence<int, As...> widths) {
  std::mt19937_64 random = seeded(seed);
  (check_row<As>(random, widths), ...);
}

TEST(Int, ArithmeticAndOrderAgreeWithGmpForEveryPairOfStorages) {
  check_table(kIntSeed, std::integer_sequence<int, 1, 62, 63, 126, 127, 254>{});
}

TEST(Int, ArithmeticAgreesWithGmpAtTheWidthsOfTheTiers) {
  check_table(kIntSeed + 1, std::integer_sequence<int, 0, 29, 61, 125>{});
}

struct Unary {
  mpz_class value, negation, magnitude, shifted1, shifted64, shifted131, wider1, wider200;
  int sign;
  bool fits_half, fits_itself, equals_wider;
};

void expect_unary(int bits, const mpz_class& x, const Unary& got) {
  SCOPED_TRACE(::testing::Message() << x << " in " << bits << " bits");
  ASSERT_EQ(got.value, x);
  ASSERT_EQ(got.negation, -x);
  ASSERT_EQ(got.magnitude, mpz_class(abs(x)));
  ASSERT_EQ(got.shifted1, x << 1);
  ASSERT_EQ(got.shifted64, x << 64);
  ASSERT_EQ(got.shifted131, x << 131);
  ASSERT_EQ(got.wider1, x);
  ASSERT_EQ(got.wider200, x);
  ASSERT_EQ(got.sign, sgn(x));
  ASSERT_EQ(got.fits_half, abs(x) <= mpz_class(1) << (bits / 2));
  ASSERT_TRUE(got.fits_itself && got.equals_wider);
}

/// Relative error at most 2^-52; exact with at most 53 significant bits.
void expect_close(int bits, const mpz_class& x, double d) {
  const mpq_class error = abs(mpq_class(d) - mpq_class(x));
  ASSERT_LE(error * (mpz_class(1) << 52), abs(x)) << bits << ' ' << x;
  if (x != 0 && mpz_sizeinbase(x.get_mpz_t(), 2) - mpz_scan1(x.get_mpz_t(), 0) <= 53) {
    ASSERT_EQ(error, 0) << bits << ' ' << x;
  }
}

template <int B>
[[gnu::noinline]] void check_width(std::uint64_t seed) {
  std::mt19937_64 random = seeded(seed + B);
  for (const mpz_class& x : hard_integers(random, B, 200)) {
    const Int<B> a = from_mpz<B>(x);
    const Int<B + 200> wide = a;
    expect_unary(B, x,
                 {to_mpz(a), to_mpz(-a), to_mpz(abs(a)), to_mpz(shift_left<1>(a)), to_mpz(shift_left<64>(a)),
                  to_mpz(shift_left<131>(a)), to_mpz(Int<B + 1>(a)), to_mpz(wide), sign(a), fits<B / 2>(a), fits<B>(a),
                  wide == a});
    expect_close(B, x, to_double(a));
  }
  EXPECT_EQ(to_mpz(Int<B>{}), 0);
  EXPECT_EQ(to_mpz(Int<B>::max()), mpz_class(1) << B);
}

template <int... Bs>
void check_widths(std::integer_sequence<int, Bs...>) {
  (check_width<Bs>(kIntSeed), ...);
}

TEST(Int, UnaryOperationsConversionsAndDoublesAgreeWithGmpAtEveryStorageBoundary) {
  check_widths(std::integer_sequence<int, 0, 1, 29, 53, 54, 61, 62, 63, 64, 117>{});
  check_widths(std::integer_sequence<int, 125, 126, 127, 190, 191, 252, 254, 255, 508, 511>{});
}

TEST(Int, DoublesOfTwoLimbIntegersAreCloseWhereTheHalvesMeet) {
  std::mt19937_64 random = seeded(kIntSeed);
  for (int i = 0; i < 20000; ++i) {
    // a high half of any length above a low half around the sign change and the rounding boundaries
    const mpz_class low = (mpz_class(1) << static_cast<int>(random() % 64)) + random_integer(random, 12);
    const mpz_class x = (random_integer(random, 61) << 64) + (random() % 2 ? low : mpz_class(-low));
    expect_close(126, x, to_double(from_mpz<126>(x)));
  }
}

TEST(Int, LargeWidthsPastTheDoubleRangeBecomeInfinite) {
  EXPECT_EQ(to_double(Int<1100>::max()), HUGE_VAL);
  EXPECT_EQ(to_double(-Int<1100>::max()), -HUGE_VAL);
  EXPECT_EQ(to_double(Int<1100>(Int<1023>::max())), 0x1p1023);
  EXPECT_EQ(to_double(Int<1100>::from_int64(-7)), -7.0);
}

TEST(Int, SmallIntegersRoundTrip) {
  constexpr std::int64_t kTop = std::int64_t{1} << 40;
  for (std::int64_t v : {std::int64_t{0}, std::int64_t{1}, std::int64_t{-1}, kTop, -kTop}) {
    EXPECT_EQ(to_mpz(Int<40>::from_int64(v)), mpz_class(static_cast<long>(v)));
    EXPECT_EQ(to_mpz(Int<100>::from_int64(v)), mpz_class(static_cast<long>(v)));
    EXPECT_EQ(to_mpz(Int<400>::from_int64(v)), mpz_class(static_cast<long>(v)));
  }
  EXPECT_EQ(to_mpz(Int<63>::from_int64(INT64_MIN)), -(mpz_class(1) << 63));
  EXPECT_EQ(to_mpz(Int<64>::from_int64(INT64_MAX)), (mpz_class(1) << 63) - 1);
}

#ifndef NDEBUG
TEST(IntDeathTest, DebugBuildsCheckTheBoundOfValuesFromOutside) {
  EXPECT_DEATH(Int<29>::from_int64((std::int64_t{1} << 29) + 1), "");
  EXPECT_DEATH(Int<29>::from_int64(-(std::int64_t{1} << 29) - 1), "");
  EXPECT_DEATH(Int<62>::from_int64(INT64_MIN), "");
  EXPECT_DEATH(Int<100>::from_raw(static_cast<i128>(1) << 101), "");
  EXPECT_DEATH(Int<200>::from_raw(Int<201>::max().raw()), "");
}
#endif

}  // namespace
}  // namespace dymsum::exact
