// Parts that are far smaller or larger than what they have to fit: their scales are those of a moderate part, exactly.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "dymsum/scale_range.h"
#include "dymsum/solid_scale_range.h"
#include "dymsum/solids.h"

namespace dymsum {
namespace {

constexpr int kPowers[] = {-1074, -1000, -200, -67, -64, -63, -20, 30, 63, 66, 300, 900};

Rational power(int k) {
  Rational p = 1;
  for (int i = 0; i < std::abs(k); ++i) p = k > 0 ? p * Rational(2) : p / Rational(2);
  return p;
}

Region triangle(int k, double x = 0, double y = 0) {
  const double u = std::ldexp(1.0, k);
  return Region::create({{{{{x * u, y * u}, {(x + 3) * u, y * u}, {(x + 1) * u, (y + 2) * u}}, {}}}, {}, {}}).value();
}

Mesh wedge(int k) {
  const double u = std::ldexp(1.0, k);
  MeshData data{{{0, 0, 0}, {3 * u, 0, 0}, {0, 2 * u, 0}, {u, u, 4 * u}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  return Mesh::create(std::move(data)).value();
}

/// Ends of intervals of the part 2^k times as large, and of the part itself.
template <class Range>
void expect_same(const Result<Range>& made, const Range& one, int k) {
  ASSERT_TRUE(made.ok()) << k << ": " << made.error().to_string();
  ASSERT_EQ(made->free.size(), one.free.size()) << k;
  const Rational by = power(k);
  for (std::size_t i = 0; i < one.free.size(); ++i) {
    EXPECT_EQ(made->free[i].low.has_value(), one.free[i].low.has_value()) << k;
    EXPECT_EQ(made->free[i].high.has_value(), one.free[i].high.has_value()) << k;
    if (one.free[i].low) {
      EXPECT_EQ(*made->free[i].low * by, *one.free[i].low) << k;
    }
    if (one.free[i].high) {
      EXPECT_EQ(*made->free[i].high * by, *one.free[i].high) << k;
    }
    EXPECT_EQ(made->free[i].at_low, one.free[i].at_low) << k;
    EXPECT_EQ(made->free[i].at_high, one.free[i].at_high) << k;
  }
}

TEST(PartUnit, PlanarPartsOfAllSizes) {
  const Region room = Region::create({{{{{-1, -1}, {2, -1}, {2, 1}, {0, 2}, {-1, 1}}, {}}}, {}, {}}).value();
  const Region wall = triangle(0, 1, 1);
  const std::vector<Point> path{{-5, 0}, {5, 0.5}};
  for (const int k : kPowers) {
    expect_same(fit_range(triangle(k), room), fit_range(triangle(0), room).value(), k);
    expect_same(fit_range(triangle(k), room, {0.5, 0.25}), fit_range(triangle(0), room, {0.5, 0.25}).value(), k);
    expect_same(scale_range(triangle(k), path, wall), scale_range(triangle(0), path, wall).value(), k);
    expect_same(scale_range(triangle(k), {path[0]}, wall), scale_range(triangle(0), {path[0]}, wall).value(), k);
  }
}

TEST(PartUnit, SolidsOfAllSizes) {
  const Mesh room = wedge(2), wall = wedge(0);
  const std::vector<Point3> path{{-5, 0, 1}, {5, 0.5, 1}};
  for (const int k : kPowers) {
    expect_same(solid_fit_range(wedge(k), room), solid_fit_range(wedge(0), room).value(), k);
    expect_same(solid_fit_range(wedge(k), room, {1, 1, 0}), solid_fit_range(wedge(0), room, {1, 1, 0}).value(), k);
    expect_same(solid_scale_range(wedge(k), path, wall), solid_scale_range(wedge(0), path, wall).value(), k);
  }
}

TEST(PartUnit, PartsFarFromTheOriginForTheirSizeAreRefusedOrFit) {
  const double far = 1e300, small = 1e290;
  const Region part = Region::create({{{{{far, 0}, {far + small, 0}, {far, small}}, {}}}, {}, {}}).value();
  for (const double size : {1.0, 1e10, 1e280, 1e299}) {
    const Region room = Region::create({{{{{0, 0}, {size, 0}, {size, size}, {0, size}}, {}}}, {}, {}}).value();
    for (const Result<ScaleRange>& range : {fit_range(part, room), fit_range(part, room, {0, 0})})
      if (range.ok()) EXPECT_EQ(range->free.size(), 1u) << size;
      else EXPECT_NE(range.error().message, "") << size;
  }
}

}  // namespace
}  // namespace dymsum
