#include "exact/orient.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "exact/gmp_bridge.h"

namespace dymsum::exact {
namespace {

constexpr std::uint64_t kOrientSeed = 31337;
constexpr double kGreatest = std::numeric_limits<double>::max();

int cross_by_gmp(Point a, Point b, Point c, Point d) {
  const mpq_class ux = mpq_class(b.x) - mpq_class(a.x), uy = mpq_class(b.y) - mpq_class(a.y);
  const mpq_class wx = mpq_class(d.x) - mpq_class(c.x), wy = mpq_class(d.y) - mpq_class(c.y);
  return sgn(mpq_class(ux * wy - uy * wx));
}

int dot_by_gmp(Point a, Point b, Point c, Point d) {
  const mpq_class ux = mpq_class(b.x) - mpq_class(a.x), uy = mpq_class(b.y) - mpq_class(a.y);
  const mpq_class wx = mpq_class(d.x) - mpq_class(c.x), wy = mpq_class(d.y) - mpq_class(c.y);
  return sgn(mpq_class(ux * wx + uy * wy));
}

struct RungTally {
  std::array<int, 4> by_rung{};
  int wrong = 0, zeros = 0;

  void see(SignAnswer answer, int expected) {
    ++by_rung[static_cast<int>(answer.rung)];
    wrong += answer.sign != expected;
    zeros += expected == 0;
  }
  void all(Point a, Point b, Point c, Point d) {
    see(cross_answer(a, b, c, d), cross_by_gmp(a, b, c, d));
    see(dot_answer(a, b, c, d), dot_by_gmp(a, b, c, d));
    see(cross_answer(a, b, a, c), cross_by_gmp(a, b, a, c));
    EXPECT_EQ(orient_sign(a, b, c), cross_sign(a, b, a, c));
  }
  int at(Rung rung) const { return by_rung[static_cast<int>(rung)]; }
};

template <class Draw>
RungTally tally(std::uint64_t seed, int rounds, Draw draw) {
  std::mt19937_64 random = seeded(seed);
  RungTally t;
  for (int i = 0; i < rounds; ++i) {
    const auto point = [&] {
      const double x = draw(random), y = draw(random);
      return Point{x, y};
    };
    const Point a = point(), b = point(), c = point(), d = point();
    t.all(a, b, c, d);
  }
  return t;
}

TEST(Orient, TheFilterAnswersNearlyAllGenericCalls) {
  const RungTally t =
      tally(kOrientSeed, 5000, [](auto& random) { return static_cast<double>(random() >> 11) * 0x1p-53; });
  EXPECT_EQ(t.wrong, 0);
  EXPECT_GT(t.at(Rung::doubles), 14990);
}

TEST(Orient, TinyGridsNeedIntegersForZerosAlone) {
  const RungTally t = tally(kOrientSeed, 5000, [](auto& random) { return static_cast<double>(random() % 4); });
  EXPECT_EQ(t.wrong, 0);
  EXPECT_GT(t.zeros, 1000);
  EXPECT_EQ(t.at(Rung::integers), t.zeros);  // the filter opens only on zeros here
  EXPECT_EQ(t.at(Rung::big), 0);
}

TEST(Orient, ArbitraryExponentsReachEveryRung) {
  const RungTally t = tally(kOrientSeed, 5000, [](auto& random) {
    for (;;) {
      const double v = std::bit_cast<double>(random());
      if (std::isfinite(v)) return v;
    }
  });
  EXPECT_EQ(t.wrong, 0);
  EXPECT_GT(t.at(Rung::big), 1000);
  EXPECT_GT(t.at(Rung::doubles), 1000);
}

TEST(Orient, ExtremesOfTheRangeUnderflowAndOverflow) {
  const std::array<double, 13> values = {0,   0x1p-1074, -0x1p-1074, 0x3p-1074, 0x1p-1022,  0x1p-540,  -0x1p-537,
                                         1.0, 0x1p512,   -0x1p1023,  kGreatest, -kGreatest, 0x1.fp-500};
  const RungTally t = tally(kOrientSeed, 20000, [&](auto& random) { return values[random() % values.size()]; });
  EXPECT_EQ(t.wrong, 0);
  EXPECT_GT(t.zeros, 100);
  for (const Rung rung : {Rung::doubles, Rung::integers, Rung::big}) EXPECT_GT(t.at(rung), 100);
}

TEST(Orient, NearlyCollinearPointsOfEveryScale) {
  std::mt19937_64 random = seeded(kOrientSeed);
  RungTally t;
  for (int i = 0; i < 5000; ++i) {
    // c is on the line ab, rounded, or one or two ulps beside it
    const double scale = std::ldexp(1.0, static_cast<int>(random() % 80) - 40);
    const double along = static_cast<double>(random() % 1000) / 37;
    const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53 * scale; };
    const Point a{unit(), unit()}, b{unit(), unit()};
    Point c{a.x + along * (b.x - a.x), a.y + along * (b.y - a.y)};
    for (int k = static_cast<int>(random() % 3); k > 0; --k)
      c.y = std::nextafter(c.y, random() % 2 ? kGreatest : -kGreatest);
    t.all(a, b, c, a);
  }
  EXPECT_EQ(t.wrong, 0);
  EXPECT_GT(t.at(Rung::integers), 500);
}

TEST(Orient, IntegersEndExactlyAtTheirWidth) {
  // o, (1, 1) and (r, r) on the unit grid: the extent r decides, one bit early or late would be seen
  const auto rung = [](double r) { return cross_answer({0, 0}, {1, 1}, {0, 0}, {r, r}).rung; };
  EXPECT_EQ(rung(0x1p125), Rung::integers);
  EXPECT_EQ(rung(std::nextafter(0x1p125, kGreatest)), Rung::big);
  EXPECT_EQ(rung(0x1p126), Rung::big);
  for (const double r : {0x1p61, 0x1p62, 0x1p125, 0x1p126}) {
    RungTally t;
    const double next = std::nextafter(r, kGreatest);
    t.all({0, 0}, {1, 1}, {0, 0}, {next, next});
    t.all({0, 0}, {r, next}, {0, 0}, {next, next + (next - r)});
    t.all({0, 0}, {r, r}, {-1, 1}, {r, -r});
    t.all({-1, 0}, {r, r}, {0, -1}, {r, r});
    EXPECT_EQ(t.wrong, 0) << r;
  }
}

TEST(Orient, RoundedDifferencesWhoseProductsUnderflowAreNotTrusted) {
  // With u = b - a and w = d - c, l = ux wy is 2^-1075 (1 - 2^-55)(1 + 2^-52) and r = uy wx is 2^-1075 (1 + 2^-53)^2 >
  // l. In doubles ux rounds up and l to 2^-1074; uy and wx round down and r to 0: the rounded sign is wrong.
  const Point a{0x1p-555, -0x1p-553}, b{0x1p-500, 0x1p-500};
  const Point c{-0x1p-628, 0}, d{0x1p-575, 0x1.0000000000001p-575};
  EXPECT_GT((b.x - a.x) * (d.y - c.y) - (b.y - a.y) * (d.x - c.x), 0);
  ASSERT_EQ(cross_by_gmp(a, b, c, d), -1);
  EXPECT_EQ(cross_sign(a, b, c, d), -1);
}

TEST(Orient, AFarOffsetCostsNoBits) {
  // the extent is 2^53 units at an offset of 2^90 units in one operand: the exact rung stays narrow
  const Point a{0x1p60, 0x1p60}, b{0x1p60 + 0x1p20, 0x1p60 + 0x1p20}, c{0x1p60 + 0x1p21, 0x1p60 + 0x1p21};
  EXPECT_EQ(cross_answer(a, b, a, c).rung, Rung::integers);
  EXPECT_EQ(cross_answer(a, b, a, c).sign, 0);
}

TEST(Orient, CountsTellWhoAnswered) {
  RungCounts counts;
  EXPECT_EQ(orient_sign({0, 0}, {1, 0}, {0, 1}, counts), 1);
  EXPECT_EQ(counts, (RungCounts{1, 0, 0, 0}));
  EXPECT_EQ(orient_sign({0, 0}, {1, 1}, {2, 2}, counts), 0);
  EXPECT_EQ(counts, (RungCounts{1, 0, 1, 0}));
  EXPECT_EQ(dot_sign({0, 0}, {1, 0}, {0, 0}, {0, 1}, counts), 0);
  EXPECT_EQ(dot_sign({0, 0}, {1, 0}, {0, 0}, {-3, 1}, counts), -1);
  EXPECT_EQ(cross_sign({0, 0}, {1, 0}, {5, 5}, {6, 4}, counts), -1);
  EXPECT_EQ(counts, (RungCounts{3, 0, 2, 0}));
}

TEST(Orient, SwapsChangeTheSignAndRotationsKeepIt) {
  std::mt19937_64 random = seeded(kOrientSeed);
  int zeros = 0;
  for (int i = 0; i < 3000; ++i) {
    const auto point = [&] {
      const double x = 0.1 * static_cast<double>(random() % 8), y = 0.7 * static_cast<double>(random() % 8);
      return Point{x, y};
    };
    const Point a = point(), b = point(), c = point();
    const int s = orient_sign(a, b, c);
    zeros += s == 0;
    ASSERT_EQ(orient_sign(b, c, a), s);
    ASSERT_EQ(orient_sign(b, a, c), -s);
    ASSERT_EQ(cross_sign(a, b, b, c), s);
  }
  EXPECT_GT(zeros, 100);
}

}  // namespace
}  // namespace dymsum::exact
