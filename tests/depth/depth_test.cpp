// Penetration depth against all facets of the sum, in exact arithmetic.
#include <filesystem>
#include <string>

#include "dymsum/mesh_io.h"
#include "exact/big.h"
#include "spatial/convex/convex_cases.h"

namespace dymsum::test {
namespace {

using exact::BigRational;

std::array<BigRational, 3> exact_point(const RationalPoint3& p) {
  return {exact::exact_value(p.x), exact::exact_value(p.y), exact::exact_value(p.z)};
}

/// The least signed squared distance to the plane of a facet, from the exact positions of the canonical sum.
BigRational least_signed_square(const SpatialSum& sum, Point3 x) {
  const std::array<BigRational, 3> at{exact::exact_value(x.x), exact::exact_value(x.y), exact::exact_value(x.z)};
  std::optional<BigRational> least;
  for (const SpatialFace& f : sum.faces) {
    const std::vector<std::uint32_t>& loop = f.loops[0];
    const auto a = exact_point(sum.exact(loop[0])), b = exact_point(sum.exact(loop[1])),
               c = exact_point(sum.exact(loop[2]));
    std::array<BigRational, 3> u, v, w;
    for (int k = 0; k < 3; ++k) {
      u[k] = b[k] - a[k];
      v[k] = c[k] - a[k];
      w[k] = a[k] - at[k];
    }
    const std::array<BigRational, 3> n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const BigRational d = n[0] * w[0] + n[1] * w[1] + n[2] * w[2], size = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
    const BigRational signed_square = (d < 0 ? -1 : 1) * d * d / size;
    if (!least || signed_square < *least) least = signed_square;
  }
  return *least;
}

TEST(ConvexDepth, cubes_have_the_depth_one_expects) {
  const ConvexDepth d = *penetration_depth(cube(1), cube(2), {}, {}, {2.5, 0.25, 0});
  EXPECT_TRUE(d.inside);
  EXPECT_EQ(d.depth, 0.5);
  EXPECT_EQ(d.depth_squared.to_string(), "1/4");
  EXPECT_EQ(d.direction, (Point3{1, 0, 0}));
  EXPECT_FALSE(penetration_depth(cube(1), cube(2), {}, {}, {3, 0, 0})->inside) << "touching is no penetration";
  EXPECT_FALSE(penetration_depth(cube(1), cube(2), {}, {}, {9, 0, 0})->inside);
  EXPECT_TRUE(penetration_depth(cube(1), cube(2), {}, {}, {3 - 0x1p-40, 0, 0})->inside);
}

TEST(ConvexDepth, equals_the_least_distance_to_all_facets) {
  std::mt19937_64 random(31);
  std::uniform_int_distribution<int> grid(-12, 12);
  for (int k = 0; k < 40; ++k) {
    const Mesh p = k % 2 ? random_grid_polytope(random, 8, 3) : random_round_polytope(random, 12);
    const Mesh q = k % 3 ? random_round_polytope(random, 9) : random_grid_polytope(random, 6, 2);
    ConvexSum sum = *ConvexSum::create(p, negated(q));
    SolidPose pose{random_rotation(random), {}};
    if (k % 4 == 0) pose.scale = {random_scale(random), random_scale(random), random_scale(random)};
    if (k % 5 == 0) pose.rotation = Rotation();
    sum.set(pose);
    const Point3 x{grid(random) / 8.0, grid(random) / 8.0, grid(random) / 8.0};
    const ConvexDepth depth = sum.depth(x);
    const BigRational truth = least_signed_square(sum.sum(), x);
    EXPECT_EQ(depth.inside, truth > 0);
    if (truth > 0) {
      EXPECT_EQ(exact::exact_value(depth.depth_squared), truth);
    }
  }
}

TEST(ConvexDepth, deep_in_a_sum_with_all_facets_equally_far) {
  // Ties in hundreds: the centre of a sum of a cube with itself, and of a sphere with its reflection.
  ConvexSum cubes = *ConvexSum::create(cube(1), cube(1));
  EXPECT_EQ(cubes.depth().depth_squared.to_string(), "4/1");
  const Mesh ball = solids::geodesic_sphere(2, 1, solids::kDemoSnap);
  ConvexSum balls = *ConvexSum::create(ball, negated(ball));
  EXPECT_EQ(exact::exact_value(balls.depth().depth_squared), least_signed_square(balls.sum(), {}));
}

TEST(ConvexDepth, where_doubles_cannot_tell_the_nearest) {
  // 1.5 along x, 2^-50 less along y; of the second box, the faces across y are larger than those across x.
  const double y = 1.25 - 0x1p-50;
  const auto box = [](double hx, double hy, double hz) { return free_box({-hx, -hy, -hz}, {hx, hy, hz}); };
  const Mesh p = box(1, y, 4), q = box(0.5, 0.25, 0.25);
  const BigRational least = exact::exact_value(1.5 - 0x1p-50);
  for (const bool swapped : {false, true}) {
    ConvexSum sum = *ConvexSum::create(swapped ? q : p, swapped ? p : q);
    EXPECT_EQ(exact::exact_value(sum.depth().depth_squared), least * least);
  }
}

TEST(ConvexDepth, of_solids_of_any_size) {
  // Hundreds of nearly equal distances. From 2^-511 on their squares are no ordinary doubles any more, at 2^200 the
  // grid's unit is above one.
  std::mt19937_64 random(33);
  const Mesh ball = solids::geodesic_sphere(2, 1, solids::kDemoSnap);
  for (int k = 0; k < 20; ++k) {
    const SolidPose pose{random_rotation(random), {}};
    std::uniform_int_distribution<int> offset(-64, 64);
    const Point3 x{0x1p-20 * offset(random), 0x1p-20 * offset(random), 0x1p-20 * offset(random)};
    const auto depth_squared = [&](int exponent) {
      const double unit = std::ldexp(1, exponent);
      MeshData data = ball.data();
      for (Point3& v : data.vertices) v = {unit * v.x, unit * v.y, unit * v.z};
      const Mesh sized = *Mesh::create(data);
      ConvexSum sum = *ConvexSum::create(sized, negated(sized));
      sum.set(pose);
      return exact::exact_value(sum.depth({unit * x.x, unit * x.y, unit * x.z}).depth_squared);
    };
    const BigRational one = depth_squared(0);
    for (const int exponent : {-536, -535, -533, -530, -525, -300, 200}) {
      const exact::BigInteger factor = exact::BigInteger(1) << static_cast<unsigned>(2 * std::abs(exponent));
      const BigRational sized = depth_squared(exponent);
      EXPECT_EQ(exponent < 0 ? BigRational(sized * factor) : BigRational(sized / factor), one) << k << " " << exponent;
    }
  }
}

Mesh sized_cube(double half) { return free_box({-half, -half, -half}, {half, half, half}); }

TEST(ConvexDepth, of_tiny_and_huge_cubes_is_right) {
  for (const double half : {1e-160, 1e-170, 1e-300, 3e-308, 4e-320, 5e-324, 1e150, 1e154, 1e155, 0x1p1000}) {
    const Mesh c = sized_cube(half);
    const Result<ConvexDepth> d = penetration_depth(c, c);
    ASSERT_TRUE(d) << half << ": " << d.error().to_string();
    EXPECT_TRUE(d->inside) << half;
    EXPECT_EQ(d->depth, 2 * half);
    const BigRational side = 2 * exact::exact_value(half);
    EXPECT_EQ(exact::exact_value(d->depth_squared), side * side) << half;
  }
  // Far smaller than the other one, and far away.
  const Mesh tiny = sized_cube(0x1p-1000), huge = sized_cube(0x1p1000);
  EXPECT_EQ(penetration_depth(tiny, huge)->depth, 0x1p1000);
  EXPECT_FALSE(penetration_depth(tiny, tiny, {}, {}, {0x1p1000, 0, 0})->inside);
  EXPECT_EQ(penetration_depth(huge, tiny, {}, {}, {0x1p1000, 0, 0})->depth, 0x1p-1000) << "the tiny one sits on a face";
}

/// `mesh` with coordinates of `bits` bits times 2^exponent, in general position; subnormal for exponents near -1074.
Mesh rough_solid(std::mt19937_64& random, int points, int bits, int exponent) {
  std::uniform_int_distribution<std::int64_t> grid(-(std::int64_t{1} << bits), std::int64_t{1} << bits);
  for (;;) {
    std::vector<Point3> at;
    const auto c = [&] { return std::ldexp(static_cast<double>(grid(random)), exponent); };
    for (int i = 0; i < points; ++i) at.push_back({c(), c(), c()});
    Result<Mesh> hull = convex_hull(at);
    if (hull) return std::move(hull).value();
  }
}

TEST(ConvexDepth, of_subnormal_huge_and_mixed_coordinates) {
  std::mt19937_64 random(34);
  struct Sizes {
    int bits, p, q;
  };
  const std::vector<Sizes> sizes{{4, -1074, -1074}, {20, -1074, -1074}, {40, -1074, -1070}, {52, -1074, -1050},
                                 {30, -600, -560},  {30, 960, 970},     {40, 400, 395},     {20, -1074, 900}};
  const std::vector<Scale> factors{Scale(), *Scale::parse("3/7"), *Scale::of(0x1p-64), *Scale::of(0x1p64)};
  for (int k = 0; k < 96; ++k) {
    const Sizes& s = sizes[static_cast<std::size_t>(k) % sizes.size()];
    const Mesh p = rough_solid(random, 5 + k % 4, s.bits, s.p), q = rough_solid(random, 5, s.bits, s.q);
    ConvexSum sum = *ConvexSum::create(p, negated(q));
    SolidPose pose;
    if (k % 3 > 0) pose.rotation = random_rotation(random);
    if (k % 4 == 3) pose.scale = {factors[k % 3], factors[(k / 3) % 4], factors[(k / 5) % 4]};
    sum.set(pose);
    std::uniform_int_distribution<std::int64_t> grid(-(std::int64_t{1} << s.bits), std::int64_t{1} << s.bits);
    const auto c = [&] { return std::ldexp(static_cast<double>(grid(random)), std::max(s.p, s.q) - k % 2); };
    const Point3 x{c(), c(), c()};
    const ConvexDepth depth = sum.depth(x);
    const BigRational truth = least_signed_square(sum.sum(), x);
    ASSERT_EQ(depth.inside, truth > 0) << "case " << k;
    if (truth > 0) {
      EXPECT_EQ(exact::exact_value(depth.depth_squared), truth) << "case " << k;
      // The square of the nearest double is nearest to the truth, up to half of the last place.
      const BigRational d = exact::exact_value(depth.depth),
                        up = exact::exact_value(std::nextafter(depth.depth, 1e308)),
                        down = exact::exact_value(std::nextafter(depth.depth, 0));
      EXPECT_LE((d + down) * (d + down), 4 * truth) << "case " << k;
      EXPECT_GE((d + up) * (d + up), 4 * truth) << "case " << k;
    } else {
      EXPECT_EQ(depth.depth, 0) << "case " << k;
    }
  }
}

TEST(ConvexDepth, the_direction_is_that_of_the_facet_where_edges_are_nearly_parallel) {
  // Two needles whose long edges differ by 2^-40: doubles lose the cross product of their directions, exact numbers do
  // not.
  const auto needle = [](double lean) {
    return *convex_hull(std::vector<Point3>{
        {-1, -lean, 0}, {1, lean, 0}, {-1, -lean, -0x1p-20}, {1, 0.25, -0x1p-20}, {1, -0.25, -0x1p-20}});
  };
  const ConvexDepth d = *penetration_depth(needle(0), negated(needle(0x1p-40)));
  ASSERT_TRUE(d.inside || d.depth == 0);
  const double size =
      std::sqrt(d.direction.x * d.direction.x + d.direction.y * d.direction.y + d.direction.z * d.direction.z);
  EXPECT_NEAR(size, 1, 1e-15);
}

TEST(ConvexDepth, points_that_are_no_places_are_refused) {
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(penetration_depth(cube(1), cube(1), {}, {}, {nan, 0, 0}).error().code, ErrorCode::not_finite);
  EXPECT_EQ(penetration_depth(cube(1), cube(1), {}, {}, {0, inf, 0}).error().code, ErrorCode::not_finite);
  const ConvexSum sum = *ConvexSum::create(cube(1), cube(1));
  EXPECT_THROW((void)sum.depth({0, 0, inf}), std::invalid_argument);
  EXPECT_THROW((void)sum.support({0, nan, 0}), std::invalid_argument);
}

// Where directions coincide it is a face and a face, or a face and an edge.
TEST(ConvexDepth, names_the_features_of_the_facet) {
  std::mt19937_64 random(33);
  const Mesh box = cube(1), ball = random_round_polytope(random, 30),
             fine = solids::tessellated_cube(2, 1, solids::kDemoSnap),
             cylinder = solids::cylinder(6, 1, 2, solids::kDemoSnap);
  std::set<std::pair<SolidFeature::Kind, SolidFeature::Kind>> kinds;
  for (const auto& [p, q] : std::vector<std::pair<Mesh, Mesh>>{
           {box, box}, {fine, box}, {box, fine}, {cylinder, box}, {box, cylinder}, {fine, ball}, {cylinder, cylinder}})
    for (const Rotation& turn : {Rotation(), *Rotation::of(4, 0, 0, 1), *Rotation::of(5, 1, 2, 1)})
      for (const Point3 at : {Point3{0.5, 0.125, 0.25}, Point3{}, Point3{0.125, -1, 0}, Point3{0, 0.25, 1}}) {
        ConvexSum sum = *ConvexSum::create(p, q);
        sum.set(turn);
        const ConvexDepth depth = sum.depth(at);
        const SpatialSum whole = sum.sum();
        EXPECT_TRUE(std::any_of(whole.faces.begin(), whole.faces.end(),
                                [&](const SpatialFace& f) { return f.p == depth.p && f.q == depth.q; }));
        kinds.insert({depth.p.kind, depth.q.kind});
      }
  EXPECT_GE(kinds.size(), 4u);
}

TEST(ConvexDepth, of_every_hard_case_of_the_corpus) {
  std::size_t found = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(DYMSUM_CORPUS_DIR) + "/convex")) {
    const std::string name = entry.path().filename().string();
    const Mesh mesh = *Mesh::create(*read_mesh(entry.path().string()));
    const ConvexSum sum = *ConvexSum::create(mesh, negated(mesh));
    const SpatialSum whole = sum.sum();
    const ConvexDepth depth = sum.depth();
    EXPECT_TRUE(depth.inside) << name;
    EXPECT_EQ(exact::exact_value(depth.depth_squared), least_signed_square(whole, {})) << name;
    EXPECT_EQ(depth.depth, exact::root_to_double(exact::exact_value(depth.depth_squared))) << name;
    EXPECT_EQ(sum.facet_count().all, whole.faces.size()) << name;
    EXPECT_NEAR(sum.volume(), whole.volume(), 1e-12 * whole.volume()) << name;
    ++found;
  }
  EXPECT_GE(found, 5u);
}

TEST(PoseBatch, options_out_of_range_are_errors) {
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  const std::vector<Rotation> poses{Rotation()};
  for (const double bad : {nan, inf, -inf}) {
    BatchOptions point, direction;
    point.depth_point.y = bad;
    direction.support_direction.z = bad;
    for (const BatchOptions& options : {point, direction}) {
      const auto reports = pose_batch(cube(1), cube(1), poses, options);
      ASSERT_FALSE(reports.ok());
      EXPECT_EQ(reports.error().code, ErrorCode::not_finite);
    }
  }
  BatchOptions threads;
  threads.threads = -1;
  EXPECT_EQ(pose_batch(cube(1), cube(1), poses, threads).error().code, ErrorCode::out_of_range);
}

TEST(PoseBatch, reports_what_single_sums_say_in_the_order_given) {
  std::mt19937_64 random(32);
  const Mesh p = random_round_polytope(random, 60), q = random_round_polytope(random, 40);
  std::vector<Rotation> poses;
  for (int k = 0; k < 40; ++k) poses.push_back(random_rotation(random));
  for (const int threads : {1, 2, 5}) {
    BatchOptions options;
    options.threads = threads;
    options.depth_point = {0.1, 0.2, -0.1};
    options.support_direction = {1, -1, 2};
    const std::vector<PoseReport> reports = *pose_batch(p, q, poses, options);
    ASSERT_EQ(reports.size(), poses.size());
    for (std::size_t k = 0; k < poses.size(); ++k) {
      ConvexSum one = *ConvexSum::create(p, q);
      one.set(poses[k]);
      EXPECT_EQ(reports[k].facets, one.sum().faces.size());
      EXPECT_EQ(reports[k].volume, one.volume());
      EXPECT_EQ(reports[k].support, one.support({1, -1, 2}).at);
      EXPECT_EQ(reports[k].depth.depth_squared, one.depth({0.1, 0.2, -0.1}).depth_squared);
    }
  }
  BatchOptions stop;
  stop.progress = [](std::string_view, double done) { return done < 0.5; };
  EXPECT_EQ(pose_batch(p, q, poses, stop).error().code, ErrorCode::cancelled);
  EXPECT_TRUE(pose_batch(p, q, {}, {})->empty());
}

}  // namespace
}  // namespace dymsum::test
