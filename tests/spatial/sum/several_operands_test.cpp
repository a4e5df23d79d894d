// Sums of several operands through vertices that are no doubles, and in an order in which they are.
#include <gtest/gtest.h>

#include "dymsum/solids.h"
#include "dymsum/spatial_sum.h"
#include "spatial/sum/solid_cases.h"

namespace dymsum {
namespace {

/// A prism over an L of which one arm is cut at a slope, turned so that it stands on another plane.
Mesh sloped(double slope, int turns) {
  MeshData m;
  const std::vector<std::pair<double, double>> ring{{0, 0}, {5, 0}, {5, 2}, {2, 2 + slope}, {2, 6}, {0, 6}};
  for (const double z : {0.0, 5.0})
    for (const auto& [x, y] : ring) m.vertices.push_back({x, y, z});
  m.faces = {{5, 4, 3, 2, 1, 0}, {6, 7, 8, 9, 10, 11}};
  for (std::uint32_t i = 0; i < 6; ++i) m.faces.push_back({i, (i + 1) % 6, 6 + (i + 1) % 6, 6 + i});
  for (int k = 0; k < turns; ++k)
    for (Point3& v : m.vertices) v = {v.y, v.z, v.x};
  return Mesh::create(m).value();
}

TEST(SeveralOperands, through_fractions_are_those_of_larger_ones) {
  int fractions = 0;
  for (const double slope : {0.5, 1.0, 1.5}) {
    const Mesh p = sloped(slope, 0), q = sloped(2 * slope, 1), r = Mesh::create(ell()).value();
    const SpatialSum two = minkowski_sum(p, q).value();
    fractions += as_mesh(two).ok() ? 0 : 1;
    const Result<SpatialSum> three = minkowski_sum(std::vector<Mesh>{p, q, r});
    ASSERT_TRUE(three.ok()) << three.error().to_string();
    // all of it so many times larger that sums of two have whole vertices
    const double by = 81.0 * 25 * 7;
    const auto large = [&](const Mesh& m) { return scaled(m, by, by, by).value(); };
    const Result<Mesh> both = as_mesh(minkowski_sum(large(p), large(q)).value());
    ASSERT_TRUE(both.ok()) << both.error().to_string();
    const SpatialSum larger = minkowski_sum(*both, large(r)).value();
    EXPECT_EQ(three->volume_exact() * *Rational::of(by) * *Rational::of(by) * *Rational::of(by), larger.volume_exact());
    EXPECT_EQ(three->volume(), three->volume_exact().to_double());
    EXPECT_NEAR(three->area() * by * by, larger.area(), larger.area() * 1e-12);
    ASSERT_EQ(three->vertices.size(), larger.vertices.size());
    EXPECT_EQ(three->faces, larger.faces);
    EXPECT_EQ(three->tight_faces.size() + three->tight_segments.size() + three->tight_points.size(),
              larger.tight_faces.size() + larger.tight_segments.size() + larger.tight_points.size());
    for (std::size_t v = 0; v < larger.vertices.size(); ++v) {
      EXPECT_EQ(three->exact(v).x * *Rational::of(by), larger.exact(v).x);
      EXPECT_NEAR(three->vertices[v].x, three->exact(v).x.to_double(), three->at_error);
      EXPECT_NEAR(three->vertices[v].z, three->exact(v).z.to_double(), three->at_error);
    }
    EXPECT_TRUE(three->rounded().ok());
  }
  EXPECT_GT(fractions, 0) << "nothing was tested";
}

TEST(SeveralOperands, in_another_order_where_the_first_sum_is_no_operand) {
  // Slopes of 7 by n and by m: positions of the first two are fractions of both. The third one is a multiple of n long.
  constexpr double n = 0x1p27 + 1, m = 0x1p27 - 1;
  const auto large = [](double size, int turns) {
    MeshData mesh = sloped(0, turns).data();
    for (Point3& v : mesh.vertices)
      for (double* c : {&v.x, &v.y, &v.z}) *c *= size;
    return mesh;
  };
  MeshData first = large(n, 0), second = large(m, 1), third = ell();
  for (Point3& v : first.vertices)
    if (v.x == 2 * n && v.y == 2 * n) v.y += 21;
  for (Point3& v : second.vertices)
    if (v.z == 2 * m && v.x == 2 * m) v.x += 21;
  for (Point3& v : third.vertices) v = {3 * n * v.x, 3 * n * v.y, 3 * n * v.z};
  const Mesh p = Mesh::create(first).value(), q = Mesh::create(second).value(), r = Mesh::create(third).value();
  const Result<Mesh> two = as_mesh(minkowski_sum(p, q).value());
  ASSERT_FALSE(two.ok());
  const Result<SpatialSum> three = minkowski_sum(std::vector<Mesh>{p, q, r});
  ASSERT_TRUE(three.ok()) << three.error().to_string();
  const Mesh pr = as_mesh(minkowski_sum(p, r).value()).value();
  EXPECT_EQ(*three, minkowski_sum(pr, q).value());
}

}  // namespace
}  // namespace dymsum
