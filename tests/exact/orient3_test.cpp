#include "exact/orient.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "exact/gmp_bridge.h"

namespace dymsum::exact {
namespace {

constexpr double kLargestDouble = std::numeric_limits<double>::max();
constexpr double kTiny = std::numeric_limits<double>::denorm_min();

int orient3_by_gmp(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  const auto minus = [&a](const Point3& p) {
    return std::array<mpq_class, 3>{mpq_class(p.x) - mpq_class(a.x), mpq_class(p.y) - mpq_class(a.y),
                                    mpq_class(p.z) - mpq_class(a.z)};
  };
  const auto u = minus(b), v = minus(c), w = minus(d);
  return sgn(mpq_class((u[1] * v[2] - u[2] * v[1]) * w[0] + (u[2] * v[0] - u[0] * v[2]) * w[1] +
                       (u[0] * v[1] - u[1] * v[0]) * w[2]));
}

struct Tally {
  std::array<int, 4> by_rung{};
  int wrong = 0, zeros = 0;
  int at(Rung rung) const { return by_rung[static_cast<int>(rung)]; }
};

template <class Draw>
Tally tally3(std::uint64_t seed, int rounds, Draw draw) {
  std::mt19937_64 random = seeded(seed);
  Tally t;
  for (int i = 0; i < rounds; ++i) {
    std::array<Point3, 4> p;
    for (Point3& q : p) {
      const double x = draw(random), y = draw(random), z = draw(random);
      q = {x, y, z};
    }
    if (i % 3 == 0) p[3] = {p[0].x + p[1].x - p[2].x, p[0].y + p[1].y - p[2].y, p[0].z + p[1].z - p[2].z};
    for (Point3& q : p) {
      for (double* c : {&q.x, &q.y, &q.z}) {
        if (!std::isfinite(*c)) *c = kLargestDouble;
      }
    }
    const SignAnswer answer = orient3_answer(p[0], p[1], p[2], p[3]);
    const int expected = orient3_by_gmp(p[0], p[1], p[2], p[3]);
    ++t.by_rung[static_cast<int>(answer.rung)];
    t.wrong += answer.sign != expected;
    t.zeros += expected == 0;
  }
  return t;
}

TEST(Orient3, SmallIntegersAreDecidedInOneWordWhereTheFilterIsSilent) {
  const Tally t = tally3(1, 20000, [](auto& random) { return static_cast<double>(random() % 9) - 4; });
  EXPECT_EQ(t.wrong, 0);
  EXPECT_GT(t.zeros, 5000);
  EXPECT_GT(t.at(Rung::doubles), 10000);
  EXPECT_EQ(t.at(Rung::integers), t.zeros);
  EXPECT_EQ(t.at(Rung::big), 0);
}

TEST(Orient3, FreeDoublesAreMostlyFiltered) {
  const Tally t = tally3(2, 20000, [](auto& random) { return std::ldexp(static_cast<double>(random() >> 11), -53); });
  EXPECT_EQ(t.wrong, 0);
  EXPECT_GT(t.at(Rung::doubles), 13000);
  // The fourth point rounded from the plane of the others.
  EXPECT_GT(t.at(Rung::double_pairs), 2000);
  EXPECT_GT(t.at(Rung::integers), 2000);
}

TEST(Orient3, AnyExponentsFromTheSmallestToTheLargestDouble) {
  const Tally t = tally3(3, 6000, [](auto& random) {
    const double m = std::ldexp(static_cast<double>(random() >> 11) + 1, -52) * (random() % 2 ? 1 : -1);
    return std::ldexp(m, static_cast<int>(random() % 2090) - 1070);
  });
  EXPECT_EQ(t.wrong, 0);
  EXPECT_GT(t.at(Rung::big), 1000);
}

TEST(Orient3, ExtremeCoordinates) {
  const double values[] = {0, kTiny, -kTiny, kLargestDouble, -kLargestDouble, 1, 1 + 0x1p-52, 0x1p300, 0x1p-300};
  const Tally t = tally3(4, 6000, [&](auto& random) { return values[random() % std::size(values)]; });
  EXPECT_EQ(t.wrong, 0);
  EXPECT_GT(t.zeros, 100);
}

// A product of two small differences underflows, and a large third one would have made it count.
TEST(Orient3, AnUnderflowThatALargeFactorWouldHaveUndone) {
  const Point3 a{0, 0, 0}, b{0x1p-550, 0, 0x1p-600}, c{0, 0x1p-550, 0}, d{0, 0, 0x1p600};
  EXPECT_EQ(orient3_sign(a, b, c, d), 1);
  EXPECT_EQ(orient3_sign(a, c, b, d), -1);
}

TEST(Orient3, CollinearPointsHaveNoNormalOnAnyAxis) {
  EXPECT_TRUE(collinear({0, 0, 0}, {1, 2, 3}, {2, 4, 6}));
  EXPECT_TRUE(collinear({1, 1, 1}, {1, 1, 1}, {5, 4, 3}));
  EXPECT_FALSE(collinear({0, 0, 0}, {1, 2, 3}, {2, 4, 6 + 0x1p-50}));
  EXPECT_EQ(normal_sign({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, Axis::z), 1);
  EXPECT_EQ(normal_sign({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, Axis::x), 1);
  EXPECT_EQ(normal_sign({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, Axis::y), 1);
}

}  // namespace
}  // namespace dymsum::exact
