// Sums of several operands through vertices that are no doubles, and in an order in which they are.
#include <gtest/gtest.h>

#include "dymsum/solids.h"
#include "dymsum/spatial_sum.h"
#include "spatial/sum/solid_cases.h"

namespace dymsum {
namespace {

Mesh prism(const std::vector<std::pair<double, double>>& ring, double height) {
  MeshData m;
  const auto n = static_cast<std::uint32_t>(ring.size());
  for (const double z : {0.0, height})
    for (const auto& [x, y] : ring) m.vertices.push_back({x, y, z});
  Face bottom, top;
  for (std::uint32_t i = 0; i < n; ++i) {
    bottom.insert(bottom.begin(), i), top.push_back(n + i);
    m.faces.push_back({i, (i + 1) % n, n + (i + 1) % n, n + i});
  }
  m.faces.insert(m.faces.end(), {bottom, top});
  return Mesh::create(m).value();
}
/// Over a wide L, one arm of which rises by `rise` over 48 of its size towards the corner.
Mesh sloped(double size, double rise) {
  return prism({{0, 0},
                {50 * size, 0},
                {50 * size, 2 * size},
                {2 * size, 2 * size + rise},
                {2 * size, 61 * size},
                {0, 61 * size}},
               5 * size);
}
/// Over a square on its tip with a dent: what supports a slope is another tip than what supports its end.
Mesh dented(double size, double depth) {
  return prism({{0, -size}, {size, 0}, {0, size}, {-size, 0}, {-size / 4, -size * depth}}, 2 * size);
}

TEST(SeveralOperands, through_fractions_are_those_of_larger_ones) {
  int fractions = 0;
  for (const double slope : {0.5, 1.0, 2.0}) {
    const Mesh p = sloped(1, 16 * slope), q = dented(1, 0.25), r = Mesh::create(ell()).value();
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
  // A slope of 7 by 16 n: with the dented prism positions are fractions of n, of twice as many digits as doubles have.
  constexpr double n = 0x1p27 + 1;
  const Mesh p = sloped(n, 21), q = dented(1.0 / 16, 0.25), r = Mesh::create(ell()).value();
  const SpatialSum first = minkowski_sum(p, q).value();
  EXPECT_EQ(as_mesh(first).error().code, ErrorCode::unsupported_operand);
  const Result<SpatialSum> three = minkowski_sum(std::vector<Mesh>{p, q, r});
  ASSERT_TRUE(three.ok()) << three.error().to_string();
  const Mesh later = as_mesh(minkowski_sum(q, r).value()).value();
  EXPECT_EQ(*three, minkowski_sum(p, later).value());
  // One that goes with neither of them in doubles.
  const Mesh other = dented(1, 0.3);
  EXPECT_EQ(minkowski_sum(std::vector<Mesh>{p, q, other}).value(),
            minkowski_sum(std::vector<Mesh>{q, other, p}).value());
}

}  // namespace
}  // namespace dymsum
