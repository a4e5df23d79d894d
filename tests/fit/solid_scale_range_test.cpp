// Scales at which a solid passes along a path or fits: against known answers, planar ranges, and sums at every scale.
#include "dymsum/solid_scale_range.h"

#include <gtest/gtest.h>

#include <random>

#include "dymsum/moving_solid_sum.h"
#include "dymsum/scale_range.h"
#include "dymsum/solids.h"

namespace dymsum {
namespace {

Scale scale(const Rational& s) { return Scale::of(s).value(); }

Mesh cube(double half) { return solids::box(-half, -half, -half, half, half, half); }
/// A block of height 2 with a square shaft of side 2.
Mesh block() {
  MeshData m;
  for (const double z : {-1.0, 1.0})
    for (const double r : {3.0, 1.0})
      for (const auto& [x, y] : {std::pair{-1, -1}, std::pair{1, -1}, std::pair{1, 1}, std::pair{-1, 1}})
        m.vertices.push_back({x * r, y * r, z});
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::uint32_t n = (k + 1) % 4;
    m.faces.push_back({k, n, 8 + n, 8 + k});
    m.faces.push_back({4 + n, 4 + k, 12 + k, 12 + n});
    m.faces.push_back({n, k, 4 + k, 4 + n});
    m.faces.push_back({8 + k, 8 + n, 12 + n, 12 + k});
  }
  return Mesh::create(m).value();
}

/// Free at a scale by the definition: no position on the path is in the open sum, asked at many of them.
bool looks_free(const Mesh& part, const std::vector<Point3>& path, const Mesh& obstacles, const Rational& s) {
  MeshData scaled = part.data();
  const double by = s.to_double();
  for (Point3& v : scaled.vertices) v = {-v.x * by, -v.y * by, -v.z * by};
  for (Face& f : scaled.faces) f = {f.rbegin(), f.rend()};
  const Mesh q = Mesh::create(scaled).value();
  for (std::size_t k = 0; k + 1 < path.size() || k == 0; ++k) {
    const Point3 a = path[k], b = path[std::min(k + 1, path.size() - 1)];
    for (int i = 0; i <= 64; ++i) {
      const double t = i / 64.0;
      const Point3 at{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z)};
      if (contains(obstacles, q, at, Semantics::open).value()) return false;
    }
  }
  return true;
}

TEST(SolidScaleRange, APegPassesAShaftUpToItsWidth) {
  const SolidScaleRange range = solid_scale_range(cube(0.5), {{0, 0, 5}, {0, 0, -5}}, block()).value();
  ASSERT_EQ(range.free.size(), 1u);
  EXPECT_FALSE(range.free[0].low.has_value());
  EXPECT_EQ(range.free[0].high, Rational(2));
  EXPECT_FALSE(range.free[0].at_high.empty());
  EXPECT_EQ(range.trap(), Rational(2));
  EXPECT_TRUE(range.contains(scale(2)));
  EXPECT_FALSE(range.contains(scale(*Rational::of(201, 100))));
}

TEST(SolidScaleRange, APathBesideAnObstacleIsFreeUntilItTouches) {
  const SolidScaleRange range = solid_scale_range(cube(1), {{5, -8, 0.5}, {5, 8, 0.5}}, block()).value();
  ASSERT_EQ(range.free.size(), 1u);
  EXPECT_EQ(range.free[0].high, Rational(2));
  const SolidScaleRange blocked = solid_scale_range(cube(1), {{0, 2, -9}, {0, 2, 9}}, block()).value();
  EXPECT_TRUE(blocked.free.empty());
  EXPECT_EQ(blocked.trap(), Rational());
}

TEST(SolidScaleRange, IsWhatPositionsOnThePathSay) {
  std::mt19937_64 random(3);
  const Mesh obstacle = block();
  std::size_t ends = 0;
  for (int round = 0; round < 4; ++round) {
    const auto any = [&] { return static_cast<double>(static_cast<int>(random() % 9) - 4); };
    const Mesh part = solids::box(-0.5 - static_cast<double>(random() % 4) / 4, -0.25, -0.5, 0.5, 0.75, 1);
    const std::vector<Point3> path{{any(), any(), 6}, {0.25, -0.125, 2.5}, {0.25, -0.125, -6}};
    const SolidScaleRange range = solid_scale_range(part, path, obstacle).value();
    std::vector<Rational> queried;
    for (const SolidScaleInterval& i : range.free)
      for (const std::optional<Rational>& end : {i.low, i.high})
        if (end)
          queried.push_back(*end * *Rational::of(255, 256)), queried.push_back(*end * *Rational::of(33, 32)), ++ends;
    queried.push_back(*Rational::of(1, 8)), queried.push_back(Rational(3));
    for (const Rational& s : queried)
      EXPECT_EQ(range.contains(scale(s)), looks_free(part, path, obstacle, s)) << s.to_string();
  }
  EXPECT_GT(ends, 2u);
}

TEST(SolidFitRange, BoxesFitIntoBoxes) {
  const Mesh part = solids::box(0, 0, 0, 2, 1, 1), container = solids::box(0, 0, 0, 7, 3, 4);
  const SolidScaleRange anywhere = solid_fit_range(part, container).value();
  ASSERT_EQ(anywhere.free.size(), 1u);
  EXPECT_EQ(anywhere.free[0].high, Rational(3));
  const SolidScaleRange there = solid_fit_range(part, container, {1, 1, 1}).value();
  ASSERT_EQ(there.free.size(), 1u);
  EXPECT_EQ(there.free[0].high, Rational(2));
  EXPECT_FALSE(there.free[0].at_high.empty());
  EXPECT_TRUE(solid_fit_range(part, container, {-1, 1, 1}).value().free.empty());
}

TEST(SolidScaleRange, RefusesWhatItDoesNotTake) {
  EXPECT_EQ(solid_scale_range(cube(1), std::vector<Point3>{}, block()).error().code, ErrorCode::unsupported_operand);
  EXPECT_EQ(solid_scale_range(Mesh(), {{0, 0, 0}}, block()).error().code, ErrorCode::unsupported_operand);
  EXPECT_EQ(solid_scale_range(cube(1), {{0, 0, NAN}}, block()).error().code, ErrorCode::not_finite);
  EXPECT_EQ(
      solid_scale_range(cube(1), {{0, 0, 0}}, block(), [](std::string_view, double) { return false; }).error().code,
      ErrorCode::cancelled);
}

TEST(ScaledSolidCopies, AreTheSumsOfScaledMasters) {
  const Mesh master = block(), q = cube(0.5);
  std::vector<ScaledSolidCopy> copies;
  for (const char* s : {"1", "3/2", "1", "1/3"}) copies.push_back({Scale::parse(s).value(), {1, 2, 3}});
  const std::vector<SolidCopySum> sums = scaled_solid_copies(master, q, copies).value();
  ASSERT_EQ(sums.size(), copies.size());
  for (std::size_t k = 0; k < copies.size(); ++k) {
    SolidPose pose;
    pose.scale = {copies[k].scale, copies[k].scale, copies[k].scale};
    EXPECT_TRUE(sums[k].sum == posed_sum(master, q, pose).value());
    EXPECT_EQ(sums[k].at, copies[k].at);
  }
}

}  // namespace
}  // namespace dymsum
