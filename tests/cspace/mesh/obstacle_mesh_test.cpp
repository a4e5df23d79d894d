// The triangles of a configuration-space obstacle: closed for every pair, on the surface, and of its volume.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <random>
#include <stdexcept>
#include <string>

#include "dymsum/dymsum.h"
#include "oracles/snapped_shapes.h"

namespace dymsum {
namespace {

const double kPi = std::acos(-1.0);

struct Pair {
  std::string name;
  Region robot, obstacle;
};

Region region(std::vector<Part> parts) {
  RegionData data;
  data.parts = std::move(parts);
  return *Region::create(std::move(data));
}

std::vector<Pair> pairs() {
  const Region two_squares = region({{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, {}}, {{{2, 2}, {5, 2}, {5, 5}, {2, 5}}, {}}});
  const Region hole_at_an_edge = region({{{{0, 0}, {8, 0}, {8, 8}, {0, 8}}, {{{4, 0}, {1, 4}, {4, 7}, {6, 4}}}}});
  const Region triangle = region({{{{0, 0}, {1, 0.25}, {0.25, 0.5}}, {}}});
  return {
      {"squares", shapes::rectangle(0, 0, 1, 1), shapes::rectangle(0, 0, 2, 3)},
      {"the same twice", shapes::rectangle(0, 0, 1, 1), shapes::rectangle(0, 0, 1, 1)},
      {"discs", snapped_shapes::disc(12, 1), snapped_shapes::disc(16, 2)},
      {"exactly fitting", shapes::rectangle(0, 0, 2, 1), shapes::letter_u(4, 4, 1)},
      {"letters", shapes::letter_l(2, 1.5, 0.5), shapes::letter_u(4, 4, 1)},
      {"cavities", snapped_shapes::star(5, 0.5, 1), shapes::grate(3, 4, 1, 6)},
      {"cavities that open and close", shapes::rectangle(-1.5, -0.2, 1.5, 0.2), shapes::grate(4, 2, 1, 6)},
      {"free positions", shapes::noisy_star(10, 0.5, 3), shapes::noisy_star(14, 0.6, 4)},
      {"touching squares", triangle, two_squares},
      {"a robot of touching squares", two_squares, triangle},
      {"a hole that touches an edge", triangle, hole_at_an_edge},
  };
}

ObstacleMesh mesh_of(const CspaceObstacle& obstacle, double tolerance = 1e-3) {
  return obstacle_mesh(obstacle, {tolerance, {}}).value();
}

CspaceObstacle obstacle_of(const Pair& pair) { return CspaceObstacle::create(pair.robot, pair.obstacle).value(); }

void expect_closed(const ObstacleMesh& mesh) {
  const MeshClosure found = closure(mesh);
  EXPECT_EQ(found.open, 0u);
  EXPECT_EQ(found.crowded, 0u);
  EXPECT_TRUE(found.watertight());
  EXPECT_EQ(2 * found.edges, 3 * mesh.triangles.size());
  EXPECT_LE(found.closing_area, 1e-12 * mesh.extent * mesh.extent) << "triangles in the planes of events have area";
}

/// Every edge twice, without the help of closure(): but for the end planes, where top and bottom are the same.
void expect_edges_twice(const ObstacleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const ObstacleTriangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++uses[{t.vertices[k], t.vertices[(k + 1) % 3]}];
  std::map<std::uint32_t, std::uint32_t> top;
  for (const auto& [bottom, above] : mesh.seam) {
    const Configuration &a = mesh.vertices[bottom], &b = mesh.vertices[above];
    EXPECT_TRUE(a.x == b.x && a.y == b.y && a.theta == -b.theta && b.theta == kPi);
    top[bottom] = above;
  }
  for (const auto& [edge, count] : uses) {
    ASSERT_EQ(count, 1);
    if (uses.contains({edge.second, edge.first})) continue;
    const double height = mesh.vertices[edge.first].theta;
    ASSERT_TRUE(std::abs(height) == kPi && mesh.vertices[edge.second].theta == height) << "an open edge";
    if (height < 0) {
      ASSERT_TRUE(uses.contains({top.at(edge.second), top.at(edge.first)}));
      ASSERT_FALSE(uses.contains({top.at(edge.first), top.at(edge.second)}));
    }
  }
}

/// The distance of a point from the line through the ends of a patch at the point's angle.
double distance(const CspaceObstacle& obstacle, const Patch& patch, Point at, double theta) {
  const auto [a, b] = obstacle.ends(patch, theta);
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  if (length < 1e-9) return 0;  // no line to speak of
  return std::abs((b.x - a.x) * (at.y - a.y) - (b.y - a.y) * (at.x - a.x)) / length;
}

TEST(ObstacleMesh, IsClosedForEveryPair) {
  for (const Pair& pair : pairs()) {
    SCOPED_TRACE(pair.name);
    const ObstacleMesh mesh = mesh_of(obstacle_of(pair));
    EXPECT_FALSE(mesh.triangles.empty());
    EXPECT_FALSE(mesh.seam.empty());
    expect_closed(mesh);
    expect_edges_twice(mesh);
  }
}

TEST(ObstacleMesh, VolumeIsTheIntegralOfTheSlices) {
  for (const Pair& pair : pairs()) {
    SCOPED_TRACE(pair.name);
    const CspaceObstacle obstacle = obstacle_of(pair);
    constexpr int kSlices = 720;
    double integral = 0;
    for (int k = 0; k < kSlices; ++k) {
      const double theta = 2 * kPi * (k + 0.5) / kSlices - kPi;
      integral += obstacle.slice(Orientation::nearest(theta, 1e-7).value())->area() * 2 * kPi / kSlices;
    }
    const double coarse = enclosed_volume(mesh_of(obstacle, 1e-3)), fine = enclosed_volume(mesh_of(obstacle, 1e-4));
    EXPECT_NEAR(coarse, integral, 3e-3 * integral);
    EXPECT_NEAR(fine, integral, 3e-4 * integral);
    EXPECT_LT(std::abs(fine - integral), std::abs(coarse - integral));
  }
}

TEST(ObstacleMesh, TrianglesStayWithinTheToleranceOfTheSurface) {
  for (const Pair& pair : pairs()) {
    SCOPED_TRACE(pair.name);
    const CspaceObstacle obstacle = obstacle_of(pair);
    for (const double tolerance : {1e-2, 1e-3}) {
      const ObstacleMesh mesh = mesh_of(obstacle, tolerance);
      double worst = 0;
      for (const ObstacleTriangle& t : mesh.triangles) {
        if (t.closing) continue;
        for (std::size_t k = 0; k < 3; ++k) {
          const Configuration &a = mesh.vertices[t.vertices[k]], &b = mesh.vertices[t.vertices[(k + 1) % 3]];
          for (const double fraction : {0.25, 0.5, 0.75}) {
            const Point at{a.x + fraction * (b.x - a.x), a.y + fraction * (b.y - a.y)};
            const double theta = a.theta + fraction * (b.theta - a.theta);
            worst = std::max(worst, distance(obstacle, obstacle.patches()[t.patch], at, theta));
          }
        }
      }
      EXPECT_LE(worst, mesh.tolerance * 1.01);
      EXPECT_GT(worst, mesh.tolerance / 20) << "finer than asked for: twenty times too many triangles";
    }
  }
}

TEST(ObstacleMesh, IsClosedForTinyGridsWhereEventsCoincide) {
  const char* first = std::getenv("DYMSUM_SEED");
  const std::uint64_t begin = first ? std::stoull(first) : 1;
  std::uint64_t made = 0;
  for (std::uint64_t seed = begin; seed < begin + 150; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    const auto polygon = [&] {
      for (;;) {
        RegionData data;
        data.parts.emplace_back();
        for (std::uint64_t k = 3 + random() % 5; k > 0; --k)
          data.parts[0].outer.push_back({static_cast<double>(random() % 5), static_cast<double>(random() % 5)});
        Result<Repaired> repaired = repair(data);
        if (repaired && repaired->region.parts().size() == 1) return repaired->region;  // perhaps with touching rings
      }
    };
    const Region robot = polygon(), obstacle = polygon();
    const Result<CspaceObstacle> made_obstacle = CspaceObstacle::create(robot, obstacle);
    ASSERT_TRUE(made_obstacle.ok()) << made_obstacle.error().message;
    ++made;
    expect_closed(mesh_of(*made_obstacle, 1e-2));
    if (HasFailure()) return;
  }
  EXPECT_EQ(made, 150u);
}

TEST(ObstacleMesh, ClosureTellsWhatIsOpenOrCrowded) {
  const CspaceObstacle obstacle = obstacle_of(pairs()[0]);
  const ObstacleMesh whole = mesh_of(obstacle);
  ObstacleMesh hole = whole, twice = whole, split = whole;
  hole.triangles.erase(hole.triangles.begin() + 7);
  EXPECT_EQ(closure(hole).open, 3u);
  EXPECT_FALSE(closure(hole).watertight());
  twice.triangles.insert(twice.triangles.end(), whole.triangles.begin(), whole.triangles.end());
  EXPECT_EQ(closure(twice).open, 0u);
  EXPECT_EQ(closure(twice).crowded, closure(whole).edges);
  EXPECT_FALSE(closure(twice).watertight());
  split.seam.clear();
  EXPECT_GT(closure(split).open, 0u) << "the planes are two without the seam";
}

TEST(ObstacleMesh, SameInputSameMesh) {
  const Pair pair = pairs()[5];
  const ObstacleMesh a = mesh_of(obstacle_of(pair)), b = mesh_of(obstacle_of(pair));
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.seam, b.seam);
}

TEST(ObstacleMesh, CapsCloseTheSurfaceInSpaceWithTheSliceAtHalfATurn) {
  std::vector<Pair> all = pairs();
  all.push_back({"many holes", snapped_shapes::disc(8, 0.25), shapes::grate(5, 2, 1, 6)});
  all.push_back({"a star in a star's holes", snapped_shapes::star(5, 0.5, 1), shapes::grate(4, 3, 1, 9)});
  for (const Pair& pair : all) {
    SCOPED_TRACE(pair.name);
    const CspaceObstacle obstacle = obstacle_of(pair);
    const ObstacleMesh mesh = mesh_of(obstacle, 1e-2);
    // As programs read it: triangles in a file.
    const MeshData data = capped_mesh_data(mesh);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
    for (const Face& face : data.faces)
      for (std::size_t k = 0; k < face.size(); ++k) ++uses[{face[k], face[(k + 1) % face.size()]}];
    for (const auto& [edge, n] : uses) {
      ASSERT_EQ(n, 1);
      ASSERT_TRUE(uses.contains({edge.second, edge.first})) << "an edge is open";
    }
    double top = 0, bottom = 0;
    for (std::size_t f = mesh.triangles.size(); f < data.faces.size(); ++f) {
      const Face& face = data.faces[f];
      double area = 0;
      for (std::size_t k = 0; k < face.size(); ++k) {
        const Point3 &a = data.vertices[face[k]], &b = data.vertices[face[(k + 1) % face.size()]];
        area += (a.x * b.y - a.y * b.x) / 2;
      }
      (data.vertices[face[0]].z > 0 ? top : bottom) += area;
    }
    const double area = obstacle.slice(Orientation::half_turn())->area();
    EXPECT_NEAR(top, area, 1e-9 * area);
    EXPECT_NEAR(bottom, -area, 1e-9 * area);
  }
}

TEST(ObstacleMesh, HeightOfTheTurnIsTheExtent) {
  const CspaceObstacle obstacle = obstacle_of(pairs()[0]);
  const ObstacleMesh mesh = mesh_of(obstacle);
  EXPECT_DOUBLE_EQ(mesh.extent, 3 + 2 * std::sqrt(2.0));
  const MeshData data = mesh_data(mesh);
  EXPECT_EQ(data.faces.size(), mesh.triangles.size());
  double low = 0, high = 0;
  for (const Point3& p : data.vertices) low = std::min(low, p.z), high = std::max(high, p.z);
  EXPECT_DOUBLE_EQ(high - low, mesh.extent);
}

TEST(ObstacleMesh, BadTolerancesAndCancelling) {
  const CspaceObstacle obstacle = obstacle_of(pairs()[0]);
  for (const double tolerance : {0.0, -1.0, 1e-7, 2.0, std::nan("")})
    EXPECT_EQ(obstacle_mesh(obstacle, {tolerance, {}}).error().code, ErrorCode::out_of_range) << tolerance;
  int queried = 0;
  const auto stop = [&](std::string_view, double) { return ++queried < 2; };
  const Result<ObstacleMesh> cancelled = obstacle_mesh(obstacle, {1e-3, stop});
  ASSERT_FALSE(cancelled.ok());
  EXPECT_EQ(cancelled.error().code, ErrorCode::cancelled);
}

TEST(RotatedSum, IsTheSumWithTheTurnedRegion) {
  const Region p = shapes::letter_l(3, 2, 1), q = shapes::rectangle(0, 0, 1, 2);
  EXPECT_EQ(*rotated_sum(p, q, Orientation{}), *minkowski_sum(p, q));
  EXPECT_EQ(*rotated_sum(p, q, Orientation::half_turn()), *minkowski_sum(negated(p), q));
  const Orientation theta = Orientation::of(1, 3).value();
  // Turning both operands turns the sum: P turned plus Q is P plus Q turned back, turned.
  EXPECT_EQ(rotated_sum(p, q, theta)->area_exact(), rotated_sum(q, p, theta.inverse())->area_exact());
  // A slice is the obstacle with the reflected robot.
  EXPECT_EQ(*rotated_sum(negated(p), q, theta), *cspace_slice(p, q, theta));
  EXPECT_EQ(rotated_sum(p, Region(), theta)->parts.size(), 0u);
}

}  // namespace
}  // namespace dymsum
