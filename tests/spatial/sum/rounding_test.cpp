// The doubles of a triangulated sum are the nearest ones to its exact vertices.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "dymsum/spatial_sum.h"
#include "oracles/voxel_solids.h"
#include "spatial/sum/spatial_sum.h"

namespace dymsum {
namespace {

using Positions = std::vector<std::tuple<double, double, double>>;

Positions exactly_rounded(const SpatialSum& s) {
  std::vector<bool> used(s.vertices.size());
  for (const SpatialFace& face : s.faces)
    for (const auto& loop : face.loops)
      for (const std::uint32_t v : loop) used[v] = true;
  Positions positions;
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (!used[v]) continue;
    const RationalPoint3 at = s.exact(v);
    positions.emplace_back(at.x.to_double(), at.y.to_double(), at.z.to_double());
  }
  std::sort(positions.begin(), positions.end());
  return positions;
}

/// Sheared by a third, so that edges cross where no double is.
MeshData sheared(MeshData mesh, double turn, Point3 by, double scale) {
  for (Point3& p : mesh.vertices) {
    const Point3 q{p.x + std::ldexp(std::nearbyint(std::ldexp(turn * p.y, 20)), -20), p.y + 0.5 * p.z,
                   p.z - 0.25 * p.x};
    p = {scale * q.x + by.x, scale * q.y + by.y, scale * q.z + by.z};
  }
  return mesh;
}

TEST(Rounding, vertices_are_the_nearest_doubles_to_exact_ones) {
  const MeshData ell = oracles::voxel_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 1}});
  const auto snapped = [](double v) { return std::ldexp(std::nearbyint(std::ldexp(v, 20)), -20); };
  for (const double scale : {1.0, 0x1p-60, 0x1p60}) {
    for (const Point3 by : {Point3{0, 0, 0}, Point3{1e6, -7.25, 1e-3}, Point3{snapped(1e5 / 3), 1e9, -1e9}}) {
      const Point3 far{scale * snapped(by.x), scale * snapped(by.y), scale * snapped(by.z)};
      const SpatialSum s =
          spatial::sum_of_solids(sheared(ell, 1.0 / 3, far, scale), sheared(ell, -0.71, {}, scale), {}).value();
      const SpatialSum::Rounded rounded = s.rounded().value();
      Positions positions;
      for (const Point3& p : rounded.mesh.vertices) positions.emplace_back(p.x, p.y, p.z);
      std::sort(positions.begin(), positions.end());
      EXPECT_EQ(positions, exactly_rounded(s)) << "scale " << scale << ", far " << far.x;
      std::size_t between = 0;
      for (std::size_t v = 0; v < s.vertices.size(); ++v) {
        const Rational x = s.exact(v).x;
        between += Rational::of(x.to_double()).value() != x;
      }
      EXPECT_GT(between, 5u);
    }
  }
}

}  // namespace
}  // namespace dymsum
