// The hull contains its points, is convex, and has only points of theirs as corners: that is what a hull is.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "dymsum/solids.h"
#include "exact/orient.h"
#include "spatial/mesh/half_edges.h"
#include "spatial/mesh/mesh_cases.h"

namespace dymsum::spatial_test {
namespace {

/// A hull's error, or what is wrong with it: not valid, not convex, not canonical, a point outside, a corner from
/// nowhere.
std::string problem(const std::vector<Point3>& points) {
  const Result<Mesh> hull = convex_hull(points);
  if (!hull) return std::string(name(hull.error().code));
  const Result<Mesh> checked = Mesh::create(hull->data());
  if (!checked) return "not valid: " + checked.error().to_string();
  if (checked->shell_count() != hull->shell_count()) return "shells";
  if (const auto error = convexity_error(*hull)) return error->to_string();
  if (hull->canonical().data() != hull->data()) return "not canonical";
  for (const spatial::FacePlane& plane : spatial::face_planes(hull->data())) {
    for (const Point3& p : points) {
      if (spatial::height_sign(hull->vertices(), plane, p) > 0) return "a point outside";
    }
  }
  for (const Point3& v : hull->vertices()) {
    if (std::find(points.begin(), points.end(), v) == points.end()) return "a corner that is no point";
  }
  return "";
}

template <class Draw>
std::vector<Point3> random_points(std::uint64_t seed, std::size_t count, Draw draw) {
  std::mt19937_64 random(seed);
  std::vector<Point3> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = draw(random), y = draw(random), z = draw(random);
    points.push_back({x, y, z});
  }
  return points;
}

TEST(ConvexHull, TinyGridsWithEveryDegeneracy) {
  int flat = 0;
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    const auto points = random_points(seed, 4 + seed % 30,
                                      [&](auto& random) { return static_cast<double>(random() % (2 + seed % 3)); });
    const std::string found = problem(points);
    flat += found == "no_area";
    ASSERT_TRUE(found.empty() || found == "no_area") << "seed " << seed << ": " << found;
  }
  EXPECT_GT(flat, 10);
  EXPECT_LT(flat, 1000);
}

TEST(ConvexHull, FreeCoordinatesOfAllMagnitudes) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    EXPECT_EQ(problem(random_points(
                  seed, 60, [](auto& random) { return std::ldexp(static_cast<double>(random() >> 11), -53) - 0.5; })),
              "");
    EXPECT_EQ(problem(random_points(seed, 12,
                                    [](auto& random) {
                                      return std::ldexp(static_cast<double>(random() >> 11) - 0x1p52,
                                                        static_cast<int>(random() % 1900) - 1000);
                                    })),
              "");
  }
}

TEST(ConvexHull, OrderAndRepetitionDoNotMatter) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    auto points = random_points(seed, 40, [](auto& random) { return static_cast<double>(random() % 6); });
    const Result<Mesh> hull = convex_hull(points);
    ASSERT_TRUE(hull.ok());
    points.insert(points.end(), points.begin(), points.begin() + 20);
    std::shuffle(points.begin(), points.end(), std::mt19937_64(seed));
    EXPECT_EQ(convex_hull(points)->data(), hull->data());
    EXPECT_EQ(convex_hull(hull->vertices())->data(), hull->data());
  }
}

TEST(ConvexHull, KnownSolids) {
  std::vector<Point3> lattice;
  for (int x = 0; x <= 4; ++x) {
    for (int y = 0; y <= 4; ++y) {
      for (int z = 0; z <= 4; ++z) lattice.push_back({double(x), double(y), double(z)});
    }
  }
  EXPECT_EQ(convex_hull(lattice)->data(), solids::box(0, 0, 0, 4, 4, 4).canonical().data());
  EXPECT_EQ(convex_hull(lattice)->faces().size(), 6u);
  for (const solids::NamedMesh& model : solids::thesis_models()) {
    EXPECT_EQ(convex_hull(model.mesh.vertices())->data(), model.mesh.canonical().data()) << model.name;
  }
}

TEST(ConvexHull, AThousandPointsOnASphereAndTenThousandInABox) {
  const Mesh sphere = solids::geodesic_sphere(10, 1, solids::kDemoSnap);
  EXPECT_EQ(convex_hull(sphere.vertices())->data(), sphere.canonical().data());
  EXPECT_EQ(sphere.vertices().size(), 1002u);
  const auto points = random_points(5, 10000, [](auto& random) { return static_cast<double>(random() % 1000); });
  EXPECT_EQ(problem(points), "");
}

TEST(ConvexHull, FlatAndBadInputs) {
  EXPECT_EQ(problem({}), "no_area");
  EXPECT_EQ(problem({{1, 2, 3}}), "no_area");
  EXPECT_EQ(problem(std::vector<Point3>(10, {1, 2, 3})), "no_area");
  EXPECT_EQ(problem({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}), "no_area");
  EXPECT_EQ(problem({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {5, 7, 0}}), "no_area");
  EXPECT_EQ(problem({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {5, 7, 0x1p-1074}}), "");
  const Result<Mesh> bad = convex_hull(std::vector<Point3>{{0, 0, 0}, {0, std::nan(""), 0}});
  EXPECT_EQ(name(bad.error().code), "not_finite");
  EXPECT_EQ(bad.error().evidence.vertex, 1);
}

}  // namespace
}  // namespace dymsum::spatial_test
