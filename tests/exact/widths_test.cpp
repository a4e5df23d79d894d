// The bit budget of the planar predicates, attained: every chain edge, gap, D, N, order at the corners of the
// coordinate range.
#include <gtest/gtest.h>

#include <array>

#include "exact/big.h"
#include "exact/gmp_bridge.h"
#include "exact/grid.h"
#include "exact/int.h"

namespace dymsum::exact {
namespace {

struct Bound {
  mpz_class edge, gap, d, n, order;
  void see(const mpz_class& e, const mpz_class& g, const mpz_class& dd, const mpz_class& nn, const mpz_class& o) {
    edge = std::max(edge, mpz_class(abs(e)));
    gap = std::max(gap, mpz_class(abs(g)));
    d = std::max(d, mpz_class(abs(dd)));
    n = std::max(n, mpz_class(abs(nn)));
    order = std::max(order, mpz_class(abs(o)));
  }
};

/// One chain on coordinates +-2^B and near, chosen by the bits of `choice`, in C and in GMP.
template <class C>
void check_chain(int bits, std::uint64_t choice, Bound& seen) {
  int used = 0;
  const auto coordinate = [&] {
    const mpz_class top = mpz_class(1) << bits;
    return (choice >> used++) & 1 ? top : mpz_class(-top);
  };
  std::array<mpz_class, 16> z;
  std::array<C, 16> c;
  for (int i = 0; i < 16; ++i) {
    z[i] = coordinate();
    c[i] = from_mpz<C::kBits>(z[i]);
  }
  const auto chain = [](const auto& v) {
    const auto ex = v[0] - v[1], ey = v[2] - v[3], fx = v[4] - v[5], fy = v[6] - v[7];
    const auto gx = (v[8] + v[9]) - (v[10] + v[11]), gy = (v[12] + v[13]) - (v[14] + v[15]);
    const auto d = ex * fy - ey * fx;
    const auto n = gx * fy - gy * fx;
    const auto hx = (v[10] + v[11]) - (v[8] + v[9]), hy = (v[14] + v[15]) - (v[12] + v[13]);
    const auto n2 = hx * fy - hy * fx;  // -n: two crossings at either end of the segment
    return std::make_tuple(ex, gx, d, n, n2, n * d - n2 * d);
  };
  std::array<mpz_class, 16>& y = z;
  const mpz_class ex = y[0] - y[1], ey = y[2] - y[3], fx = y[4] - y[5], fy = y[6] - y[7];
  const mpz_class gx = (y[8] + y[9]) - (y[10] + y[11]), gy = (y[12] + y[13]) - (y[14] + y[15]);
  const mpz_class d = ex * fy - ey * fx, n = gx * fy - gy * fx, n2 = -n, order = n * d - n2 * d;
  const auto [cex, cgx, cd, cn, cn2, corder] = chain(c);
  ASSERT_EQ(to_mpz(cex), ex);
  ASSERT_EQ(to_mpz(cgx), gx);
  ASSERT_EQ(to_mpz(cd), d);
  ASSERT_EQ(to_mpz(cn), n);
  ASSERT_EQ(to_mpz(cn2), n2);
  ASSERT_EQ(to_mpz(corder), order);
  ASSERT_EQ(sign(corder), sgn(order));
  ASSERT_EQ(compare_ratios(cn, Int<1>::from_int64(1), cn2, Int<1>::from_int64(1)), sgn(mpz_class(n - n2)));
  seen.see(ex, gx, d, n, order);
}

template <int B>
void check_tier() {
  Bound seen;
  for (std::uint64_t choice = 0; choice < (1u << 16); ++choice) check_chain<Int<B>>(B, choice, seen);
  using Widths = PlanarWidths<B>;
  // edges, gaps, D and N reach their bounds exactly: no narrower type would do
  EXPECT_EQ(seen.edge, mpz_class(1) << Widths::Edge::kBits);
  EXPECT_EQ(seen.gap, mpz_class(1) << Widths::Gap::kBits);
  EXPECT_EQ(seen.d, mpz_class(1) << Widths::D::kBits);
  EXPECT_EQ(seen.n, mpz_class(1) << Widths::N::kBits);
  EXPECT_EQ(seen.order, mpz_class(1) << Widths::Order::kBits);
}

TEST(Widths, PlanarChainAttainsItsBoundsInTheNarrowTier) { check_tier<29>(); }
TEST(Widths, PlanarChainAttainsItsBoundsInTheMiddleTier) { check_tier<61>(); }
TEST(Widths, PlanarChainAttainsItsBoundsInTheWideTier) { check_tier<125>(); }

template <class C>
C number(std::int64_t v) {
  return C::from_int64(v);
}

template <class C>
void check_signs() {
  for (std::int64_t a = -2; a <= 2; ++a)
    for (std::int64_t b = -2; b <= 2; ++b)
      for (std::int64_t c = -2; c <= 2; ++c)
        for (std::int64_t d = -2; d <= 2; ++d) {
          const C ca = number<C>(a), cb = number<C>(b), cc = number<C>(c), cd = number<C>(d);
          const auto expect = [](std::int64_t v) { return (v > 0) - (v < 0); };
          ASSERT_EQ(sign_of_cross(ca, cb, cc, cd), expect(a * d - b * c));
          ASSERT_EQ(sign_of_dot(ca, cb, cc, cd), expect(a * c + b * d));
          ASSERT_EQ(compare(ca, cb), expect(a - b));
          if (b == 0 || d == 0) continue;
          const std::int64_t numerator = a * d - c * b, denominator = b * d;
          ASSERT_EQ(compare_ratios(ca, cb, cc, cd), expect(numerator) * expect(denominator));
        }
}

TEST(Signs, SmallCasesOfEveryNumberType) {
  check_signs<Int<29>>();
  check_signs<Int<61>>();
  check_signs<Int<125>>();
  check_signs<Int<300>>();
  check_signs<Big>();
}

TEST(Signs, WidthsMix) {
  const auto small = Int<2>::from_int64(-3);
  const auto wide = Int<500>::max();
  EXPECT_EQ(sign_of_cross(small, wide, wide, small), -1);
  EXPECT_EQ(compare_ratios(small, wide, wide, small), 1);
  EXPECT_EQ(compare(Big(small), Big(wide)), -1);
  EXPECT_EQ(sign_of_dot(Big(small), Big(wide), Big(wide), Int<2>::from_int64(1)), -1);
}

}  // namespace
}  // namespace dymsum::exact
