// Closed sums of operands that both have parts without volume: all of the set, by lattice cells, and extruded from the
// plane.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "dymsum/planar_operand.h"
#include "dymsum/region.h"
#include "dymsum/spatial_operand.h"
#include "oracles/sanitized.h"
#include "oracles/voxel_solids.h"
#include "spatial/sum/solid_cases.h"
#include "spatial/sum/tested_sums.h"

namespace dymsum {
namespace {

using oracles::LatticeCells;
using oracles::Voxel;

double length_of_segments(const SpatialSum& s) {
  double total = 0;
  for (const auto& segment : s.tight_segments) total += length(s, segment);
  return total;
}

/// Some cells of each dimension that is drawn, in a small box, so that much coincides.
LatticeCells random_cells(std::mt19937_64& random, int cubes, int thin) {
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<std::uint64_t>(n)); };
  LatticeCells cells;
  while (static_cast<int>(cells.size()) < cubes) cells.insert({2 * below(2) + 1, 2 * below(2) + 1, 2 * below(2) + 1});
  const int most = below(3);  // the largest dimension
  for (int k = 0; k < thin; ++k) {
    Voxel c{below(6), below(6), below(4)};
    while (c[0] % 2 + c[1] % 2 + c[2] % 2 > most) c = {below(6), below(6), below(4)};
    cells.insert(c);
  }
  return cells;
}

const Mesh kOrigin = Mesh::with_thin_parts({{{0, 0, 0}}, {{0}}}).value();

/// Whether a result, taken as an operand, holds the centres of the same cells as the closed sum.
void expect_same_cells(const SpatialSum& made, const LatticeCells& a, const LatticeCells& b, const std::string& seed) {
  std::vector<RationalPoint3> centres;
  std::vector<bool> expected;
  for (int x = -1; x <= 13; ++x)
    for (int y = -1; y <= 13; ++y)
      for (int z = -1; z <= 9; ++z) {
        centres.push_back({*Rational::of(x, 2), *Rational::of(y, 2), *Rational::of(z, 2)});
        expected.push_back(oracles::closed_sum_holds(a, b, {x, y, z}));
      }
  EXPECT_EQ(contains_each(made, kOrigin, centres).value(), expected) << seed;
}

TEST(ClosedSums, of_lattice_cells_are_all_of_the_set) {
  int points = 0, segments = 0, faces = 0, empty_inside = 0;
  for (int k = 0; k < fuzz_pairs(oracles::rounds(48, 6)); ++k) {
    std::mt19937_64 random(static_cast<std::uint64_t>(k));
    const LatticeCells a = random_cells(random, k % 3, 1 + k % 4), b = random_cells(random, k % 4 == 0, 1 + k % 3);
    const Result<Mesh> p = Mesh::with_thin_parts(oracles::lattice_mesh(a)),
                       q = Mesh::with_thin_parts(oracles::lattice_mesh(b));
    if (!p || !q || !p->has_thin_parts() || !q->has_thin_parts()) continue;
    const std::string seed = "seed " + std::to_string(k);
    const oracles::VoxelSum expected = oracles::closed_lattice_sum(a, b);
    const Result<SpatialSum> made = minkowski_sum(*p, *q);
    ASSERT_TRUE(made.ok()) << seed << ": " << made.error().to_string();
    EXPECT_EQ(made->volume_exact(), static_cast<std::int64_t>(expected.volume)) << seed;
    EXPECT_EQ(tight_area(*made), static_cast<double>(expected.tight_faces)) << seed;
    EXPECT_EQ(length_of_segments(*made), static_cast<double>(expected.tight_edges)) << seed;
    EXPECT_EQ(made->tight_points.size(), expected.tight_points) << seed;
    EXPECT_EQ(made->tight_segments.size(), made->tight_segment_contacts.size()) << seed;
    for (const auto& contacts : made->tight_segment_contacts) EXPECT_FALSE(contacts.empty()) << seed;
    for (const auto& contacts : made->tight_point_contacts) EXPECT_FALSE(contacts.empty()) << seed;
    EXPECT_EQ(*made, minkowski_sum(*q, *p).value()) << seed;
    if (k % 3 == 0) {
      EXPECT_EQ(*made, sum(*p, *q, SpatialEngine::brute)) << seed;
    }
    if (k % 4 == 0) expect_same_cells(*made, a, b, seed);
    points += expected.tight_points > 0, segments += expected.tight_edges > 0, faces += expected.tight_faces > 0;
    empty_inside += expected.volume == 0;
  }
  EXPECT_GT(points, oracles::rounds(5, 1));
  EXPECT_GT(segments, oracles::rounds(5, 1));
  EXPECT_GT(faces, oracles::rounds(5, 1));
  EXPECT_GT(empty_inside, oracles::rounds(5, 1));
}

TEST(ClosedSums, move_with_a_shear) {
  const oracles::IntegerMap shear{{{1, 2, -1}, {0, 1, 1}, {0, 0, 1}}};
  int checked = 0;
  for (int k = 0; k < fuzz_pairs(oracles::rounds(20, 3)); ++k) {
    std::mt19937_64 random(static_cast<std::uint64_t>(300 + k));
    const LatticeCells a = random_cells(random, k % 2, 1 + k % 4), b = random_cells(random, 0, 1 + k % 3);
    const auto of = [&](const LatticeCells& cells, const oracles::IntegerMap& map) {
      return Mesh::with_thin_parts(oracles::lattice_mesh(cells, map));
    };
    const Result<Mesh> p = of(a, shear), q = of(b, shear);
    if (!p || !q || !p->has_thin_parts()) continue;
    const std::string seed = "seed " + std::to_string(300 + k);
    const SpatialSum made = minkowski_sum(*p, *q).value();
    const SpatialSum straight =
        minkowski_sum(of(a, oracles::kNoShear).value(), of(b, oracles::kNoShear).value()).value();
    EXPECT_EQ(made.volume_exact(), straight.volume_exact()) << seed;
    EXPECT_EQ(made.tight_points.size(), straight.tight_points.size()) << seed;
    EXPECT_EQ(made.tight_segments.size(), straight.tight_segments.size()) << seed;
    EXPECT_EQ(made.tight_faces.size(), straight.tight_faces.size()) << seed;
    ++checked;
  }
  EXPECT_GT(checked, oracles::rounds(10, 3));
}

/// A planar set at z = 0, or up to z = 1: points, segments and plates become segments, plates and solids.
Mesh extruded(const Region& region, bool up) {
  MeshData data;
  const auto vertex = [&](Point p, double z) {
    const Point3 at{p.x, p.y, z};
    const auto found = std::find(data.vertices.begin(), data.vertices.end(), at);
    if (found != data.vertices.end()) return static_cast<std::uint32_t>(found - data.vertices.begin());
    data.vertices.push_back(at);
    return static_cast<std::uint32_t>(data.vertices.size() - 1);
  };
  for (const Point& p : region.points())
    data.faces.push_back(up ? Face{vertex(p, 0), vertex(p, 1)} : Face{vertex(p, 0)});
  for (const Polyline& line : region.polylines())
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const Point a = line[k], b = line[k + 1];
      data.faces.push_back(up ? Face{vertex(a, 0), vertex(b, 0), vertex(b, 1), vertex(a, 1)}
                              : Face{vertex(a, 0), vertex(b, 0)});
    }
  return Mesh::with_thin_parts(std::move(data)).value();
}

TEST(ClosedSums, of_extruded_sets_are_those_of_the_plane_extruded) {
  int pieces = 0;
  for (int k = 0; k < oracles::rounds(30, 4); ++k) {
    std::mt19937_64 random(static_cast<std::uint64_t>(700 + k));
    const auto below = [&](int n) { return static_cast<double>(random() % static_cast<std::uint64_t>(n)); };
    const auto lines = [&] {
      RegionData data;
      for (int j = 0; j < 1 + k % 2; ++j) {
        const Point a{below(5), below(5)};
        Point b{below(5), below(5)};
        while (b == a) b = {below(5), below(5)};
        data.polylines.push_back({a, b});
      }
      for (int j = 0; j < k % 3; ++j) data.points.push_back({below(9), below(9)});
      return Region::create(std::move(data)).value();
    };
    const Region p = lines(), q = lines();
    const PlanarSum planar = minkowski_sum(p, q).value();
    const SpatialSum spatial = minkowski_sum(extruded(p, true), extruded(q, false)).value();
    const std::string seed = "seed " + std::to_string(700 + k);
    EXPECT_EQ(spatial.volume_exact(), planar.area_exact()) << seed;
    EXPECT_EQ(spatial.tight_segments.size(), planar.points.size()) << seed;
    EXPECT_TRUE(spatial.tight_points.empty()) << seed;
    double length_in_plane = 0;
    for (const SumSegment& s : planar.segments)
      length_in_plane += std::hypot(s.to.at.x - s.from.at.x, s.to.at.y - s.from.at.y);
    EXPECT_NEAR(tight_area(spatial), length_in_plane, 1e-12 * (1 + length_in_plane)) << seed;
    pieces += !planar.segments.empty() || !planar.points.empty();
  }
  EXPECT_GT(pieces, oracles::rounds(5, 2));
}

TEST(ClosedSums, of_several_sets_without_volume_do_not_depend_on_their_order) {
  const Mesh along = Mesh::with_thin_parts({{{0, 0, 0}, {1, 0, 0}}, {{0, 1}}}).value(),
             across = Mesh::with_thin_parts({{{0, 0, 0}, {0, 1, 0}, {5, 5, 5}}, {{0, 1}, {2}}}).value(),
             up = Mesh::with_thin_parts({{{0, 0, 0}, {0, 0, 1}}, {{0, 1}}}).value();
  const SpatialSum all = minkowski_sum(std::vector<Mesh>{along, across, up}).value();
  EXPECT_EQ(all.volume_exact(), 1);
  EXPECT_EQ(tight_area(all), 1) << "along and up from the point";
  EXPECT_EQ(minkowski_sum(std::vector<Mesh>{up, along, across}).value(), all);
  EXPECT_EQ(minkowski_sum(std::vector<Mesh>{across, up, along}).value(), all);
  EXPECT_EQ(minkowski_sum(minkowski_sum(along, across).value(), up).value(), all);
  EXPECT_EQ(minkowski_sum(along, minkowski_sum(across, up).value()).value(), all);
}

TEST(ClosedSums, of_points_and_segments_alone) {
  const Mesh point = Mesh::with_thin_parts({{{1, 2, 3}, {4, 4, 4}}, {{0}, {1}}}).value(),
             rod = Mesh::with_thin_parts({{{0, 0, 0}, {2, 0, 0}}, {{0, 1}}}).value(),
             back = Mesh::with_thin_parts({{{3, 0, 0}, {0, 0, 0}}, {{0, 1}}}).value();
  EXPECT_EQ(minkowski_sum(point, point).value().tight_points.size(), 3u);
  EXPECT_EQ(minkowski_sum(point, rod).value().tight_segments.size(), 2u);
  const SpatialSum longer = minkowski_sum(rod, back).value();
  ASSERT_EQ(longer.tight_segments.size(), 1u);
  EXPECT_EQ(length(longer, longer.tight_segments[0]), 5);
  EXPECT_TRUE(longer.faces.empty() && longer.tight_points.empty());
  SpatialOptions regular;
  regular.semantics = Semantics::regular;
  EXPECT_EQ(minkowski_sum(rod, back, regular).error().code, ErrorCode::unsupported_operand);
}

}  // namespace
}  // namespace dymsum
