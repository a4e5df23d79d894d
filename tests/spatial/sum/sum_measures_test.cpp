// Volume and area of sums: correctly rounded, and the same set whatever the order of its operands' lists.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "dymsum/spatial_sum.h"
#include "dymsum/volume_text.h"
#include "oracles/voxel_solids.h"
#include "spatial/sum/solid_cases.h"
#include "spatial/sum/spatial_sum.h"

namespace dymsum {
namespace {

using spatial::sum_of_solids;

mpf_class real(const Rational& v) {
  mpf_class n(v.numerator(), 2000), d(v.denominator(), 2000);
  return n / d;
}

/// The area in 2000 bits, as nearest double.
void expect_nearest_area(const SpatialSum& sum) {
  mpf_class total(0, 2000);
  for (const SpatialFace& face : sum.faces) {
    std::array<Rational, 3> n;
    for (const auto& loop : face.loops) {
      const auto at = [&](std::size_t k) {
        const RationalPoint3 p = sum.exact(loop[k]);
        return std::array<Rational, 3>{p.x, p.y, p.z};
      };
      const auto a = at(0);
      for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
        const auto b = at(k), c = at(k + 1);
        for (std::size_t i = 0; i < 3; ++i) {
          const std::size_t s = (i + 1) % 3, t = (i + 2) % 3;
          n[i] += (b[s] - a[s]) * (c[t] - a[t]) - (b[t] - a[t]) * (c[s] - a[s]);
        }
      }
    }
    total += sqrt(real(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]));
  }
  total /= 2;
  const double area = sum.area();
  const mpf_class gap = abs(total - area);
  EXPECT_LE(gap, abs(total - std::nextafter(area, 0)));
  EXPECT_LE(gap, abs(total - std::nextafter(area, INFINITY)));
}

/// A tilted frame: a tunnel sheared so that few planes are parallel to axes.
MeshData tilted() {
  MeshData m = tunnel();
  for (Point3& v : m.vertices) v = {v.x + 0.25 * v.y - 0.5 * v.z, v.y + 0.125 * v.x, 3 * v.z + 0.0625 * v.x};
  return m;
}

TEST(SumMeasures, are_the_nearest_doubles) {
  const MeshData ball = solids::geodesic_sphere(2, 1, solids::kDemoSnap).data();
  for (const MeshData& p : {ell(), tunnel(), cavity(), tilted()}) {
    for (const MeshData& q : {box(0.25), ball}) {
      const SpatialSum sum = sum_of_solids(p, q, {}).value();
      EXPECT_EQ(sum.volume(), sum.volume_exact().to_double());
      EXPECT_EQ(sum.volume_exact_within(1u << 30), sum.volume_exact());
      expect_nearest_area(sum);
    }
  }
}

// 6 + 2 sqrt 3 in doubles of one rounding each came out one unit too small.
TEST(SumMeasures, of_convex_solids_are_the_nearest_doubles) {
  const Mesh corner =
      Mesh::create({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}})
          .value();
  EXPECT_EQ(minkowski_sum(corner, corner)->area(), 9.464101615137755);
  EXPECT_EQ(surface_text(*minkowski_sum(corner, corner)), "9.4641016151377546e+00");
  std::mt19937_64 random(12);
  for (int pair = 0; pair < 20; ++pair) {
    const auto cloud = [&] {
      std::vector<Point3> points;
      for (int k = 0; k < 12; ++k)
        points.push_back({std::ldexp(random(), -64), std::ldexp(random(), -64), std::ldexp(random(), -64)});
      return convex_hull(points).value();
    };
    const Mesh p = cloud(), q = cloud();
    EXPECT_EQ(minkowski_sum(p, q)->area(), sum_of_solids(p.data(), q.data(), {})->area());
  }
}

TEST(SumMeasures, of_crossing_faces_have_denominators_of_their_own) {
  const SpatialSum sum = sum_of_solids(tilted(), solids::geodesic_sphere(2, 1, solids::kDemoSnap).data(), {}).value();
  EXPECT_GT(sum.volume_exact().denominator().size(), 60u);
  EXPECT_FALSE(sum.volume_exact_within(100).has_value());
}

TEST(SumMeasures, of_any_size_are_text) {
  const auto cube = [](double size) { return scaled(solids::box(0, 0, 0, 1, 1, 1), size, size, size).value(); };
  const SpatialSum small = minkowski_sum(cube(0x1p-400), cube(0x1p-400)).value();
  EXPECT_EQ(small.volume(), 0);
  EXPECT_EQ(volume_text(small).substr(0, 4), "4.64");  // 2^-1197
  EXPECT_EQ(surface_text(minkowski_sum(cube(0.5), cube(0.5)).value()), "6.0000000000000000e+00");
  EXPECT_TRUE(std::isinf(minkowski_sum(cube(0x1p400), cube(0x1p400)).value().volume()));
  EXPECT_EQ(SpatialSum().volume(), 0);
  EXPECT_EQ(SpatialSum().area(), 0);
  EXPECT_EQ(SpatialSum().volume_exact(), 0);
}

/// The same surface with vertices and faces in another order.
MeshData shuffled(const MeshData& mesh, unsigned seed) {
  std::mt19937_64 random(seed);
  std::vector<std::uint32_t> name(mesh.vertices.size());
  std::iota(name.begin(), name.end(), 0u);
  std::shuffle(name.begin(), name.end(), random);
  MeshData other;
  other.vertices.resize(mesh.vertices.size());
  for (std::size_t v = 0; v < name.size(); ++v) other.vertices[name[v]] = mesh.vertices[v];
  for (Face face : mesh.faces) {
    for (std::uint32_t& v : face) v = name[v];
    std::rotate(face.begin(), face.begin() + static_cast<std::ptrdiff_t>(random() % face.size()), face.end());
    other.faces.push_back(face);
  }
  std::shuffle(other.faces.begin(), other.faces.end(), random);
  return other;
}

TEST(SpatialSumValue, does_not_depend_on_the_order_of_lists_or_operands) {
  const MeshData ball = solids::geodesic_sphere(2, 1, solids::kDemoSnap).data();
  for (const MeshData& p : {ell(), tunnel(), cavity(), tilted()}) {
    for (const MeshData& q : {box(1), ball}) {
      const SpatialSum sum = sum_of_solids(p, q, {}).value();
      const SpatialSum other = sum_of_solids(shuffled(q, 1), shuffled(p, 2), {}).value();
      EXPECT_TRUE(sum == other);
      EXPECT_FALSE(sum == sum_of_solids(p, moved(q, 0x1p-20, 0, 0), {}).value()) << "another set";
    }
  }
}

TEST(SpatialSumValue, of_coordinates_that_differ_by_four_hundred_bits_is_that_of_their_shape) {
  MeshData fine = ell();
  for (Point3& v : fine.vertices) v.y *= 0x1p-400;
  const SpatialSum sum = sum_of_solids(fine, box(1), {}).value();
  EXPECT_EQ(sum.faces.size(), sum_of_solids(ell(), box(1), {}).value().faces.size());
  EXPECT_TRUE(sum == sum_of_solids(box(1), fine, {}).value());
}

}  // namespace
}  // namespace dymsum
