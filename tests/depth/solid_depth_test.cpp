// Depth and distance of solids of any shape, against all faces and tight features of their exact sum.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <random>

#include "dymsum/penetration_depth.h"
#include "dymsum/solids.h"
#include "oracles/coordinate_kinds.h"
#include "spatial/convex/convex_cases.h"
#include "spatial/sum/random_solids.h"
#include "spatial/sum/solid_cases.h"

namespace dymsum::test {
namespace {

Mesh solid(const MeshData& data) { return Mesh::create(data).value(); }

SolidDepth depth_of(const Mesh& p, const Mesh& q, DepthEngine engine = DepthEngine::search) {
  DepthOptions options;
  options.engine = engine;
  return SolidDepth::create(p, q, options).value();
}

/// Both engines at a translation, which have to agree in everything.
SolidDistance agreed(SolidDepth& search, SolidDepth& boundary, Point3 at) {
  const SolidDistance found = search.at(at), expected = boundary.at(at);
  EXPECT_TRUE(found == expected) << at.x << " " << at.y << " " << at.z << ": " << found.squared.to_string() << " ("
                                 << found.ways.size() << " ways) and " << expected.squared.to_string() << " ("
                                 << expected.ways.size() << ")";
  return found;
}

MeshData moved_by(MeshData m, double dx) {
  for (Point3& v : m.vertices) v.x += dx;
  return m;
}

SolidDistance agreed(const Mesh& p, const Mesh& q, Point3 at = {}) {
  SolidDepth search = depth_of(p, q), boundary = depth_of(p, q, DepthEngine::boundary);
  return agreed(search, boundary, at);
}

TEST(SolidDepth, cubes_that_overlap_by_a_half) {
  const SolidDistance d = agreed(solid(box(1)), solid(box(1)), {1.5, 0, 0});
  EXPECT_EQ(d.meeting, Meeting::overlapping);
  EXPECT_EQ(d.distance, 0.5);
  EXPECT_EQ(d.squared.to_string(), "1/4");
  ASSERT_EQ(d.ways.size(), 1U);
  EXPECT_EQ(d.ways[0].direction, (Point3{1, 0, 0}));
  EXPECT_FALSE(d.ways[0].contacts.empty());
}

TEST(SolidDepth, identical_cubes_have_six_ways_out_and_one_inside_another_too) {
  EXPECT_EQ(agreed(solid(box(1)), solid(box(1))).ways.size(), 6U);
  const SolidDistance inside = agreed(solid(box(2)), solid(box(0.5)));
  EXPECT_EQ(inside.distance, 2.5);
  EXPECT_EQ(inside.ways.size(), 6U);
  EXPECT_EQ(agreed(solid(box(2)), solid(box(0.5)), {0.75, 0, 0}).distance, 1.75);
}

TEST(SolidDepth, touching_and_apart) {
  const SolidDistance touching = agreed(solid(box(1)), solid(box(1)), {2, 0.5, 0});
  EXPECT_EQ(touching.meeting, Meeting::touching);
  EXPECT_EQ(touching.distance, 0);
  ASSERT_EQ(touching.ways.size(), 1U);
  EXPECT_EQ(touching.ways[0].direction, Point3{});
  EXPECT_FALSE(touching.ways[0].contacts.empty());
  const SolidDistance apart = agreed(solid(box(1)), solid(box(1)), {5, 6, 2});
  EXPECT_EQ(apart.meeting, Meeting::apart);
  EXPECT_EQ(apart.distance, 5);
  EXPECT_EQ(agreed(solid(box(1)), solid(box(1)), {0x1p60, 0, 0}).distance, 0x1p60 - 2);
}

TEST(SolidDepth, is_the_same_however_finely_the_surface_is_cut) {
  const Mesh fine = solids::tessellated_cube(2, 1, solids::kDemoSnap);
  std::optional<SolidDistance> first;
  for (const int k : {1, 2, 4, 8}) {
    SolidDepth pair = depth_of(solids::tessellated_cube(2, k, solids::kDemoSnap), fine);
    const SolidDistance d = pair.at({1.25, 0.375, 0.125});
    if (!first) first = d;
    EXPECT_EQ(d.squared.to_string(), first->squared.to_string()) << k;
    EXPECT_EQ(d.distance, 0.75);
  }
}

TEST(SolidDepth, a_ball_in_a_tunnel_and_a_box_in_a_cavity) {
  const SolidDistance tight = agreed(solid(tunnel()), solid(box(1)));
  EXPECT_EQ(tight.meeting, Meeting::touching) << "the box fits the tunnel exactly";
  const SolidDistance off = agreed(solid(tunnel()), solid(box(1)), {0, 0.25, 0});
  EXPECT_EQ(off.distance, 0.25) << "back into the tunnel, where there is no clearance";
  EXPECT_EQ(agreed(solid(tunnel()), solid(box(0.5)), {0, 0.75, 0}).distance, 0.25);
  EXPECT_EQ(agreed(solid(cavity()), solid(box(0.5)), {0.25, 0, 0}).meeting, Meeting::apart);
  EXPECT_EQ(agreed(solid(cavity()), solid(box(0.5)), {0.25, 0, 0}).distance, 0.25);
  EXPECT_EQ(agreed(solid(cavity()), solid(box(1)), {0.25, 0, 0}).distance, 0.25) << "a tight point";
  EXPECT_EQ(agreed(solid(cavity()), solid(box(2)), {0, 0, 1}).distance, 6);
  EXPECT_EQ(agreed(solid(ell()), solid(ell()), {1, 1, 0}).meeting, Meeting::overlapping);
}

TEST(SolidDepth, of_random_solids_is_that_of_all_faces_of_the_sum) {
  std::mt19937_64 random(7);
  const int pairs = std::getenv("DYMSUM_FUZZ_PAIRS") ? std::atoi(std::getenv("DYMSUM_FUZZ_PAIRS")) : 25;
  std::uniform_int_distribution<int> quarter(-12, 12);
  int overlapping = 0, ties = 0;
  for (int k = 0; k < pairs; ++k) {
    const Mesh p = random_solids::valid_polyhedron(random), q = random_solids::valid_polyhedron(random);
    SolidDepth search = depth_of(p, q), boundary = depth_of(p, q, DepthEngine::boundary);
    for (int i = 0; i < 8; ++i) {
      const double unit = i % 2 ? 0.25 : 0.5;
      const SolidDistance d =
          agreed(search, boundary, {unit * quarter(random), unit * quarter(random), unit * quarter(random)});
      overlapping += d.meeting == Meeting::overlapping;
      ties += d.ways.size() > 1;
      if (HasFailure()) FAIL() << "pair " << k;
    }
  }
  EXPECT_GT(overlapping, pairs);
  EXPECT_GT(ties, 0);
}

TEST(SolidDepth, of_coordinates_of_every_kind_is_that_of_all_faces_of_the_sum) {
  std::mt19937_64 random(7311);
  std::uniform_int_distribution<int> quarter(-12, 12);
  for (const CoordinateKind kind : kCoordinateKinds) {
    int compared = 0;
    for (int k = 0; k < 4; ++k) {
      const Result<Mesh> p = Mesh::create(of_kind(random_solids::tiny_polyhedron(random), kind, random)),
                         q = Mesh::create(of_kind(random_solids::tiny_polyhedron(random), kind, random));
      if (!p.ok() || !q.ok()) continue;
      SolidDepth search = depth_of(*p, *q), boundary = depth_of(*p, *q, DepthEngine::boundary);
      for (int i = 0; i < 6; ++i, ++compared)
        agreed(search, boundary, of_kind(Point3{0.5 * quarter(random), 0.5 * quarter(random), 0}, kind, random));
      if (HasFailure()) FAIL() << name_of(kind) << ", pair " << k;
    }
    EXPECT_GT(compared, 0) << name_of(kind);
  }
}

/// A plate with a hole: two of them are links of a chain.
Mesh link(bool upright) {
  MeshData m = tunnel();
  for (Point3& v : m.vertices) {
    v = {v.x / 5, v.y, v.z};  // a plate of thickness 2 with a hole of 2 x 2
    if (upright) v = {v.y, v.z, v.x};
  }
  return solid(m);
}

TEST(SolidDepth, interlocked_links_and_a_ball_in_a_cup) {
  for (const Point3 at : {Point3{0, 0, 0}, {0.5, 3, 0}, {1, 2, 3}, {3, 3, 3}, {0, 3, 0.25}})
    agreed(link(false), link(true), at);
  const Mesh cup = solid(cavity()), ball = solids::geodesic_sphere(1, 0.75, solids::kDemoSnap);
  SolidDepth search = depth_of(cup, ball), boundary = depth_of(cup, ball, DepthEngine::boundary);
  for (const Point3 at : {Point3{0, 0, 0}, {0.25, 0.125, 0}, {1, 0.5, 0.25}, {3, 0, 0}, {6, 6, 6}})
    agreed(search, boundary, at);
}

TEST(SolidDepth, coaxial_cylinders_leave_by_the_end_or_the_side) {
  const Mesh thick = solids::cylinder(8, 2, 4, solids::kDemoSnap), thin = solids::cylinder(8, 1, 1, solids::kDemoSnap);
  const SolidDistance d = agreed(thick, thin, {0, 0, 2.75});
  EXPECT_EQ(d.meeting, Meeting::overlapping);
  agreed(thick, thick);
}

/// Flush faces and edges all along, in steps of many sizes: what is told of a cell without a collision test is what a
/// fresh search finds.
TEST(SolidDepth, sliding_along_flush_faces_is_the_same_as_from_scratch_with_few_collision_tests) {
  const Mesh p = solid(ell()), q = solid(box(1));
  const SolidDepth fresh = depth_of(p, q);
  SolidDepth moving = fresh;
  std::uint64_t tests = 0, steps = 0;
  for (const Point3 way : {Point3{1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0.5, 0.25}}) {
    for (const double step : {1.0, 0.25, 0x1p-5}) {
      for (int k = 0; k < 60; ++k) {
        const double s = step * k;
        const Point3 at{2 + s * way.x, 1 + s * way.y, 3 + s * way.z};
        const SolidDistance d = moving.at(at);
        ASSERT_TRUE(d == SolidDepth(fresh).at(at)) << at.x << " " << at.y << " " << at.z;
        if (step > 0.1 || d.meeting != Meeting::overlapping) continue;
        tests += d.work.collision_tests, ++steps;
      }
    }
  }
  EXPECT_GT(steps, 100U);
  EXPECT_LT(4 * tests, steps);
}

TEST(SolidDepth, is_the_same_along_a_motion_as_from_scratch) {
  SolidDepth moving = depth_of(solid(ell()), link(true));
  std::uint64_t work = 0, fresh_work = 0;
  for (int k = 0; k < 40; ++k) {
    const Point3 at{0.125 * k, 2 + 0.0625 * k, 4 - 0.125 * k};
    const SolidDistance d = moving.at(at), fresh = depth_of(solid(ell()), link(true)).at(at);
    EXPECT_TRUE(d == fresh) << k;
    work += d.work.candidates, fresh_work += fresh.work.candidates;
  }
  EXPECT_LT(work, fresh_work) << "what the last answer covers is left out";
}

TEST(SolidDepth, moves_with_the_solids_and_turns_with_exchange) {
  const Mesh p = solid(ell()), q = link(true);
  const SolidDistance d = depth_of(p, q).at({3, 3, 4}), other = depth_of(q, p).at({-3, -3, -4});
  EXPECT_EQ(d.squared.to_string(), other.squared.to_string());
  EXPECT_EQ(d.ways.size(), other.ways.size());
  const SolidDistance moved = depth_of(solid(moved_by(ell(), 1024.5)), q).at({3 + 1024.5, 3, 4});
  EXPECT_EQ(d.squared.to_string(), moved.squared.to_string());
}

TEST(SolidDepth, of_convex_solids_is_that_of_their_convex_sum) {
  std::mt19937_64 random(3);
  std::uniform_int_distribution<int> eighth(-16, 16);
  for (int k = 0; k < 12; ++k) {
    const Mesh p = random_grid_polytope(random, 8, 3), q = random_round_polytope(random, 9);
    SolidDepth pair = depth_of(p, q);
    const Point3 at{eighth(random) / 8.0, eighth(random) / 8.0, eighth(random) / 8.0};
    const ConvexDepth convex = penetration_depth(p, q, {}, {}, at).value();
    const SolidDistance d = pair.at(at);
    EXPECT_EQ(convex.inside, d.meeting == Meeting::overlapping) << k;
    if (convex.inside) {
      EXPECT_EQ(convex.depth_squared.to_string(), d.squared.to_string()) << k;
    }
  }
}

TEST(SolidDepth, along_a_direction_is_the_first_free_position) {
  SolidDepth pair = depth_of(solid(tunnel()), solid(box(0.5)));
  EXPECT_EQ(pair.along({0, 0.75, 0}, {0, -1, 0}).to_string(), "1/4");
  EXPECT_EQ(pair.along({0, 0.75, 0}, {0, 1, 0}).to_string(), "19/4");
  EXPECT_EQ(pair.along({0, 0, 0}, {0, 1, 0}).to_string(), "0/1") << "free at once";
  EXPECT_EQ(depth_of(solid(tunnel()), solid(box(1))).along({0, 0.25, 0}, {0, -0.5, 0}).to_string(), "1/2")
      << "a tight passage";
  EXPECT_EQ(pair.along({0, 3, 0}, {1, 0, 0}).to_string(), "11/2");
  EXPECT_THROW(pair.along({0, 0, 0}, {0, 0, 0}), std::invalid_argument);
}

TEST(SolidDepth, hostile_input_is_refused_or_answered) {
  const Mesh cube = solid(box(1));
  EXPECT_EQ(SolidDepth::create(cube, Mesh()).error().code, ErrorCode::no_area);
  MeshData sheet{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  const Mesh thin = Mesh::with_thin_parts(sheet).value();
  EXPECT_TRUE(SolidDepth::create(cube, thin).ok());
  EXPECT_EQ(SolidDepth::create(thin, thin).error().code, ErrorCode::unsupported_operand);
  const double inf = std::numeric_limits<double>::infinity();
  SolidDepth pair = depth_of(cube, cube);
  EXPECT_THROW(pair.at({inf, 0, 0}), std::invalid_argument);
  EXPECT_THROW(pair.at({}, -1), std::invalid_argument);
  EXPECT_EQ(pair.at({1e300, 0, 0}).meeting, Meeting::apart);
  EXPECT_EQ(pair.at({0x1p-1060, 0, 0}).ways.size(), 1U);
  const Mesh large = solid(box(0x1p900)), small = solid(box(0x1p-900));
  EXPECT_EQ(depth_of(large, large).at({0x1p900, 0, 0}).distance, 0x1p900);
  EXPECT_EQ(depth_of(small, small).at({0x1p-900, 0, 0}).distance, 0x1p-900);
  EXPECT_EQ(depth_of(large, small).at({}).distance, 0x1p900) << "coordinates of 1,850 bits";
}

TEST(DepthBatch, rows_are_in_order_and_do_not_depend_on_threads) {
  const SolidDepth pair = depth_of(solid(ell()), link(true));
  std::vector<Point3> moves;
  for (int k = 0; k < 60; ++k) moves.push_back({0.25 * (k % 7), 0.5 * (k % 11), 0.375 * (k % 13)});
  DepthBatchOptions one, many;
  one.threads = 1, many.threads = 4;
  const std::vector<SolidDistance> rows = depth_batch(pair, moves, one).value();
  EXPECT_TRUE(rows == depth_batch(pair, moves, many).value());
  for (const std::size_t k : {0U, 17U, 59U}) EXPECT_TRUE(rows[k] == SolidDepth(pair).at(moves[k])) << k;
  one.time_limit = -1;
  EXPECT_EQ(depth_batch(pair, moves, one).error().code, ErrorCode::out_of_range);
  moves[3].x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(depth_batch(pair, moves, many).error().evidence.vertex, 3);
  many.progress = [](std::string_view, double) { return false; };
  moves[3].x = 0;
  EXPECT_EQ(depth_batch(pair, moves, many).error().code, ErrorCode::cancelled);
  const Mesh cube = solid(box(1)), none;
  const std::vector<DepthQuestion> questions{
      {&cube, &cube, {1.5, 0, 0}}, {&cube, &none, {}}, {&cube, &cube, {4, 0, 0}}};
  const auto answers = depth_batch(questions).value();
  EXPECT_EQ(answers[0]->distance, 0.5);
  EXPECT_EQ(answers[1].error().code, ErrorCode::no_area);
  EXPECT_EQ(answers[2]->distance, 2);
}

TEST(DepthBatch, a_hundred_thousand_rows_are_the_same_for_any_number_of_threads) {
  const auto rows_of = [](const SolidDepth& pair, std::size_t count, int threads) {
    std::mt19937_64 random(19);
    std::vector<Point3> moves(count);
    const auto coordinate = [&] { return static_cast<double>(random() % 4096) / 1024 - 2; };
    for (Point3& at : moves) at = {coordinate(), coordinate(), coordinate()};
    DepthBatchOptions options;
    options.threads = threads;
    return depth_batch(pair, moves, options).value();
  };
  const auto same = [&](const SolidDepth& pair, std::size_t count, int threads) {
    const std::vector<SolidDistance> one = rows_of(pair, count, 1), many = rows_of(pair, count, threads);
    return one.size() == count && std::equal(one.begin(), one.end(), many.begin(), many.end());
  };
  EXPECT_TRUE(same(depth_of(solid(box(1)), solid(box(0.5))), 5000, 7));
  DepthOptions no_contacts;  // which take most of the time
  no_contacts.contacts = false;
  EXPECT_TRUE(same(SolidDepth::create(solid(box(1)), solid(box(0.5)), no_contacts).value(), 100000, 7));
  // Not convex: what a thread knows of its last rows is not what another one knows.
  const SolidDepth bent = depth_of(solid(ell()), solid(box(0.5)));
  EXPECT_TRUE(same(bent, 1000, 2));
  EXPECT_TRUE(same(bent, 1000, 5));
}

TEST(DepthBatch, a_row_whose_time_is_over_has_bounds) {
  SolidDepth pair = depth_of(solid(ell()), link(true));
  const Point3 at{3, 3, 4};
  const SolidDistance whole = SolidDepth(pair).at(at), cut = pair.at(at, 1e-9);
  EXPECT_FALSE(cut.complete);
  EXPECT_TRUE(cut.ways.empty());
  EXPECT_LE(cut.at_least, whole.distance);
  EXPECT_GE(cut.distance, whole.distance);
}

}  // namespace
}  // namespace dymsum::test
