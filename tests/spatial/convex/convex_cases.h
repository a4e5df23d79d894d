// Convex solids for tests, and ways to look at sums.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <compare>
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

/// The sum at a pair of poses, from nothing.
inline Result<SpatialSum> convex_sum(const Mesh& p, const Mesh& q, const SolidPose& p_pose = {},
                                     const SolidPose& q_pose = {}, ConvexEngine engine = ConvexEngine::walk) {
  Result<ConvexSum> made = ConvexSum::create(p, q);
  if (!made) return made.error();
  ConvexSum sum = *std::move(made);
  sum.rebuild(p_pose, q_pose, engine);
  return sum.sum();
}

/// Equal, and with the same doubles, features and contacts throughout.
inline bool identical(const SpatialSum& a, const SpatialSum& b) {
  const auto same_face = [](const SpatialFace& f, const SpatialFace& g) { return f.p == g.p && f.q == g.q; };
  const auto same_edge = [](const SpatialEdge& e, const SpatialEdge& f) {
    return e.from == f.from && e.to == f.to && e.faces == f.faces && e.contact == f.contact;
  };
  const std::vector<SpatialEdge> a_edges = a.edges(), b_edges = b.edges();
  return a == b && a.vertices == b.vertices && a.at_error == b.at_error && a.vertex_contacts == b.vertex_contacts &&
         std::equal(a.faces.begin(), a.faces.end(), b.faces.begin(), b.faces.end(), same_face) &&
         std::equal(a_edges.begin(), a_edges.end(), b_edges.begin(), b_edges.end(), same_edge);
}

/// The vertices of a convex sum as pairs.
inline std::vector<ConvexSum::Vertex> vertex_pairs(const SpatialSum& sum) {
  std::vector<ConvexSum::Vertex> pairs;
  for (const std::optional<SolidContact>& c : sum.vertex_contacts) pairs.push_back({c->p.a, c->q.a});
  return pairs;
}

/// A convex sum as a mesh with whole faces; of one whose positions are doubles.
inline Mesh whole_mesh(const SpatialSum& sum) {
  MeshData data{sum.vertices, {}};
  for (const SpatialFace& f : sum.faces) data.faces.push_back(f.loops[0]);
  return *Mesh::create(std::move(data));
}

/// A face by what touches there and the pairs of vertices round it, from the smallest on.
struct NamedFace {
  SolidContact features;
  std::vector<ConvexSum::Vertex> corners;
  friend auto operator<=>(const NamedFace&, const NamedFace&) = default;
};
/// All that does not depend on positions: the faces, sorted.
inline std::vector<NamedFace> structure(const SpatialSum& sum) {
  const std::vector<ConvexSum::Vertex> pairs = vertex_pairs(sum);
  std::vector<NamedFace> faces;
  for (const SpatialFace& f : sum.faces) {
    NamedFace& face = faces.emplace_back(NamedFace{{f.p, f.q}, {}});
    for (const std::uint32_t v : f.loops[0]) face.corners.push_back(pairs[v]);
    std::rotate(face.corners.begin(), std::min_element(face.corners.begin(), face.corners.end()), face.corners.end());
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

/// Every edge has two facets that run through it in opposite directions, and Euler's formula holds.
inline void expect_closed(const SpatialSum& sum) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> directed;
  std::size_t count = 0;
  for (const SpatialFace& f : sum.faces) {
    ASSERT_EQ(f.loops.size(), 1u);
    const std::vector<std::uint32_t>& loop = f.loops[0];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      directed.insert({loop[i], loop[(i + 1) % loop.size()]});
      ++count;
    }
  }
  EXPECT_EQ(directed.size(), count);
  for (const auto& [a, b] : directed) EXPECT_TRUE(directed.contains({b, a}));
  const std::size_t edges = sum.edges().size();
  EXPECT_EQ(sum.vertices.size() + sum.faces.size(), edges + 2);
  EXPECT_EQ(2 * edges, count);
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
