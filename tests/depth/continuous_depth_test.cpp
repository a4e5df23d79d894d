// Continuous depth against exact depth, numerical integration of its normals, and differences.
#include "dymsum/continuous_depth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

#include "depth/continuous_tracker.h"
#include "dymsum/solids.h"
#include "spatial/convex/convex_cases.h"
#include "spatial/sum/random_solids.h"
#include "spatial/sum/solid_cases.h"

namespace dymsum::test {
namespace {

using spatial::Vec3;

Mesh mesh_of(const MeshData& data) { return Mesh::create(data).value(); }

ContinuousDepth tracker_of(const Mesh& p, const Mesh& q, double smoothing, double inflation = 2) {
  ContinuousDepthOptions options;
  options.smoothing_length = smoothing, options.inflation = inflation;
  return ContinuousDepth::create(p, q, options).value();
}

Vec3 vec(const Point3& v) { return {v.x, v.y, v.z}; }
Point3 point(Vec3 v) { return {v.x, v.y, v.z}; }
double gap(const Point3& a, const Point3& b) { return spatial::length(vec(a) - vec(b)); }
Point3 between(const Point3& a, const Point3& b, double s) { return point(vec(a) + s * (vec(b) - vec(a))); }

/// The sum of normals of small triangles, weighted at their midpoints: by definition.
void add_triangle(Vec3 a, Vec3 b, Vec3 c, int depth, double l, Vec3 x, Vec3& sum) {
  const Vec3 area = spatial::cross(b - a, c - a);
  if (depth > 0) {
    const Vec3 d = 0.5 * (a + b), e = 0.5 * (b + c), f = 0.5 * (c + a);
    add_triangle(a, d, f, depth - 1, l, x, sum), add_triangle(d, b, e, depth - 1, l, x, sum);
    add_triangle(f, e, c, depth - 1, l, x, sum), add_triangle(d, e, f, depth - 1, l, x, sum);
    return;
  }
  // Exact for quadratic weights: the midpoints of the sides.
  for (const Vec3& m : {0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)}) {
    const double left = l * l - spatial::dot(m - x, m - x);
    if (left > 0) sum = sum + left * left / 6 * area;
  }
}

Vec3 summed_normal(const SpatialSum& sum, double l, Vec3 x) {
  const SpatialSum::Rounded drawn = sum.drawn();
  Vec3 total;
  for (const Face& t : drawn.mesh.faces)
    add_triangle(vec(drawn.mesh.vertices[t[0]]), vec(drawn.mesh.vertices[t[1]]), vec(drawn.mesh.vertices[t[2]]), 5, l,
                 x, total);
  return total;
}

TEST(ContinuousNormals, are_the_integral_and_its_derivative) {
  std::mt19937_64 random(11);
  for (const MeshData& data : {ell(), tunnel()}) {
    const SpatialSum sum = minkowski_sum(mesh_of(data), mesh_of(box(1))).value();
    const depth::ContinuousSurface surface = depth::continuous_surface(sum, 1);
    std::uniform_real_distribution<double> position(-8, 12), length(2, 14);
    for (int k = 0; k < 20; ++k) {
      const Vec3 x{position(random), position(random), position(random)};
      const double l = length(random), scale = std::pow(l, 6);
      const depth::SmoothedNormal n = depth::smoothed_normal(surface, l, x);
      EXPECT_LT(spatial::length(n.value - summed_normal(sum, l, x)), 1e-3 * scale) << k;
      for (const Vec3& d : {Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) {
        const double h = 1e-5 * l;
        const Vec3 slope = (0.5 / h) * (depth::smoothed_normal(surface, l, x + h * d).value -
                                        depth::smoothed_normal(surface, l, x - h * d).value);
        EXPECT_LT(spatial::length(slope - n.derivative * d), 1e-6 * scale / l) << k;
      }
    }
  }
}

TEST(ContinuousNormals, do_not_depend_on_how_the_surface_is_cut_nor_on_where_the_place_lies) {
  // On planes, edges and corners, too.
  const depth::ContinuousSurface plain = depth::continuous_surface(solids::box(-1, -1, -1, 1, 1, 1), 1);
  for (const int k : {1, 2, 4, 8}) {
    const depth::ContinuousSurface fine =
        depth::continuous_surface(solids::tessellated_cube(2, k, solids::kDemoSnap), 1);
    for (const Vec3& x : {Vec3{1, 1, 1}, {1, 0, 0}, {0.5, 0.5, 1}, {0.25, -0.5, 0.3}, {1, 1, 0.125}, {0, 0, 0.75}})
      for (const double l : {0.5, 1.0, 1.7}) {
        const Vec3 a = depth::smoothed_normal(plain, l, x).value, b = depth::smoothed_normal(fine, l, x).value;
        EXPECT_LT(spatial::length(a - b), 1e-13) << k << " " << l;
      }
  }
}

TEST(ContinuousDepth, cubes_that_overlap_by_a_half) {
  for (const double l : {0.0, 0.3, 1.0, 3.0}) {
    ContinuousDepth pair = tracker_of(mesh_of(box(1)), mesh_of(box(1)), l);
    const ContinuousContact c = pair.query({1.5, 0, 0}).value();
    EXPECT_EQ(c.meeting, Meeting::overlapping);
    EXPECT_NEAR(c.depth, 0.5, 1e-12) << l;
    EXPECT_NEAR(c.euclidean_depth, 0.5, 1e-15);
    EXPECT_LT(gap(c.normal, {1, 0, 0}), 1e-12);
    EXPECT_EQ(c.discontinuity, Discontinuity::entered);
    EXPECT_EQ(c.branch, 1U);
    EXPECT_EQ(pair.euclidean_squared().to_string(), "1/4");
    EXPECT_EQ(c.smoothed, l > 0);
  }
}

TEST(ContinuousDepth, touching_apart_identical_and_one_inside_another) {
  ContinuousDepth pair = tracker_of(mesh_of(box(1)), mesh_of(box(1)), 1);
  EXPECT_EQ(pair.query({2, 0.5, 0}).value().meeting, Meeting::touching);
  EXPECT_EQ(pair.query({2.5, 0.5, 0}).value().meeting, Meeting::apart);
  EXPECT_EQ(pair.query({0x1p60, 0, 0}).value().meeting, Meeting::apart);
  EXPECT_EQ(pair.euclidean_squared(), Rational(0));
  const ContinuousContact identical = pair.query({}).value();
  EXPECT_EQ(identical.euclidean_depth, 2);
  EXPECT_GE(identical.depth, 2 - 1e-12);
  ContinuousDepth inside = tracker_of(mesh_of(box(2)), mesh_of(box(0.5)), 2);
  EXPECT_EQ(inside.query({0.75, 0, 0}).value().euclidean_depth, 1.75);
}

/// After the move Q touches P: exactly, up to the rounding of the move; and at the witnesses.
void expect_way_out(SolidDepth& exact, const ContinuousContact& c, const Point3& at, const Rational& squared) {
  const SolidDistance d = exact.at(at);
  ASSERT_EQ(d.meeting, c.meeting);
  if (c.meeting != Meeting::overlapping) return;
  EXPECT_EQ(d.squared, squared);
  EXPECT_NEAR(d.distance, c.euclidean_depth, c.error);
  EXPECT_GE(c.depth, c.euclidean_depth - c.error);
  EXPECT_LE(c.depth, 2 * c.euclidean_depth + c.error);
  EXPECT_NEAR(spatial::length(vec(c.normal)), 1, 1e-14);
  const Point3 after = point(vec(at) + c.depth * vec(c.normal));
  EXPECT_LE(exact.at(after).distance, 2 * c.error);
  EXPECT_LT(gap(c.witness_p, point(vec(c.witness_q) + c.depth * vec(c.normal))), 1e-12 * (1 + c.depth));
}

TEST(ContinuousDepth, ways_out_end_on_the_boundary_and_the_shortest_is_exact) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> position(-1, 1);
  const std::array<std::array<Mesh, 2>, 3> pairs = {
      {{mesh_of(ell()), mesh_of(box(2))}, {mesh_of(tunnel()), mesh_of(ell())}, {mesh_of(cavity()), mesh_of(box(1))}}};
  int overlapping = 0;
  for (const auto& [p, q] : pairs) {
    SolidDepth exact = SolidDepth::create(p, q).value();
    const depth::ContinuousSurface ps = depth::continuous_surface(p, 1), qs = depth::continuous_surface(q, 1);
    for (const double l : {0.0, 0.5, 4.0}) {
      ContinuousDepth pair = tracker_of(p, q, l);
      for (int k = 0; k < 40; ++k) {
        const Point3 at{9 * position(random), 9 * position(random), 9 * position(random)};
        const ContinuousContact c = pair.query(at).value();
        expect_way_out(exact, c, at, pair.euclidean_squared());
        if (c.meeting != Meeting::overlapping) continue;
        ++overlapping;
        EXPECT_TRUE(depth::comes_within(ps, vec(c.witness_p), 1e-9));
        EXPECT_TRUE(depth::comes_within(qs, vec(c.witness_q) - vec(at), 1e-9));
      }
    }
  }
  EXPECT_GT(overlapping, 100);
}

TEST(ContinuousDepth, a_quarter_turn_is_that_of_the_turned_solid) {
  const Rotation quarter = Rotation::about({0, 0, 1}, std::numbers::pi / 2).value();
  const Mesh p = mesh_of(ell()), q = mesh_of(tunnel()), turned_q = turned(q, quarter);
  for (const double l : {0.0, 2.0}) {
    ContinuousDepth turning = tracker_of(p, q, l), fixed = tracker_of(p, turned_q, l);
    for (const Point3& at : {Point3{9, 3, 1}, {8.5, 2.5, 1.25}, {0.5, 12, 5}}) {
      turning.forget(), fixed.forget();
      const ContinuousContact a = turning.query(at, quarter).value(), b = fixed.query(at).value();
      EXPECT_NEAR(a.depth, b.depth, 1e-12);
      EXPECT_LT(gap(a.normal, b.normal), 1e-12);
      EXPECT_EQ(turning.euclidean_squared(), fixed.euclidean_squared());
    }
  }
}

TEST(ContinuousDepth, without_smoothing_and_in_its_limit_is_the_exact_depth) {
  const Mesh p = mesh_of(ell()), q = mesh_of(box(1));
  SolidDepth exact = SolidDepth::create(p, q).value();
  for (const Point3& at : {Point3{2, 3, 4.5}, {10.5, 2, 5}, {4.25, 8, 3}, {-0.5, -0.25, 5}}) {
    const double truth = exact.at(at).distance;
    double last = std::numeric_limits<double>::infinity();
    for (const double l : {4.0, 1.0, 0.25, 0x1p-6, 0x1p-12, 0.0}) {
      const ContinuousContact c = tracker_of(p, q, l).query(at).value();
      const double excess = c.depth - truth;
      EXPECT_GE(excess, -c.error);
      EXPECT_LE(excess, last + 1e-9);
      last = excess;
    }
    EXPECT_NEAR(last, 0, 1e-13);
  }
}

TEST(ContinuousDepth, gradient_is_the_slope_of_depth) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> position(-1, 1);
  const Mesh p = mesh_of(ell()), q = mesh_of(box(1));
  int compared = 0;
  for (const double l : {0.0, 1.0, 3.0})
    for (int k = 0; k < 40; ++k) {
      const Point3 at{5 + 6 * position(random), 2 + 3 * position(random), 5 + 6 * position(random)};
      ContinuousDepth pair = tracker_of(p, q, l);
      const ContinuousContact c = pair.query(at).value();
      if (c.meeting != Meeting::overlapping || c.turn_rate > 2) continue;
      constexpr double kStep = 1e-6;
      for (const Vec3& d : {Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) {
        const ContinuousContact up = pair.query(point(vec(at) + kStep * d)).value();
        const ContinuousContact down = pair.query(point(vec(at) - kStep * d)).value();
        if (up.discontinuity != Discontinuity::none || down.discontinuity != Discontinuity::none) continue;
        EXPECT_NEAR((up.depth - down.depth) / (2 * kStep), spatial::dot(vec(c.gradient), d), 1e-5) << l << " " << k;
        EXPECT_LE(gap(up.normal, down.normal), 2.01 * kStep * c.turn_rate + 1e-9);
        ++compared;
      }
    }
  EXPECT_GT(compared, 150);
}

TEST(ContinuousDepth, torque_is_the_slope_of_exact_depth_in_a_turn) {
  const Mesh p = mesh_of(ell()),
             q = turned(solids::tessellated_cube(2, 1, solids::kDemoSnap), Rotation::about({1, 2, 3}, 0.5).value());
  ContinuousDepth pair = tracker_of(p, q, 0);
  for (const Point3& at : {Point3{10.25, 2, 5}, {2, 10.5, 5}, {3, 2, -0.75}}) {
    const ContinuousContact c = pair.query(at).value();
    for (const Point3& axis : {Point3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) {
      const double step = 1e-5;
      const double up = pair.query(at, Rotation::about(axis, step).value()).value().depth;
      const double down = pair.query(at, Rotation::about(axis, -step).value()).value().depth;
      EXPECT_NEAR((up - down) / (2 * step), spatial::dot(vec(c.torque), vec(axis)), 2e-3);
    }
  }
}

struct Trace {
  int overlapping = 0, jumps = 0;  ///< jumps without entering
  double turn = 0;                 ///< the largest in a step that is no jump
  double excess = 0;               ///< the largest depth over the exact one
};

Trace along(ContinuousDepth& pair, const Point3& from, const Point3& to, int steps, Point3 axis = {},
            double angle = 0) {
  Trace trace;
  Point3 last{};  // zero: none
  for (int k = 0; k <= steps; ++k) {
    const double s = static_cast<double>(k) / steps;
    const Rotation turned = angle == 0 ? Rotation{} : Rotation::about(axis, s * angle).value();
    const ContinuousContact c = pair.query(between(from, to, s), turned).value();
    if (c.meeting != Meeting::overlapping) continue;
    ++trace.overlapping;
    trace.excess = std::max(trace.excess, c.depth / c.euclidean_depth);
    if (c.discontinuity == Discontinuity::none && last == Point3{}) EXPECT_EQ(k, 0);
    else if (c.discontinuity == Discontinuity::none) trace.turn = std::max(trace.turn, gap(c.normal, last));
    else trace.jumps += c.discontinuity != Discontinuity::entered;
    last = c.normal;
  }
  return trace;
}

TEST(ContinuousDepth, sliding_over_an_edge_turns_the_normal_continuously) {
  const Mesh p = mesh_of(box(2)), q = mesh_of(box(1));
  const Point3 from{0, 0, 2.75}, corner{2.75, 0, 2.75}, to{2.75, 0, 0};
  ContinuousDepth smooth = tracker_of(p, q, 1.5), sharp = tracker_of(p, q, 0);
  const Trace first = along(smooth, from, corner, 500), second = along(smooth, corner, to, 500);
  EXPECT_EQ(first.jumps + second.jumps, 0);
  EXPECT_LT(std::max(first.turn, second.turn), 0.02);
  EXPECT_LT(std::max(first.excess, second.excess), 1.5);
  along(sharp, from, corner, 500);
  // From one face to the other, in one step.
  EXPECT_EQ(along(sharp, corner, to, 500).jumps, 1);
}

TEST(ContinuousDepth, where_smoothed_ways_are_too_long_the_shortest_is_followed) {
  const Mesh p = mesh_of(box(2)), q = mesh_of(box(1));
  ContinuousDepth pair = tracker_of(p, q, 3, 1.05);
  const Point3 from{0.5, 0, 2.5}, corner{2.5, 0, 2.5}, to{2.5, 0, 0.5};
  const Trace first = along(pair, from, corner, 300), second = along(pair, corner, to, 300);
  EXPECT_LE(std::max(first.excess, second.excess), 1.05 + 1e-9);
  EXPECT_LT(std::max(first.turn, second.turn), 0.05);
  // Out of the smoothed branch, over the edge, back into one.
  EXPECT_GE(first.jumps + second.jumps, 3);
  EXPECT_LE(first.jumps + second.jumps, 4);
}

TEST(ContinuousDepth, what_jumps_is_told_and_nothing_else_jumps) {
  const Mesh p = mesh_of(box(1)),
             q = turned(solids::tessellated_cube(1, 1, solids::kDemoSnap), Rotation::about({3, 1, 2}, 0.7).value());
  for (const double l : {0.1, 0.3, 1.0, 3.0}) {
    ContinuousDepth pair = tracker_of(p, q, l);
    const Trace trace = along(pair, {-2, 0.125, -0.25}, {2, 0.5, 0.25}, 4000);
    EXPECT_GT(trace.overlapping, 1000);
    EXPECT_LT(trace.turn, 0.25);
    EXPECT_LE(trace.excess, 2 + 1e-9);
    if (l < 0.5) EXPECT_GT(trace.jumps, 0);
    else EXPECT_LE(trace.jumps, 1);
  }
}

TEST(ContinuousDepth, cup_and_ball_and_coaxial_cylinders) {
  // A cup: a tunnel closed at one end.
  const Mesh cup = mesh_of(tunnel()), ball = solids::geodesic_sphere(2, 0.875, solids::kDemoSnap);
  ContinuousDepth pair = tracker_of(cup, ball, 0.5);
  EXPECT_EQ(pair.query({}).value().meeting, Meeting::apart);  // inside the hole, not in the wall
  const ContinuousContact pressed = pair.query({0, 0.25, 0}).value();
  EXPECT_EQ(pressed.meeting, Meeting::overlapping);
  EXPECT_LT(gap(pressed.normal, {0, -1, 0}), 0.05);
  EXPECT_NEAR(pressed.euclidean_depth, 0.125, 1e-6);
  const Mesh rod = solids::cylinder(24, 1, 4, solids::kDemoSnap), ring = solids::cylinder(24, 2, 1, solids::kDemoSnap);
  ContinuousDepth coaxial = tracker_of(ring, rod, 1);
  SolidDepth exact = SolidDepth::create(ring, rod).value();
  const ContinuousContact c = coaxial.query({}).value();
  EXPECT_EQ(coaxial.euclidean_squared(), exact.at({}).squared);
  EXPECT_EQ(c.meeting, Meeting::overlapping);
}

TEST(ContinuousDepth, follows_turns) {
  const Mesh p = mesh_of(box(2)), q = mesh_of(box(1));
  ContinuousDepth pair = tracker_of(p, q, 2);
  const Trace trace = along(pair, {2.5, 0.25, 0.5}, {2.75, 0.5, 0.25}, 60, {1, 2, 3}, 1.5);
  EXPECT_EQ(trace.overlapping, 61);
  EXPECT_EQ(trace.jumps, 0);
  EXPECT_LT(trace.turn, 0.1);
}

TEST(ContinuousDepth, turns_too_long_for_one_step_are_cut) {
  const Mesh p = mesh_of(box(2)), q = mesh_of(box(1));
  ContinuousDepth pair = tracker_of(p, q, 2);
  ASSERT_TRUE(pair.query({2.5, 0.25, 0.5}));
  const ContinuousContact c = pair.query({2.75, 1.5, 1}, Rotation::about({1, 2, 3}, 0.75).value()).value();
  EXPECT_EQ(c.discontinuity, Discontinuity::none);
  EXPECT_EQ(c.branch, 1U);
  EXPECT_GT(c.work.local_sums, 1U);
}

/// The features that are named hold the witnesses.
void expect_features_at_witnesses(const Mesh& p, const Mesh& q, const ContinuousContact& c, const Point3& at) {
  const auto holds = [](const Mesh& mesh, const SolidFeature& f, Vec3 w) {
    const auto vertex = [&](std::uint32_t v) { return vec(mesh.vertices()[v]); };
    if (f.kind == SolidFeature::Kind::vertex) return spatial::length(vertex(f.a) - w) < 1e-9;
    if (f.kind == SolidFeature::Kind::face)
      return depth::face_comes_within(depth::continuous_surface(mesh, 1), f.a, w, 1e-9);
    const Vec3 d = vertex(f.b) - vertex(f.a), to = w - vertex(f.a);
    const double s = std::clamp(spatial::dot(d, to) / spatial::dot(d, d), 0.0, 1.0);
    return spatial::length(to - s * d) < 1e-9;
  };
  EXPECT_TRUE(holds(p, c.contact.p, vec(c.witness_p)));
  EXPECT_TRUE(holds(q, c.contact.q, vec(c.witness_q) - vec(at)));
}

TEST(ContinuousDepth, names_the_features_at_the_witnesses_where_many_faces_lie_in_one_plane) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> position(-1, 1);
  const Mesh p = solids::tessellated_cube(8, 4), tip = solids::cone(5, 0.5, 1), cube = solids::tessellated_cube(2, 2);
  for (const Mesh* q : {&tip, &cube})
    for (const double l : {0.0, 1.0}) {
      ContinuousDepth pair = tracker_of(p, *q, l);
      for (int k = 0; k < 40; ++k) {
        const Point3 at{4 * position(random), 4 * position(random), 4 + 0.75 * position(random)};
        const ContinuousContact c = pair.query(at).value();
        if (c.meeting == Meeting::overlapping) expect_features_at_witnesses(p, *q, c, at);
      }
    }
}

TEST(ContinuousDepth, a_patch_answers_as_the_solids_do) {
  const Mesh p = mesh_of(ell()), q = mesh_of(box(1));
  ContinuousDepth pair = tracker_of(p, q, 2);
  const Point3 start{10.25, 2, 5};
  ASSERT_TRUE(pair.query(start));
  DepthPatch patch = pair.patch();
  for (int k = 1; k <= 20; ++k) {
    const Point3 at{start.x - 0.01 * k, start.y + 0.02 * k, start.z};
    ASSERT_TRUE(patch.covers(at));
    const ContinuousContact a = patch.at(at), b = pair.query(at).value();
    EXPECT_NEAR(a.depth, b.depth, 1e-12);
    EXPECT_LT(gap(a.normal, b.normal), 1e-11);
    EXPECT_EQ(a.branch, b.branch);
    EXPECT_EQ(b.work.local_sums, 0U);  // within the margin
  }
  EXPECT_FALSE(patch.covers({-5, 2, 5}));
  EXPECT_THROW(patch.at({std::nan(""), 0, 0}), std::invalid_argument);
}

ErrorCode refused(ContinuousDepthOptions options, const Mesh& p, const Mesh& q) {
  const Result<ContinuousDepth> made = ContinuousDepth::create(p, q, options);
  return made ? ErrorCode::cannot_open : made.error().code;
}

TEST(ContinuousDepth, refuses_what_it_cannot_answer) {
  const Mesh p = mesh_of(box(1));
  const auto with = [](auto set) {
    ContinuousDepthOptions options;
    set(options);
    return options;
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refused({}, p, Mesh()), ErrorCode::no_area);
  EXPECT_EQ(refused(with([](auto& o) { o.smoothing_length = -1; }), p, p), ErrorCode::out_of_range);
  EXPECT_EQ(refused(with([](auto& o) { o.smoothing_length = 0x1p-60; }), p, p), ErrorCode::out_of_range);
  EXPECT_EQ(refused(with([](auto& o) { o.smoothing_length = 1e6; }), p, p), ErrorCode::out_of_range);
  EXPECT_EQ(refused(with([=](auto& o) { o.smoothing_length = kNan; }), p, p), ErrorCode::not_finite);
  EXPECT_EQ(refused(with([](auto& o) { o.inflation = 0.5; }), p, p), ErrorCode::out_of_range);
  EXPECT_EQ(refused(with([](auto& o) { o.margin = -1; }), p, p), ErrorCode::out_of_range);
  EXPECT_EQ(refused(with([](auto& o) { o.halvings = 21; }), p, p), ErrorCode::out_of_range);
  EXPECT_EQ(refused(with([](auto& o) { o.threads = -1; }), p, p), ErrorCode::out_of_range);
  const Mesh sheet = Mesh::with_thin_parts({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}).value();
  EXPECT_EQ(refused({}, sheet, sheet), ErrorCode::unsupported_operand);
  EXPECT_EQ(refused(with([](auto& o) { o.progress = [](auto, double) { return false; }; }), p, p),
            ErrorCode::cancelled);
}

TEST(ContinuousDepth, after_an_error_the_next_answer_is_a_first_one) {
  bool stop = false;
  ContinuousDepthOptions options;
  options.progress = [&](std::string_view, double) { return !stop; };
  ContinuousDepth pair = ContinuousDepth::create(mesh_of(box(1)), mesh_of(box(1)), options).value();
  EXPECT_THROW(pair.euclidean_squared(), std::logic_error);
  EXPECT_THROW(pair.patch(), std::logic_error);
  EXPECT_EQ(pair.query({std::numeric_limits<double>::infinity(), 0, 0}).error().code, ErrorCode::not_finite);
  ASSERT_TRUE(pair.query({1.5, 0, 0}));
  stop = true;
  EXPECT_EQ(pair.query({1.5, 0, 0}, Rotation::about({0, 0, 1}, 0.3).value()).error().code, ErrorCode::cancelled);
  EXPECT_THROW(pair.patch(), std::logic_error);
  stop = false;
  EXPECT_EQ(pair.query({1.5, 0, 0}).value().discontinuity, Discontinuity::entered);
}

TEST(ContinuousDepth, sizes_far_from_one) {
  for (const double s : {0x1p-200, 0x1p-40, 0x1p40, 0x1p200}) {
    ContinuousDepth pair = tracker_of(mesh_of(box(s)), mesh_of(box(s)), s);
    const ContinuousContact c = pair.query({1.5 * s, 0.25 * s, 0}).value();
    EXPECT_NEAR(c.euclidean_depth / s, 0.5, 1e-14);
    EXPECT_TRUE(c.smoothed);
    EXPECT_NEAR(c.depth / s, 0.5, 0.1);
  }
}

}  // namespace
}  // namespace dymsum::test
