// Nearest positions of a sum's boundary where doubles leave out what is further: those of all faces in exact
// arithmetic.
#include "depth/boundary_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <random>

#include "dymsum/solids.h"
#include "oracles/coordinate_kinds.h"
#include "spatial/moving/moving_cases.h"

namespace dymsum {
namespace {

using depth::RationalVector;

std::vector<RationalVector> sorted(std::vector<RationalVector> all) {
  std::sort(all.begin(), all.end());
  return all;
}

std::size_t facet_edges_of(const SpatialSum& sum) {
  std::size_t count = 0;
  for (const SpatialFace& face : sum.faces)
    for (const auto& loop : face.loops) count += loop.size();
  return count;
}

TEST(BoundaryDistance, DoublesLeaveOutWhatIsFurther) {
  std::mt19937_64 random(15);
  for (const CoordinateKind kind : kCoordinateKinds) {
    std::size_t all = 0, exactly = 0;
    for (int round = 0; round < 2; ++round) {
      const Mesh p = moving_cases::mesh_of(
                     of_kind(round < 1 ? moving_cases::torus(2, 0.75, 5, 4) : moving_cases::bumpy(1, 3), kind, random)),
                 q = moving_cases::mesh_of(of_kind(
                     round == 0 ? moving_cases::torus(1, 0.375, 5, 4) : moving_cases::bumpy(1, round), kind, random));
      const SpatialSum sum = minkowski_sum(p, q).value();
      ASSERT_FALSE(sum.faces.empty());
      const auto [x_low, y_low, z_low, x_high, y_high, z_high] = [&] {
        std::array<double, 6> b{1e300, 1e300, 1e300, -1e300, -1e300, -1e300};
        for (const Point3& v : sum.vertices) {
          b = {std::min(b[0], v.x), std::min(b[1], v.y), std::min(b[2], v.z),
               std::max(b[3], v.x), std::max(b[4], v.y), std::max(b[5], v.z)};
        }
        return b;
      }();
      const auto some = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random() % 9) / 8;
      };
      for (int k = 2; k < 6; ++k) {
        // Of a lattice, on which distances are often equal; a vertex; and far away.
        RationalVector from{exact::exact_value(some(x_low, x_high)), exact::exact_value(some(y_low, y_high)),
                            exact::exact_value(some(z_low, z_high))};
        if (k == 4) {
          const RationalPoint3 at = sum.exact(random() % sum.vertices.size());
          from = {exact::exact_value(at.x), exact::exact_value(at.y), exact::exact_value(at.z)};
        }
        if (k == 5) from[0] += 1000;
        const depth::NearestOnBoundary found = depth::nearest_by_doubles_first(sum, from);
        ASSERT_EQ(sorted(found.all), sorted(depth::nearest_on_boundary(sum, from))) << name_of(kind) << ", " << round;
        all += facet_edges_of(sum) + sum.faces.size(), exactly += found.faces + found.segments;
      }
    }
    std::cout << name_of(kind) << ": " << exactly << " of " << all << " exactly" << std::endl;
    EXPECT_LT(10 * exactly, all) << name_of(kind);
  }
}

TEST(BoundaryDistance, AllThatAreEquallyNear) {
  const Mesh cube = moving_cases::mesh_of(box(1));
  const SpatialSum sum = minkowski_sum(cube, cube).value();
  const RationalVector centre{0, 0, 0};
  const depth::NearestOnBoundary found = depth::nearest_by_doubles_first(sum, centre);
  EXPECT_EQ(found.all.size(), 6u);
  EXPECT_EQ(found.faces, 6u);
  EXPECT_EQ(sorted(found.all), sorted(depth::nearest_on_boundary(sum, centre)));
}

}  // namespace
}  // namespace dymsum
