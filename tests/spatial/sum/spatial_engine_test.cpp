// The engine of solid sums: what it leaves out, threads, predicted cost, memory, cancelling.
#include <gtest/gtest.h>
#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>
#include <set>
#include <tuple>

#include "dymsum/convex_memory.h"
#include "dymsum/solids.h"
#include "dymsum/spatial_sum.h"
#include "oracles/sanitized.h"
#include "oracles/voxel_solids.h"
#include "spatial/sum/random_solids.h"
#include "spatial/sum/spatial_sum.h"
#include "spatial/sum/tested_sums.h"

namespace dymsum {
namespace {

using random_solids::valid_polyhedron;
using spatial::sum_of_solids;

double snapped(double v) { return std::ldexp(std::nearbyint(std::ldexp(v, 12)), -12); }

Point3 turned(Point3 p, double a, double b) {
  const double y = std::cos(a) * p.y - std::sin(a) * p.z, z = std::sin(a) * p.y + std::cos(a) * p.z;
  return {snapped(std::cos(b) * p.x - std::sin(b) * y), snapped(std::sin(b) * p.x + std::cos(b) * y), snapped(z)};
}

MeshData torus(double large, double small, int nu, int nv, double turn) {
  MeshData m;
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) {
      const double u = 2 * std::numbers::pi * i / nu, w = 2 * std::numbers::pi * j / nv;
      const double r = large + small * std::cos(w);
      m.vertices.push_back(turned({r * std::cos(u), r * std::sin(u), small * std::sin(w)}, turn, 0.7 * turn));
    }
  const auto id = [&](int i, int j) { return static_cast<std::uint32_t>((i % nu) * nv + j % nv); };
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) {
      m.faces.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      m.faces.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  return m;
}

TEST(SpatialEngine, tests_of_all_places_find_nothing_more_in_tiny_polyhedra) {
  std::uint64_t left_out = 0;
  for (int k = 0; k < fuzz_pairs(40); ++k) {
    std::mt19937_64 random(static_cast<std::uint64_t>(k));
    const MeshData p = valid_polyhedron(random).data(), q = valid_polyhedron(random).data();
    const SpatialSum fast = sum(p, q), all = sum(p, q, SpatialEngine::brute);
    EXPECT_TRUE(fast == all) << "seed " << k;
    EXPECT_TRUE(fast == sum(q, p)) << "seed " << k;
    left_out += all.stats.tight_tests - fast.stats.tight_tests;
  }
  EXPECT_GT(left_out, 100u);
}

TEST(SpatialEngine, facets_deep_inside_are_dropped_and_nothing_else_changes) {
  const MeshData p = torus(2, 0.6, 16, 8, 0), q = torus(1.3, 0.35, 12, 6, 0.7);
  const SpatialSum fast = sum(p, q), all = sum(p, q, SpatialEngine::brute);
  EXPECT_GT(fast.stats.inner_facets, 30u);
  EXPECT_EQ(all.stats.inner_facets, 0u);
  EXPECT_LT(fast.stats.tight_tests, 100u) << "nearly all contacts are single points";
  EXPECT_GT(all.stats.tight_tests, 3000u);
  EXPECT_TRUE(fast == all);
}

TEST(SpatialEngine, facets_that_only_meet_at_corners_and_edges_have_no_contacts) {
  const Mesh p = solids::geodesic_sphere(3, 1, solids::kDemoSnap), q = solids::dipyramid(7, 2, 3, solids::kDemoSnap);
  for (const SpatialEngine engine : {SpatialEngine::fast, SpatialEngine::brute}) {
    const SpatialSum convex = sum(p.data(), q.data(), engine);
    EXPECT_GT(convex.stats.box_pairs, 1000u);
    EXPECT_EQ(convex.stats.contacts, 0u);
    EXPECT_TRUE(convex == *minkowski_sum(p, q));
  }
}

TEST(SpatialEngine, facets_deep_inside_unions_of_cubes_are_dropped) {
  oracles::Voxels p, q;
  for (int x = 0; x < 7; ++x)
    for (int y = 0; y < 7; ++y)
      for (int z = 0; z < 7; ++z)
        if (x != 3 || y != 3) p.insert({x, y, z});
  for (int x = 0; x < 5; ++x)
    for (int y = 0; y < 5; ++y)
      for (int z = 0; z < 5; ++z)
        if (z != 2 || x == 0) q.insert({x, y, z});
  // With flat vertices: there are small facets then.
  const auto operand = [](const oracles::Voxels& voxels) {
    return spatial::solid_operand(oracles::voxel_mesh(voxels), {}, spatial::FlatFeatures::kept);
  };
  const SpatialSum fast = spatial::sum_of_operands(operand(p), operand(q), {}).value();
  EXPECT_GT(fast.stats.inner_facets, 10u);
  EXPECT_EQ(fast.volume_exact(), static_cast<std::int64_t>(oracles::voxel_sum(p, q).volume));
}

void expect_same_to_the_last_bit(const SpatialSum& one, const SpatialSum& two) {
  EXPECT_TRUE(one == two);
  EXPECT_EQ(one.vertices, two.vertices);
  EXPECT_EQ(one.at_error, two.at_error);
  EXPECT_EQ(one.vertex_contacts, two.vertex_contacts);
  ASSERT_EQ(one.faces.size(), two.faces.size());
  for (std::size_t f = 0; f < one.faces.size(); ++f) {
    EXPECT_EQ(one.faces[f].p, two.faces[f].p);
    EXPECT_EQ(one.faces[f].q, two.faces[f].q);
    EXPECT_EQ(one.faces[f].shell, two.faces[f].shell);
  }
  const std::vector<SpatialEdge> edges = one.edges(), edges_of_two = two.edges();
  ASSERT_EQ(edges.size(), edges_of_two.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    EXPECT_EQ(edges[e].faces, edges_of_two[e].faces);
    EXPECT_EQ(edges[e].contact, edges_of_two[e].contact);
  }
  EXPECT_EQ(one.tight_face_contacts, two.tight_face_contacts);
  EXPECT_EQ(one.tight_segment_contacts, two.tight_segment_contacts);
  EXPECT_EQ(one.tight_point_contacts, two.tight_point_contacts);
  const SpatialStats &a = one.stats, &b = two.stats;
  EXPECT_EQ(std::tie(a.inner_facets, a.box_pairs, a.contacts, a.points, a.cells, a.patches),
            std::tie(b.inner_facets, b.box_pairs, b.contacts, b.points, b.cells, b.patches));
  EXPECT_EQ(std::tie(a.collision_tests, a.tight_tests), std::tie(b.collision_tests, b.tight_tests));
}

// Enough facets for every loop to have several parts, and for sorts and trees to be made in parts.
TEST(SpatialEngine, threads_change_nothing) {
  const MeshData p = torus(2, 0.6, 32, 16, 0), q = torus(1.3, 0.35, 24, 12, 0.7);
  const SpatialSum one = sum(p, q);
  expect_same_to_the_last_bit(one, sum(p, q, SpatialEngine::fast, 2));
}

TEST(SpatialEngine, threads_change_nothing_where_much_is_tight) {
  // A block with nine tunnels, and a peg that fits.
  oracles::Voxels block;
  for (int x = 0; x < 7; ++x)
    for (int y = 0; y < 7; ++y)
      for (int z = 0; z < 2; ++z)
        if (x % 2 == 0 || y % 2 == 0) block.insert({x, y, z});
  const MeshData p = oracles::voxel_mesh(block), q = oracles::voxel_mesh({{0, 0, 0}});
  const SpatialSum one = sum(p, q);
  EXPECT_EQ(one.tight_segments.size(), 9u);
  EXPECT_GT(one.stats.tight_tests, 100u);
  expect_same_to_the_last_bit(one, sum(p, q, SpatialEngine::fast, 2));
}

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
/// A sphere with bumps of all sizes: many facets meet.
MeshData bumpy(int rings, int around, double turn) {
  MeshData m;
  const auto position = [&](double a, double b) {
    const double r = 1 + 0.3 * std::sin(5 * a) * std::sin(4 * b);
    m.vertices.push_back(
        turned({r * std::sin(a) * std::cos(b), r * std::sin(a) * std::sin(b), r * std::cos(a)}, turn, 0.7 * turn));
  };
  for (int j = 1; j <= rings; ++j)
    for (int i = 0; i < around; ++i) position(std::numbers::pi * j / (rings + 1), 2 * std::numbers::pi * i / around);
  position(0, 0), position(std::numbers::pi, 0);
  const auto id = [&](int i, int j) { return static_cast<std::uint32_t>(j * around + i % around); };
  const auto top = static_cast<std::uint32_t>(rings * around);
  for (int i = 0; i < around; ++i) {
    m.faces.push_back({top, id(i, 0), id(i + 1, 0)});
    m.faces.push_back({top + 1, id(i + 1, rings - 1), id(i, rings - 1)});
    for (int j = 0; j + 1 < rings; ++j) {
      m.faces.push_back({id(i, j), id(i, j + 1), id(i + 1, j + 1)});
      m.faces.push_back({id(i, j), id(i + 1, j + 1), id(i + 1, j)});
    }
  }
  return m;
}

// What stages leave behind and nobody needs is given back when they are through.
TEST(SpatialEngine, holds_less_than_two_kilobytes_a_facet_beside_the_result) {
  if (oracles::kSanitized) GTEST_SKIP() << "the sanitizer's allocations are not counted";
  const MeshData p = bumpy(10, 20, 0.2), q = bumpy(10, 20, 1.1);
  const auto allocated = [] {
    const struct mallinfo2 info = mallinfo2();
    return static_cast<double>(info.uordblks + info.hblkhd);
  };
  const double before = allocated();
  double most = 0;
  SpatialOptions options;
  options.threads = 1;
  options.progress = [&](std::string_view, double) {
    most = std::max(most, allocated() - before);
    return true;
  };
  const SpatialSum s = sum_of_solids(p, q, options).value();
  const double result = allocated() - before, facets = static_cast<double>(s.stats.face_vertex + s.stats.edge_edge);
  EXPECT_GT(most, result / 2);
  EXPECT_LT((most - result) / facets, 2000);
}
#endif

TEST(SpatialEngine, cost_is_predicted_from_angles) {
  const Mesh p = Mesh::create(torus(2, 0.6, 32, 16, 0)).value();
  double face_vertex = 0, edge_edge = 0;
  for (int k = 0; k < 8; ++k) {
    const Mesh q = Mesh::create(torus(1.3, 0.35, 16, 8, 0.1 + 0.7 * k)).value();
    const SpatialCost cost = predict_cost(p, q);
    const SpatialSum s = minkowski_sum(p, q).value();
    face_vertex += static_cast<double>(s.stats.face_vertex) / cost.face_vertex / 8;
    edge_edge += static_cast<double>(s.stats.edge_edge) / cost.edge_edge / 8;
    EXPECT_EQ(cost.full_edge_edge, 1536u * 384u);
  }
  EXPECT_NEAR(face_vertex, 1, 0.1);
  EXPECT_NEAR(edge_edge, 1, 0.1);
}

TEST(SpatialEngine, more_memory_than_allowed_is_an_error_before_it_is_taken) {
  const Mesh p = Mesh::create(torus(2, 0.6, 16, 8, 0)).value(), q = Mesh::create(torus(1.3, 0.35, 16, 8, 0.7)).value();
  SpatialOptions options;
  options.memory = 100'000;
  const Error predicted = minkowski_sum(p, q, options).error();
  EXPECT_EQ(predicted.code, ErrorCode::out_of_memory);
  EXPECT_NE(predicted.message.find("predicted"), std::string::npos) << predicted.message;
  options.memory = 100'000'000;
  const std::uint64_t held = minkowski_sum(p, q, options).value().stats.held_bytes;
  EXPECT_GT(held, 100'000u);
  // Enough for what is predicted, not for all that is counted.
  oracles::Voxels grate;
  for (int x = 0; x < 7; ++x)
    for (int y = 0; y < 7; ++y)
      for (int z = 0; z < 2; ++z)
        if ((z == 0 ? x : y) % 2 == 0) grate.insert({x, y, z});
  const Mesh g = Mesh::create(oracles::voxel_mesh(grate)).value();
  options.memory = 0;
  const std::uint64_t predicted_bytes = predict_cost(g, g).bytes;
  const std::uint64_t held_bytes = minkowski_sum(g, g, options).value().stats.held_bytes;
  EXPECT_LT(held_bytes, 2 * predicted_bytes);
  EXPECT_LT(predicted_bytes, held_bytes);
  options.memory = (predicted_bytes + held_bytes) / 2;
  const Error actual = minkowski_sum(g, g, options).error();
  EXPECT_EQ(actual.code, ErrorCode::out_of_memory);
  EXPECT_NE(actual.message.find("at least"), std::string::npos) << actual.message;
}

TEST(SpatialEngine, convex_solids_keep_to_the_budget_too) {
  const Mesh p = solids::cylinder(300, 1, 1, solids::kDemoSnap);
  MeshData turned = p.data();
  for (Point3& v : turned.vertices) v = {v.z, v.x, v.y};
  const Mesh q = Mesh::create(std::move(turned)).value();
  EXPECT_TRUE(convex_sum_within(p, q, 100'000'000).ok());
  SpatialOptions options;
  for (const std::uint64_t memory : {10'000u, 300'000u, 1'500'000u}) {  // operands, crossings, the sum
    options.memory = memory;
    const auto sum = minkowski_sum(p, q, options);
    ASSERT_FALSE(sum) << memory;
    EXPECT_EQ(sum.error().code, ErrorCode::out_of_memory);
    EXPECT_NE(sum.error().message.find("the sum of convex solids takes"), std::string::npos);
  }
  // About one axis the sum is small, however many pairs of edges there are.
  EXPECT_TRUE(minkowski_sum(p, solids::cylinder(299, 2, 1, solids::kDemoSnap), options).ok());
  EXPECT_FALSE(convex_sum_within(p, q, 300'000));
  const SpatialSum first = convex_sum_within(p, p, 0)->sum();
  EXPECT_FALSE(convex_sum_within(first, q, 300'000));
  EXPECT_TRUE(convex_sum_within(first, q, 0).ok());
}

TEST(SpatialEngine, stages_that_are_recorded_count) {
  const MeshData p = torus(2, 0.6, 16, 8, 0), q = torus(1.3, 0.35, 16, 8, 0.7);
  SpatialOptions options;
  options.memory = sum_of_solids(p, q, {}).value().stats.held_bytes;
  EXPECT_TRUE(sum_of_solids(p, q, options).ok());
  options.trace = true;
  EXPECT_EQ(sum_of_solids(p, q, options).error().code, ErrorCode::out_of_memory);
}

TEST(SpatialEngine, can_be_cancelled_in_every_stage) {
  const MeshData p = torus(2, 0.6, 16, 8, 0), q = torus(1.3, 0.35, 16, 8, 0.7);
  for (const int threads : {1, 2}) {
    std::set<std::string> stages;
    SpatialOptions options;
    options.threads = threads;
    options.progress = [&](std::string_view stage, double fraction) {
      EXPECT_TRUE(fraction >= 0 && fraction <= 1) << stage;
      stages.insert(std::string(stage));
      return true;
    };
    ASSERT_TRUE(sum_of_solids(p, q, options).ok());
    EXPECT_GE(stages.size(), 6u);
    for (const std::string& where : stages) {
      options.progress = [&](std::string_view stage, double) { return stage != where; };
      EXPECT_EQ(sum_of_solids(p, q, options).error().code, ErrorCode::cancelled) << where;
    }
  }
}

/// A tetrahedron of this size with a corner in the origin.
MeshData small_corner(double size) {
  return {{{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

MeshData with(MeshData p, const MeshData& apart, Point3 at) {
  const auto first = static_cast<std::uint32_t>(p.vertices.size());
  for (const Point3& v : apart.vertices) p.vertices.push_back({v.x + at.x, v.y + at.y, v.z + at.z});
  for (Face f : apart.faces) {
    for (std::uint32_t& v : f) v += first;
    p.faces.push_back(std::move(f));
  }
  return p;
}

// One tiny part, far away along one axis after the other, makes the common grid so fine that coordinates have 26, 61,
// 124, 250 or more bits along the two others.
TEST(SpatialEngine, coordinates_of_any_width_give_the_same) {
  std::mt19937_64 random(31);
  std::set<int> widths;
  for (const int power : {-10, -45, -90, -110, -200, -700})
    for (int pair = 0; pair < fuzz_pairs(6); ++pair) {
      const Mesh p = valid_polyhedron(random), q = valid_polyhedron(random);
      MeshData tiny = small_corner(std::ldexp(1, power));
      const int axis = pair % 3;
      for (Point3& v : tiny.vertices) (axis == 0 ? v.x : axis == 1 ? v.y : v.z) *= std::ldexp(1, -power);
      const Point3 at{axis == 0 ? 100.0 : 0, axis == 1 ? 100.0 : 0, axis == 2 ? 100.0 : 0};
      const MeshData far = with({}, tiny, at);
      const SpatialSum alone = sum(p.data(), q.data()), apart = sum(far, q.data()),
                       both = sum(with(p.data(), tiny, at), q.data());
      widths.insert(both.stats.bits <= 26    ? 26
                    : both.stats.bits <= 61  ? 61
                    : both.stats.bits <= 124 ? 124
                    : both.stats.bits <= 250 ? 250
                                             : 8192);
      const std::string where = "2^" + std::to_string(power) + ", pair " + std::to_string(pair);
      EXPECT_EQ(both.faces.size(), alone.faces.size() + apart.faces.size()) << where;
      EXPECT_EQ(both.vertices.size(), alone.vertices.size() + apart.vertices.size()) << where;
      EXPECT_EQ(both.tight_faces.size(), alone.tight_faces.size()) << where;
      EXPECT_EQ(both.tight_segments.size(), alone.tight_segments.size()) << where;
      EXPECT_EQ(both.tight_points.size(), alone.tight_points.size()) << where;
      EXPECT_EQ(both.volume_exact(), alone.volume_exact() + apart.volume_exact()) << where;
    }
  EXPECT_EQ(widths, (std::set<int>{26, 61, 124, 250, 8192}));
}

}  // namespace
}  // namespace dymsum
