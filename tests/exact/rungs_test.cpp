// Signs of determinants of points as files have them, by whichever rung tells them, against GMP's rationals.
// DYMSUM_FUZZ_SIGNS sets the number of signs for each kind of coordinates.
#include <gtest/gtest.h>

#include "exact/gmp_bridge.h"
#include "exact/orient.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/verdict.h"

namespace dymsum::exact {
namespace {

class Rungs : public testing::TestWithParam<CoordinateKind> {};

mpq_class less(double a, double b) { return mpq_class(a) - mpq_class(b); }

int orient_by_gmp(Point a, Point b, Point c) {
  return sgn(mpq_class(less(b.x, a.x) * less(c.y, a.y) - less(b.y, a.y) * less(c.x, a.x)));
}

int orient_by_gmp(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  const std::array<mpq_class, 3> u{less(b.x, a.x), less(b.y, a.y), less(b.z, a.z)},
      v{less(c.x, a.x), less(c.y, a.y), less(c.z, a.z)}, w{less(d.x, a.x), less(d.y, a.y), less(d.z, a.z)};
  return sgn(mpq_class((u[1] * v[2] - u[2] * v[1]) * w[0] + (u[2] * v[0] - u[0] * v[2]) * w[1] +
                       (u[0] * v[1] - u[1] * v[0]) * w[2]));
}

// Three or four corners of a small grid, which lie on a line or in a plane often, before they take the kind's form.
TEST_P(Rungs, tell_the_signs_of_rationals) {
  const CoordinateKind kind = GetParam();
  std::mt19937_64 random = seeded(4711);
  const std::uint64_t wanted = oracles::setting("DYMSUM_FUZZ_SIGNS", 20'000) / 2;
  RungCounts plane, space;
  std::uint64_t zeros = 0;
  for (std::uint64_t i = 0; i < wanted; ++i) {
    const auto point = [&] {
      const auto c = [&] { return static_cast<double>(random() % 5) * 0.75; };
      const double x = c(), y = c(), z = c();
      return of_kind(Point3{x, y, z}, kind, random);
    };
    const Point3 a = point(), b = point(), c = point(), d = point();
    const auto flat = [](const Point3& p) { return Point{p.x, p.y}; };
    const int sign = orient_by_gmp(flat(a), flat(b), flat(c)), sign3 = orient_by_gmp(a, b, c, d);
    ASSERT_EQ(orient_sign(flat(a), flat(b), flat(c), plane), sign) << i;
    ASSERT_EQ(orient3_sign(a, b, c, d, space), sign3) << i;
    zeros += (sign == 0) + (sign3 == 0);
  }
  EXPECT_GT(zeros, wanted / 100);
  for (const RungCounts& counts : {plane, space}) {
    EXPECT_GT(counts.at(Rung::doubles), wanted / 2);
    EXPECT_GE(counts.exact(), wanted / 100) << "zeros";
    EXPECT_EQ(counts.at(Rung::big), 0u) << "doubles of one size have integers";
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Rungs, testing::ValuesIn(kCoordinateKinds),
                         [](const auto& kind) { return test_name_of(kind.param); });

}  // namespace
}  // namespace dymsum::exact
