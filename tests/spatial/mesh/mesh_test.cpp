// What meshes tell about themselves, and moving them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include <gmpxx.h>

#include "dymsum/solids.h"
#include "spatial/mesh/mesh_cases.h"

namespace dymsum::spatial_test {
namespace {

constexpr double kMax = std::numeric_limits<double>::max();

Mesh made(MeshData data) {
  Result<Mesh> mesh = Mesh::create(std::move(data));
  EXPECT_TRUE(mesh.ok()) << mesh.error().to_string();
  return mesh.ok() ? std::move(mesh).value() : Mesh{};
}

TEST(Mesh, CountsOfACube) {
  const Mesh mesh = made(cube());
  EXPECT_EQ(mesh.edge_count(), 12u);
  EXPECT_EQ(mesh.triangle_count(), 12u);
  EXPECT_EQ(mesh.shell_count(), 1u);
  EXPECT_EQ(volume(mesh), 1);
  EXPECT_EQ(surface_area(mesh), 6);
  EXPECT_EQ(bounds(mesh), (std::array<double, 6>{0, 0, 0, 1, 1, 1}));
}

TEST(Mesh, TheEmptyMeshIsValid) {
  const Mesh mesh = made({});
  EXPECT_TRUE(mesh.empty());
  EXPECT_EQ(mesh, Mesh());
  EXPECT_EQ(mesh.shell_count() + mesh.edge_count() + mesh.triangle_count(), 0u);
  EXPECT_EQ(volume(mesh), 0);
  EXPECT_EQ(surface_area(mesh), 0);
  EXPECT_EQ(bounds(mesh), (std::array<double, 6>{}));
  EXPECT_TRUE(mesh.canonical().empty());
  EXPECT_EQ(negated(mesh), mesh);
}

TEST(Mesh, FacesNeedNotBeConvexAndShellsNotSimple) {
  EXPECT_EQ(volume(made(l_prism())), 3);
  EXPECT_EQ(surface_area(made(l_prism())), 14);
  const Mesh ring = made(square_ring());
  EXPECT_EQ(volume(ring), 8);
  EXPECT_EQ(surface_area(ring), 32);
  EXPECT_EQ(ring.edge_count(), 32u);
  const Mesh two = made(joined(cube(), cube(2, {3, 0, 0})));
  EXPECT_EQ(two.shell_count(), 2u);
  EXPECT_EQ(volume(two), 9);
}

TEST(Mesh, VolumeIsExactAndRoundedOnce) {
  // the terms are 2^159 times larger than the volume: far away, and thin
  const double far = 0x1p53;
  MeshData data = cube(2, {far, -far, far});
  EXPECT_EQ(volume(made(data)), 8);
  MeshData thin = cube();
  for (Point3& p : thin.vertices) p.z = p.z == 1 ? 1 + 0x1p-52 : 1;
  EXPECT_EQ(volume(made(thin)), 0x1p-52);
  // 1/6 and 1/2 of what has no double
  EXPECT_EQ(volume(made(tetrahedron())), 1.0 / 6);
  const double third = 1.0 / 3;
  const Result<Mesh> scaled_tetrahedron = scaled(made(tetrahedron()), third, 1, 3);
  ASSERT_TRUE(scaled_tetrahedron.ok());
  EXPECT_EQ(volume(*scaled_tetrahedron), third / 2);
}

// Rational arithmetic of another library: no double is nearer to the exact volume.
TEST(Mesh, VolumeIsTheNearestDoubleToTheRationalOne) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    std::mt19937_64 random(seed);
    const int spread = seed % 3 == 0 ? 300 : seed % 3 == 1 ? 40 : 1;
    std::vector<Point3> points(4 + seed % 20);
    for (Point3& p : points) {
      for (double* c : {&p.x, &p.y, &p.z}) {
        *c = std::ldexp(static_cast<double>(random() >> 11) - 0x1p52, static_cast<int>(random() % spread) - 52);
      }
    }
    const Result<Mesh> hull = convex_hull(points);
    ASSERT_TRUE(hull.ok());
    mpq_class six = 0;
    for (const Face& face : hull->faces()) {
      const auto at = [&](std::size_t k) -> const Point3& { return hull->vertices()[face[k]]; };
      const mpq_class ax(at(0).x), ay(at(0).y), az(at(0).z);
      for (std::size_t k = 2; k < face.size(); ++k) {
        const mpq_class bx(at(k - 1).x), by(at(k - 1).y), bz(at(k - 1).z), cx(at(k).x), cy(at(k).y), cz(at(k).z);
        six += ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
      }
    }
    const double v = volume(*hull);
    const mpq_class error = abs(mpq_class(v) - six / 6);
    for (const double other : {std::nextafter(v, 0.0), std::nextafter(v, kMax)}) {
      EXPECT_LE(error, abs(mpq_class(other) - six / 6)) << seed;
    }
  }
}

TEST(Mesh, TheLargestAndTheSmallestDoubles) {
  MeshData large = cube();
  for (Point3& p : large.vertices) p = {p.x == 0 ? -kMax : kMax, p.y == 0 ? -kMax : kMax, p.z == 0 ? -kMax : kMax};
  const Mesh mesh = made(large);
  EXPECT_EQ(volume(mesh), std::numeric_limits<double>::infinity());
  EXPECT_EQ(convexity_error(mesh), std::nullopt);
  const double tiny = std::numeric_limits<double>::denorm_min();
  const Mesh speck = made(cube(tiny));
  EXPECT_EQ(volume(speck), 0);  // 2^-3222
  EXPECT_EQ(convexity_error(speck), std::nullopt);
  MeshData needle = cube();
  for (Point3& p : needle.vertices) p = {p.x * tiny, p.y * kMax, p.z};
  EXPECT_EQ(volume(made(needle)), tiny * kMax);
  EXPECT_EQ(convexity_error(made(needle)), std::nullopt);
}

TEST(Mesh, NegatingTwiceIsNothingAndKeepsTheVolume) {
  for (const solids::NamedMesh& model : solids::thesis_models()) {
    const Mesh reflected = negated(model.mesh);
    EXPECT_TRUE(Mesh::create(reflected.data()).ok()) << model.name;
    EXPECT_EQ(negated(reflected).data(), model.mesh.data()) << model.name;
    EXPECT_EQ(volume(reflected), volume(model.mesh)) << model.name;
  }
}

TEST(Mesh, TranslatingAndScaling) {
  const Mesh mesh = made(l_prism());
  const Result<Mesh> moved = translated(mesh, 1, 2, 3);
  ASSERT_TRUE(moved.ok());
  EXPECT_EQ(volume(*moved), 3);
  EXPECT_EQ(bounds(*moved), (std::array<double, 6>{1, 2, 3, 3, 4, 4}));
  EXPECT_EQ(*translated(*moved, -1, -2, -3), mesh);
  for (const double sx : {-2.0, 0.5}) {
    for (const double sy : {-1.0, 4.0}) {
      for (const double sz : {-8.0, 1.0}) {
        const Result<Mesh> sized = scaled(mesh, sx, sy, sz);
        ASSERT_TRUE(sized.ok()) << sized.error().to_string();
        EXPECT_EQ(volume(*sized), 3 * std::abs(sx * sy * sz));
        EXPECT_EQ(*scaled(*sized, 1 / sx, 1 / sy, 1 / sz), mesh);
      }
    }
  }
  EXPECT_EQ(*scaled(mesh, -1, -1, -1), negated(mesh));
}

TEST(Mesh, ScalingByNothingAndMovingTooFarAreErrors) {
  const Mesh mesh = made(cube());
  for (const double bad : {0.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(name(scaled(mesh, 1, bad, 1).error().code), "unsupported_operand");
  }
  EXPECT_EQ(name(translated(mesh, 0x1p60, 0, 0).error().code), "repeated_vertex");
  EXPECT_EQ(name(translated(mesh, std::nan(""), 0, 0).error().code), "not_finite");
}

}  // namespace
}  // namespace dymsum::spatial_test
