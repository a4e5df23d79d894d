// Operands whose rings touch themselves or each other: vertices that several walks visit, and edges that are cut there.
#include "cspace/obstacle/obstacle_slices.h"

namespace dymsum {
namespace {

using namespace testing_obstacles;

Region region(std::vector<Part> parts) {
  RegionData data;
  data.parts = std::move(parts);
  return *Region::create(std::move(data));
}

Region two_squares() { return region({{box(0, 0, 2, 2), {}}, {box(2, 2, 5, 5), {}}}); }
// The hole's lower vertex lies on the lower edge.
Region hole_at_an_edge() { return region({{box(0, 0, 8, 8), {{{4, 0}, {1, 4}, {4, 7}, {6, 4}}}}}); }
// One ring through (0, 0) twice: two triangles tip to tip.
Region figure_of_eight() { return region({{{{0, 0}, {3, -2}, {3, 2}}, {}}, {{{0, 0}, {-3, 1}, {-2, -2}}, {}}}); }
// A ring that comes back to a vertex of itself: a room with a door of no width.
Region closed_room() {
  return region({{{{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 5}, {2, 8}, {8, 8}, {8, 2}, {2, 2}, {0, 5}}, {}}});
}

void expect_all_slices(const Region& robot, const Region& obstacle) {
  const Result<CspaceObstacle> c = CspaceObstacle::create(robot, obstacle);
  ASSERT_TRUE(c.ok()) << c.error().message;
  Random random(1);
  expect_slices(*c, random, 1000);
  ObstacleOptions options;
  options.reference = true;
  const CspaceObstacle slow = CspaceObstacle::create(robot, obstacle, options).value();
  EXPECT_EQ(c->shells().size(), slow.shells().size());
  EXPECT_EQ(free_components(*c), free_components(slow));
}

TEST(CspaceTouching, hand_made_operands_equal_slices) {
  const std::vector<Region> shapes{two_squares(), hole_at_an_edge(), figure_of_eight(), closed_room()};
  for (const Region& shape : shapes) ASSERT_FALSE(shape.touching_points().empty());
  const Region small = polygon({{0, 0}, {1, 0.25}, {0.25, 0.5}}), square = polygon(box(0, 0, 1, 1));
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    SCOPED_TRACE(testing::Message() << "shape " << k);
    expect_all_slices(small, shapes[k]);
    expect_all_slices(square, shapes[k]);
    expect_all_slices(shapes[k], square);
    expect_all_slices(shapes[k], shapes[(k + 1) % shapes.size()]);
  }
}

// The hole that touches an edge is a room with walls all round: free space in it does not get out.
TEST(CspaceTouching, a_hole_at_an_edge_is_a_room_of_its_own) {
  const CspaceObstacle c = CspaceObstacle::create(polygon(box(-0.25, -0.25, 0.25, 0.25)), hole_at_an_edge()).value();
  EXPECT_EQ(c.shells().size(), 2u);
  EXPECT_EQ(free_components(c), 2u);
}

// Where patches begin and end: on the edges that slices have, also where an edge is cut.
TEST(CspaceTouching, ends_of_patches_are_vertices_of_slices) {
  for (const Region& obstacle : {two_squares(), hole_at_an_edge(), closed_room()}) {
    const CspaceObstacle c = CspaceObstacle::create(polygon({{0, 0}, {1, 0.25}, {0.25, 0.5}}), obstacle).value();
    for (std::uint32_t slab = 0; slab < slabs(c); slab += 5) {
      const Orientation at = c.inside(slab);
      const PlanarSum sum = *c.slice(at);
      std::vector<Point> vertices;
      for (const SumPart& part : sum.parts) {
        for (const SumVertex& v : part.outer.vertices) vertices.push_back(v.at);
        for (const SumRing& hole : part.holes)
          for (const SumVertex& v : hole.vertices) vertices.push_back(v.at);
      }
      for (const auto& loop : c.loops(slab))
        for (const std::uint32_t p : loop)
          for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
            const Patch& patch = c.patches()[p];
            if (k == 0 ? patch.left_corner && in_line(c, patch.left, patch.contact)
                       : patch.right_corner && in_line(c, patch.contact, patch.right))
              continue;
            const Point end = c.ends(patch, at.radians())[k];
            EXPECT_TRUE(std::any_of(vertices.begin(), vertices.end(),
                                    [&](Point v) { return std::hypot(v.x - end.x, v.y - end.y) < 1e-9; }))
                << "slab " << slab << " patch " << p << " at " << end.x << ' ' << end.y;
          }
    }
  }
}

// Triangles with a common vertex, on a small grid; often several at one, and vertices on edges.
Region random_touching(Random& random, int reach) {
  for (;;) {
    const auto at = [&] {
      return static_cast<double>(static_cast<int>(random() % static_cast<unsigned>(2 * reach + 1)) - reach);
    };
    const auto point = [&] { return Point{at(), at()}; };
    RegionData data;
    const Point z = point();
    const int parts = 2 + static_cast<int>(random() % 2);
    for (int k = 0; k < parts; ++k) data.parts.push_back({{z, point(), point()}, {}});
    if (random() % 2 == 0) data.parts[0].outer.push_back(point());
    if (random() % 3 == 0) data.parts.push_back({{point(), point(), point()}, {}});
    for (Part& part : data.parts) {
      double twice = 0;
      for (std::size_t i = 0; i < part.outer.size(); ++i) {
        const Point a = part.outer[i], b = part.outer[(i + 1) % part.outer.size()];
        twice += a.x * b.y - a.y * b.x;
      }
      if (twice < 0) std::reverse(part.outer.begin(), part.outer.end());
    }
    if (random() % 3 == 0) {
      RegionData room;
      room.parts.push_back({box(-4.0 * reach, -4.0 * reach, 4.0 * reach, 4.0 * reach), {}});
      for (const Part& part : data.parts) room.parts[0].holes.push_back(reversed(part.outer));
      data = room;
    }
    Result<Region> made = Region::create(std::move(data));
    if (made.ok() && !made->touching_points().empty()) return *made;
  }
}

TEST(CspaceTouching, random_pairs_equal_slices) {
  for_seeds(60, [](Random& random) {
    const Region robot = random() % 3 == 0 ? random_touching(random, 4) : random_shape(random, 3, 5, false),
                 obstacle = random_touching(random, 6);
    const Result<CspaceObstacle> c = CspaceObstacle::create(robot, obstacle);
    ASSERT_TRUE(c.ok()) << c.error().message;
    expect_slices(*c, random, 100);
  });
}

TEST(CspaceTouching, random_pairs_equal_the_obstacle_by_whole_slices) {
  for_seeds(10, [](Random& random) {
    const Region robot = random_shape(random, 3, 4, false), obstacle = random_touching(random, 6);
    const CspaceObstacle fast = CspaceObstacle::create(robot, obstacle).value();
    ObstacleOptions options;
    options.reference = true;
    const CspaceObstacle slow = CspaceObstacle::create(robot, obstacle, options).value();
    EXPECT_EQ(fast.shells().size(), slow.shells().size());
    EXPECT_EQ(free_components(fast), free_components(slow));
  });
}

// Squares of a board that touch at corners: everything in line, and most events at quarter turns.
TEST(CspaceTouching, boards_equal_slices) {
  for_seeds(40, [](Random& random) {
    const Region robot = random() % 2 == 0 ? random_board(random, 3, 1) : random_cells(random, 2, 1),
                 obstacle = random_board(random, 4, 1 + static_cast<double>(random() % 3) / 2);
    expect_slices(CspaceObstacle::create(robot, obstacle).value(), random, 60);
  });
}

}  // namespace
}  // namespace dymsum
