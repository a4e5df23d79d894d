// Solids far from the origin, beside it: every difference is exact, and nothing else changes.
#include "spatial/motion/beside_origin.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "exact/big.h"
#include "oracles/coordinate_kinds.h"
#include "spatial/moving/moving_cases.h"

namespace dymsum {
namespace {

using spatial::beside_origin;
using spatial::offset_from_origin;

std::array<double, 3> coordinates(Point3 p) { return {p.x, p.y, p.z}; }

/// That coordinates are the given ones less `direction`, exactly.
void check_moved(const std::string& name, const Mesh& given, const Mesh& moved, Point3 direction) {
  ASSERT_EQ(given.faces(), moved.faces()) << name;
  ASSERT_EQ(given.vertices().size(), moved.vertices().size()) << name;
  for (std::size_t v = 0; v < given.vertices().size(); ++v)
    for (std::size_t axis = 0; axis < 3; ++axis)
      ASSERT_EQ(exact::exact_value(coordinates(moved.vertices()[v])[axis]),
                exact::BigRational(exact::exact_value(coordinates(given.vertices()[v])[axis]) -
                                   exact::exact_value(coordinates(direction)[axis])))
          << name << ": vertex " << v << ", axis " << axis;
}

TEST(BesideOrigin, DifferencesAreExactInAllKindsOfCoordinates) {
  std::mt19937_64 random(12);
  std::size_t moved = 0, left = 0;
  for (const CoordinateKind kind : kCoordinateKinds)
    for (int k = 0; k < 200; ++k) {
      MeshData data = of_kind(random_solids::tiny_polyhedron(random), kind, random);
      // From much less to much more than its size, on either side, along every axis.
      std::array<double, 3> by{};
      for (double& b : by) b = std::ldexp((random() % 2 == 0 ? -1.0 : 1.0) / 3, static_cast<int>(random() % 24) - 4);
      for (Point3& v : data.vertices) v = {v.x + by[0], v.y + by[1], v.z + by[2]};
      const Result<Mesh> mesh = Mesh::create(data);
      if (!mesh.ok() || mesh->has_thin_parts()) continue;  // what rounding made of it
      const Point3 direction = offset_from_origin(*mesh);
      const std::optional<Mesh> near = beside_origin(*mesh);
      ASSERT_EQ(near.has_value(), !(direction == Point3{}));
      ++(near ? moved : left);
      if (!near) continue;
      check_moved(name_of(kind), *mesh, *near, direction);
      EXPECT_TRUE(Mesh::create(near->data()).ok());
      EXPECT_FALSE(beside_origin(*near).has_value()) << "moved twice";
    }
  EXPECT_GT(moved, 200u);
  EXPECT_GT(left, 10u);
}

TEST(BesideOrigin, TakesAxesAloneAndTheEndThatIsNearer) {
  const auto box_at = [](double x, double y, double z, double size) {
    return Mesh::create(MeshData{{{x, y, z}, {x + size, y, z}, {x, y + size, z}, {x, y, z + size}},
                                 {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}})
        .value();
  };
  EXPECT_EQ(offset_from_origin(box_at(1, -2, 0.75, 1)), (Point3{1, -1, 0}));
  EXPECT_EQ(offset_from_origin(box_at(-0.5, 0, -1.75, 1)), (Point3{0, 0, 0}));
  EXPECT_EQ(offset_from_origin(Mesh()), (Point3{}));
  const double least = std::numeric_limits<double>::denorm_min(), most = std::ldexp(1.0, 1000);
  EXPECT_EQ(offset_from_origin(box_at(64 * least, 0, 0, least)), (Point3{64 * least, 0, 0}));
  const Mesh huge = box_at(most, -2 * most, 0, most);
  check_moved("huge", huge, beside_origin(huge).value(), offset_from_origin(huge));
}

}  // namespace
}  // namespace dymsum
