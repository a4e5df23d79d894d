// Convex solids for tests, and ways to look at sums.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <numbers>
#include <random>
#include <set>
#include <vector>

#include "dymsum/convex_sum.h"
#include "dymsum/solids.h"

namespace dymsum::test {

/// The hull of random points of a small grid: many parallel faces and edges. Coordinates are multiples of `unit`.
inline Mesh random_grid_polytope(std::mt19937_64& random, int points, int size, double unit = 1) {
  for (;;) {
    std::vector<Point3> at;
    std::uniform_int_distribution<int> grid(0, size);
    for (int i = 0; i < points; ++i) at.push_back({unit * grid(random), unit * grid(random), unit * grid(random)});
    Result<Mesh> hull = convex_hull(at);
    if (hull) return std::move(hull).value();
  }
}

/// Points near a sphere, in general position.
inline Mesh random_round_polytope(std::mt19937_64& random, int points) {
  std::normal_distribution<double> normal;
  std::vector<Point3> at;
  for (int i = 0; i < points; ++i) {
    const double x = normal(random), y = normal(random), z = normal(random), r = std::sqrt(x * x + y * y + z * z);
    const auto snap = [](double v) { return std::nearbyint(v * 0x1p20) * 0x1p-20; };
    at.push_back({snap(x / r), snap(y / r), snap(z / r)});
  }
  return *convex_hull(at);
}

inline Rotation random_rotation(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return *Rotation::nearest(normal(random), normal(random), normal(random), normal(random));
}

/// About a random axis.
inline Rotation small_rotation(std::mt19937_64& random, double angle) {
  std::normal_distribution<double> normal;
  return *Rotation::about({normal(random), normal(random), normal(random)}, angle);
}

inline Scale random_scale(std::mt19937_64& random) {
  std::uniform_int_distribution<int> n(1, 40);
  return *Scale::of(*Rational::of(n(random), n(random)));
}

/// Two tips over a ring of vertices: as many edges leave a tip as there are sides.
inline Mesh spindle(int sides) {
  std::vector<Point3> at{{0, 0, 1.5}, {0, 0, -1.25}};
  for (int k = 0; k < sides; ++k) {
    const double angle = 2 * std::numbers::pi * k / sides;
    at.push_back({std::cos(angle), std::sin(angle), 0});
  }
  return *convex_hull(at);
}

/// A box with corners at any doubles.
inline Mesh free_box(Point3 low, Point3 high) {
  std::vector<Point3> at;
  for (int k = 0; k < 8; ++k) at.push_back({k & 1 ? high.x : low.x, k & 2 ? high.y : low.y, k & 4 ? high.z : low.z});
  return *convex_hull(at);
}

inline Mesh cube(double half) { return solids::box(-half, -half, -half, half, half, half); }

/// Every edge has two facets that run through it in opposite directions, and Euler's formula holds.
inline void expect_closed(const SolidSum& sum) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> directed;
  std::size_t count = 0;
  for (const SolidFacet& f : sum.facets)
    for (std::size_t i = 0; i < f.vertices.size(); ++i) {
      directed.insert({f.vertices[i], f.vertices[(i + 1) % f.vertices.size()]});
      ++count;
    }
  EXPECT_EQ(directed.size(), count);
  for (const auto& [a, b] : directed) EXPECT_TRUE(directed.contains({b, a}));
  EXPECT_EQ(sum.vertices.size() + sum.facets.size(), sum.edge_count() + 2);
}

/// The hull of all sums of vertices, whose coordinates have to be doubles: the sum by definition.
inline Mesh hull_of_sums(const Mesh& p, const Mesh& q) {
  std::vector<Point3> at;
  for (const Point3& a : p.vertices())
    for (const Point3& b : q.vertices()) at.push_back({a.x + b.x, a.y + b.y, a.z + b.z});
  return *convex_hull(at);
}

/// The vertices turned exactly. Requires that the results are doubles.
inline Mesh turned(const Mesh& mesh, const Rotation& r) {
  MeshData data = mesh.data();
  const std::array<std::int64_t, 9> m = r.matrix();
  const auto n = static_cast<double>(r.norm());
  for (Point3& v : data.vertices) {
    const Point3 x = v;
    const auto row = [&](int k) {
      return (double(m[3 * k]) * x.x + double(m[3 * k + 1]) * x.y + double(m[3 * k + 2]) * x.z) / n;
    };
    v = {row(0), row(1), row(2)};
  }
  return *Mesh::create(data);
}

}  // namespace dymsum::test
