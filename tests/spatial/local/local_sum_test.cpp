// Local sums: the whole sum cut, whatever way they are found, in boxes and balls at random and critical positions,
// moving.
#include "dymsum/local_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include "oracles/coordinate_kinds.h"

#include "dymsum/moving_solid_sum.h"
#include "spatial/convex/setting.h"
#include "spatial/local/clipped_chains.h"
#include "spatial/moving/moving_cases.h"

namespace dymsum {
namespace {

using moving_cases::mesh_of;
using Where = LocalPart::Where;

LocalSum local_sum(const Mesh& p, const Mesh& q, LocalEngine engine = LocalEngine::updated) {
  LocalOptions options;
  options.engine = engine;
  return LocalSum::create(p, q, options).value();
}

/// Boxes about places of a sum: some end exactly at its vertices, some anywhere.
class Boxes {
 public:
  Boxes(const SpatialSum& sum, std::uint64_t seed) : sum_(sum), random_(seed) {}

  ClipBox next() {
    const auto coordinate = [&](double Point3::*axis) {
      double a = some(axis), b = some(axis);
      if (a == b) b = a + 1;
      return std::pair{std::min(a, b), std::max(a, b)};
    };
    const auto [x0, x1] = coordinate(&Point3::x);
    const auto [y0, y1] = coordinate(&Point3::y);
    const auto [z0, z1] = coordinate(&Point3::z);
    return {{x0, y0, z0}, {x1, y1, z1}};
  }
  ClipBall ball() {
    const Point3 m = sum_.vertices[random_() % sum_.vertices.size()];
    const auto off = [&] { return static_cast<double>(random_() % 5) / 2 - 1; };
    return {{m.x + off(), m.y + off(), m.z + off()}, static_cast<double>(1 + random_() % 8) / 4};
  }

 private:
  double some(double Point3::*axis) {
    const double v = sum_.vertices[random_() % sum_.vertices.size()].*axis;
    return random_() % 2 ? v : v + static_cast<double>(random_() % 9) / 4 - 1;
  }
  const SpatialSum& sum_;
  std::mt19937_64 random_;
};

/// Edges with one face lie in walls of the box: nothing ends within it.
bool ends_at_walls(const LocalPart& part) {
  const clipped_chains::Walls walls(part.box);
  const std::vector<SpatialEdge> edges = part.boundary.edges();
  return std::all_of(edges.begin(), edges.end(), [&](const SpatialEdge& edge) {
    if (edge.faces.size() > 1) return true;
    const auto a = clipped_chains::exact_position(part.boundary, edge.from),
               b = clipped_chains::exact_position(part.boundary, edge.to);
    for (std::size_t k = 0; k < 3; ++k)
      if (a[k] == b[k] && (a[k] == walls.low[k] || a[k] == walls.high[k])) return true;
    return false;
  });
}

class LocalSums {
 public:
  LocalSums(const Mesh& p, const Mesh& q)
      : p_(p),
        q_(q),
        updated_(local_sum(p, q)),
        hierarchy_(local_sum(p, q, LocalEngine::hierarchy)),
        brute_(local_sum(p, q, LocalEngine::brute)) {}

  /// All engines at a position; the first result. `whole` is the sum at the poses.
  LocalPart agreed(const ClipBox& box, const SpatialSum& whole, const spatial::PosePair& poses = {},
                   bool with_brute = true) {
    LocalPart part = updated_.in(box, poses.p, poses.q).value();
    EXPECT_TRUE(part == hierarchy_.in(box, poses.p, poses.q).value()) << "hierarchy";
    if (with_brute) {
      EXPECT_TRUE(part == brute_.in(box, poses.p, poses.q).value()) << "brute";
    }
    EXPECT_TRUE(clipped_chains::shape_of(part.boundary) == clipped_chains::cut(whole, box)) << "cut";
    EXPECT_TRUE(ends_at_walls(part)) << "ends";
    if (part.where != Where::crossed && poses == spatial::PosePair{}) {
      const Point3 centre{(box.low.x + box.high.x) / 2, (box.low.y + box.high.y) / 2, (box.low.z + box.high.z) / 2};
      EXPECT_EQ(part.where == Where::inside, contains(p_, q_, centre, Semantics::open).value());
    }
    EXPECT_EQ(part.where == Where::crossed, !part.boundary.vertices.empty());
    return part;
  }
  LocalPart in(const ClipBall& ball, const spatial::PosePair& poses) {
    LocalPart part = updated_.in(ball, poses.p, poses.q).value();
    EXPECT_TRUE(part == brute_.in(ball, poses.p, poses.q).value());
    return part;
  }

 private:
  Mesh p_, q_;
  LocalSum updated_, hierarchy_, brute_;
};

std::string text(const ClipBox& b) {
  return ::testing::PrintToString(std::array{b.low.x, b.low.y, b.low.z, b.high.x, b.high.y, b.high.z});
}

TEST(LocalSum, is_the_whole_sum_cut_in_boxes_at_random_and_critical_places) {
  const std::uint64_t boxes = test::setting("DYMSUM_FUZZ_BOXES", 12);
  std::size_t crossed = 0, inside = 0;
  for (const auto& [name, p, q] : moving_cases::small_pairs()) {
    const SpatialSum whole = minkowski_sum(p, q).value();
    LocalSums sums(p, q);
    Boxes positions(whole, 11);
    for (std::uint64_t k = 0; k < boxes; ++k) {
      const ClipBox box = positions.next();
      const LocalPart part = sums.agreed(box, whole, {}, k % 4 == 0);
      crossed += part.where == Where::crossed, inside += part.where == Where::inside;
      ASSERT_FALSE(HasFailure()) << name << " in " << text(box);
    }
  }
  EXPECT_GT(crossed, 13 * boxes / 2);
  EXPECT_GT(inside, 0U);
}

TEST(LocalSum, of_random_solids_of_tiny_grids) {
  const std::uint64_t pairs = test::setting("DYMSUM_FUZZ_PAIRS", 12);
  std::mt19937_64 random(test::setting("DYMSUM_FUZZ_SEED", 3));
  for (std::uint64_t k = 0; k < pairs; ++k) {
    const Mesh p = random_solids::valid_polyhedron(random), q = random_solids::valid_polyhedron(random);
    const SpatialSum whole = minkowski_sum(p, q).value();
    LocalSums sums(p, q);
    Boxes positions(whole, k);
    for (int i = 0; i < 6; ++i) {
      const ClipBox box = positions.next();
      sums.agreed(box, whole, {}, i == 0);
      ASSERT_FALSE(HasFailure()) << "pair " << k << " in " << text(box);
    }
  }
}

TEST(LocalSum, of_coordinates_of_every_kind) {
  std::mt19937_64 random(7313);
  for (const CoordinateKind kind : kCoordinateKinds) {
    int compared = 0;
    for (int k = 0; k < 4; ++k) {
      const Result<Mesh> p = Mesh::create(of_kind(random_solids::tiny_polyhedron(random), kind, random)),
                         q = Mesh::create(of_kind(random_solids::tiny_polyhedron(random), kind, random));
      if (!p.ok() || !q.ok()) continue;
      const SpatialSum whole = minkowski_sum(*p, *q).value();
      LocalSums sums(*p, *q);
      Boxes positions(whole, static_cast<std::uint64_t>(k));
      for (int i = 0; i < 4; ++i, ++compared) {
        const ClipBox box = positions.next();
        sums.agreed(box, whole, {}, i == 0);
        ASSERT_FALSE(HasFailure()) << name_of(kind) << ", pair " << k << " in " << text(box);
      }
    }
    EXPECT_GT(compared, 0) << name_of(kind);
  }
}

TEST(LocalSum, follows_boxes_and_poses) {
  const std::uint64_t moves = test::setting("DYMSUM_FUZZ_MOVES", 26) / 13;
  for (const auto& [name, p, q] : moving_cases::small_pairs()) {
    LocalSums sums(p, q);
    moving_cases::Moves motion(23);
    spatial::PosePair poses;
    for (std::uint64_t k = 0; k < moves; ++k) {
      poses = motion.next(poses);
      const SpatialSum whole = posed_sum(p, q, poses.p, poses.q).value();
      Boxes positions(whole, k);
      const ClipBox box = positions.next();
      sums.agreed(box, whole, poses, k % 3 == 0);
      sums.in(positions.ball(), poses);
      ASSERT_FALSE(HasFailure()) << name << ", move " << k << " in " << text(box);
    }
  }
}

TEST(LocalSum, tight_features_at_walls_are_those_of_the_whole_sum) {
  const Mesh block = mesh_of(tunnel()), peg = mesh_of(box(1)), hollow = mesh_of(cavity());
  const SpatialSum line = minkowski_sum(block, peg).value(), point = minkowski_sum(hollow, peg).value();
  ASSERT_EQ(line.tight_segments.size(), 1U);
  LocalSums along(block, peg), about(hollow, peg);
  // The segment runs along the x axis; walls contain it, end it, or touch it.
  EXPECT_EQ(along.agreed({{-1, 0, -1}, {1, 1, 1}}, line).boundary.tight_segments.size(), 1U);
  EXPECT_EQ(along.agreed({{-1, 0, 0}, {1, 1, 1}}, line).boundary.tight_segments.size(), 1U);
  EXPECT_EQ(along.agreed({{-20, -1, -1}, {-5, 1, 1}}, line).boundary.tight_segments.size(), 1U);
  EXPECT_TRUE(along.agreed({{-20, -1, -1}, {-6, 1, 1}}, line).boundary.tight_segments.empty());
  EXPECT_EQ(along.agreed({{0.25, -1, -1}, {0.5, 1, 1}}, line).boundary.tight_segments.size(), 1U);
  ASSERT_EQ(point.tight_points.size(), 1U);
  EXPECT_EQ(about.agreed({{0, 0, 0}, {1, 1, 1}}, point).boundary.tight_points.size(), 1U);
  EXPECT_EQ(about.agreed({{-1, -1, -1}, {1, 1, 1}}, point).boundary.tight_points.size(), 1U);
  EXPECT_EQ(about.agreed({{0.5, 0, 0}, {1, 1, 1}}, point).where, Where::inside);
  std::mt19937_64 random(7);
  const auto below = [&](int n) { return static_cast<double>(random() % static_cast<std::uint64_t>(n)) / 2; };
  const Mesh plate = mesh_of([] {
    MeshData m = box(1);
    for (Point3& v : m.vertices) v = {v.x * 4, v.y, v.z / 2};
    return m;
  }());
  const SpatialSum sheet = minkowski_sum(block, plate).value();  // as wide as the tunnel, and half as high
  ASSERT_FALSE(sheet.tight_faces.empty());
  LocalSums within(block, plate);
  for (int k = 0; k < 20; ++k) {
    const ClipBox position{{-below(12), -below(4), -below(4)}, {below(12) + 0.5, below(4) + 0.5, below(4) + 0.5}};
    along.agreed(position, line, {}, k % 4 == 0);
    about.agreed(position, point, {}, k % 4 == 0);
    EXPECT_FALSE(within.agreed(position, sheet, {}, k % 4 == 0).boundary.tight_faces.empty());
  }
}

TEST(LocalSum, faces_in_a_wall_count_and_what_only_touches_does_not) {
  const Mesh cube = mesh_of(box(1));
  const SpatialSum whole = minkowski_sum(cube, cube).value();  // [-2, 2]^3
  LocalSums sums(cube, cube);
  EXPECT_EQ(sums.agreed({{-1, -1, 0}, {1, 1, 2}}, whole).boundary.faces.size(), 1U);
  EXPECT_EQ(sums.agreed({{-1, -1, 2}, {1, 1, 3}}, whole).boundary.faces.size(), 1U);
  EXPECT_EQ(sums.agreed({{-2, -2, -2}, {2, 2, 2}}, whole).boundary.faces.size(), 6U);
  EXPECT_EQ(sums.agreed({{2, 2, 2}, {3, 3, 3}}, whole).where, Where::outside);
  EXPECT_EQ(sums.agreed({{-1, -1, -1}, {1, 1, 1}}, whole).where, Where::inside);
  EXPECT_EQ(sums.agreed({{-1e300, -1e300, -1e300}, {1e300, 1e300, 1e300}}, whole).boundary.faces.size(), 6U);
  EXPECT_EQ(sums.agreed({{0x1p60, 0, 0}, {0x1p61, 1, 1}}, whole).where, Where::outside);
  EXPECT_EQ(sums.agreed({{0, 0, 1}, {0x1p-200, 0x1p-40, 3}}, whole).boundary.faces.size(), 1U);
}

TEST(LocalSum, a_ball_takes_the_faces_that_it_meets_exactly) {
  const Mesh cube = mesh_of(box(1));
  LocalSum sum = local_sum(cube, cube);
  EXPECT_EQ(sum.in(ClipBall{{0, 0, 3}, 1})->boundary.faces.size(), 1U) << "touches the face";
  EXPECT_EQ(sum.in(ClipBall{{0, 0, 3}, 0x1.fffffffffffffp-1})->where, Where::outside);
  EXPECT_EQ(sum.in(ClipBall{{0, 0, 0}, 2})->boundary.faces.size(), 6U);
  EXPECT_EQ(sum.in(ClipBall{{0, 0, 0}, 0x1.fffffffffffffp0})->where, Where::inside);
  EXPECT_EQ(sum.in(ClipBall{{5, 6, 0}, 5})->boundary.faces.size(), 2U) << "touches the edge x = 2, y = 2";
  EXPECT_EQ(sum.in(ClipBall{{5, 6, 0}, 0x1.3ffffffffffffp2})->where, Where::outside) << "its box does not";
  EXPECT_EQ(sum.in(ClipBall{{4, 4, 3}, 3})->boundary.faces.size(), 3U) << "touches a vertex";
  EXPECT_EQ(sum.in(ClipBall{{4, 4, 3}, 0x1.7ffffffffffffp1})->where, Where::outside);
  const LocalPart part = sum.in(ClipBall{{2, 0, 0}, 0.5}).value();
  EXPECT_EQ(part.box, (ClipBox{{1.5, -0.5, -0.5}, {2.5, 0.5, 0.5}}));
  ASSERT_EQ(part.boundary.faces.size(), 1U);
  EXPECT_EQ(part.boundary.vertices.size(), 4U);
  const ClipBox rounded = bounding_box({{0.1, 0, 0}, 0.7});
  EXPECT_LT(rounded.low.x, 0.1 - 0.7 + 1e-16);
  EXPECT_GE(rounded.high.x, 0.1 + 0.7);
}

TEST(LocalSum, balls_of_sizes_whose_squares_are_no_doubles) {
  for (const int k : {-1000, -700, -545, -538, -260, -200, 0, 200, 256, 300, 400, 515, 1000}) {
    SCOPED_TRACE(k);
    MeshData data = box(1);
    for (Point3& v : data.vertices) v = {std::ldexp(v.x, k), std::ldexp(v.y, k), std::ldexp(v.z, k)};
    const Mesh cube = mesh_of(data);
    LocalSum sum = local_sum(cube, cube);
    const auto ball = [&](double x, double y, double z, double r) {
      return ClipBall{{std::ldexp(x, k), std::ldexp(y, k), std::ldexp(z, k)}, std::ldexp(r, k)};
    };
    EXPECT_EQ(sum.in(ball(0, 0, 0, 2.5))->boundary.faces.size(), 6U);
    EXPECT_EQ(sum.in(ball(3, 3, 0, 1.4))->where, Where::outside) << "the edge is 1.41 away";
    EXPECT_EQ(sum.in(ball(3, 3, 3, 1.7))->where, Where::outside) << "the corner is 1.73 away";
    EXPECT_EQ(sum.in(ball(5, 6, 0, 5))->boundary.faces.size(), 2U) << "touches the edge";
  }
  const Mesh cube = mesh_of(box(1));
  LocalSum sum = local_sum(cube, cube);
  for (const double r : {3., 1e10, 1e150, 1e155, 1e300})
    EXPECT_EQ(sum.in(ClipBall{{r, 0, 0}, r})->boundary.faces.size(), 5U) << r;
  EXPECT_EQ(sum.in(ClipBall{{-1e300, 0, 0}, 1.5e300})->boundary.faces.size(), 6U);
}

TEST(LocalSum, errors) {
  const Mesh cube = mesh_of(box(1));
  LocalSum sum = local_sum(cube, cube);
  EXPECT_EQ(sum.in(ClipBox{{0, 0, 0}, {1, 0, 1}}).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(sum.in(ClipBox{{0, 0, 0}, {1, HUGE_VAL, 1}}).error().code, ErrorCode::not_finite);
  EXPECT_EQ(sum.in(ClipBall{{0, 0, 0}, 0}).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(sum.in(ClipBall{{0, NAN, 0}, 1}).error().code, ErrorCode::not_finite);
  EXPECT_TRUE(sum.in(ClipBox{{0, 0, 0}, {0x1p-900, 0x1p-900, 1}}).ok()) << "heights of 900 bits";
  EXPECT_EQ(sum.in(ClipBox{{0, 0, 0}, {3, 3, 3}})->boundary.faces.size(), 3U) << "and goes on";
  LocalOptions options;
  options.threads = -1;
  EXPECT_EQ(LocalSum::create(cube, cube, options).error().code, ErrorCode::out_of_range);
  options.threads = 1, options.progress = [](std::string_view stage, double) { return stage != "arrangement"; };
  LocalSum stopped = LocalSum::create(cube, cube, options).value();
  EXPECT_EQ(stopped.in(ClipBox{{0, 0, 0}, {3, 3, 3}}).error().code, ErrorCode::cancelled);
  EXPECT_EQ(local_sum(cube, Mesh()).in(ClipBox{{0, 0, 0}, {3, 3, 3}})->where, Where::outside);
}

}  // namespace
}  // namespace dymsum
