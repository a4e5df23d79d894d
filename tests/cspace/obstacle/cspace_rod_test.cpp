// Robots without area: a segment, the rod that is moved round a corner, and a point. Against static slices, membership
// by definition and known lengths.
#include "cspace/obstacle/obstacle_slices.h"
#include "dymsum/motion.h"
#include "dymsum/obstacle_file.h"
#include "dymsum/planner.h"

namespace dymsum {
namespace {

using namespace testing_obstacles;

Region segment(Point a, Point b) {
  RegionData data;
  data.polylines.push_back({a, b});
  return *Region::create(std::move(data));
}
Region point(Point a) {
  RegionData data;
  data.points.push_back(a);
  return *Region::create(std::move(data));
}
double grid(Random& random, int reach) {
  return static_cast<double>(static_cast<int>(random() % static_cast<unsigned>(2 * reach + 1)) - reach);
}
Region random_segment(Random& random, int reach) {
  for (;;) {
    const Point a{grid(random, reach), grid(random, reach)}, b{grid(random, reach), grid(random, reach)};
    if (a != b) return segment(a, b);
  }
}
Region random_obstacle(Random& random) {
  switch (random() % 4) {
    case 0:
      return random_cells(random, 3, 1);
    case 1:
      return random_shape(random, 4, 6, true);
    case 2:
      return random_shape(random, 3, 4, false, 2);
    default:
      return random_shape(random, 3, 7, false);
  }
}

// Positions on a grid, many on the boundary, against the open slice by the static engine.
void expect_membership(const CspaceObstacle& c, Random& random) {
  for (int k = 0; k < 12; ++k) {
    const Orientation at =
        random() % 3 == 0 ? *Orientation::of(static_cast<int>(random() % 5) - 2, 1 + static_cast<int>(random() % 3))
                          : c.inside(static_cast<std::uint32_t>(random() % slabs(c)));
    const double x = grid(random, 12) / 2, y = grid(random, 12) / 2;
    const Result<TranslationCheck> still = check_translation(c.robot(), c.obstacle(), Point{x, y}, Point{x, y}, at);
    ASSERT_TRUE(still.ok());
    EXPECT_EQ(c.contains(x, y, at), !still->free) << x << ' ' << y << ' ' << at.radians();
  }
}

TEST(CspaceRod, random_segments_equal_slices) {
  for_seeds(120, [](Random& random) {
    const Region robot = random_segment(random, 3), obstacle = random_obstacle(random);
    const Result<CspaceObstacle> c = CspaceObstacle::create(robot, obstacle);
    ASSERT_TRUE(c.ok()) << c.error().message;
    expect_slices(*c, random, 60);
    expect_membership(*c, random);
  });
}

TEST(CspaceRod, random_segments_equal_the_obstacle_by_whole_slices) {
  for_seeds(40, [](Random& random) {
    const Region robot = random_segment(random, 3), obstacle = random_obstacle(random);
    const CspaceObstacle fast = CspaceObstacle::create(robot, obstacle).value();
    ObstacleOptions options;
    options.reference = true;
    const CspaceObstacle slow = CspaceObstacle::create(robot, obstacle, options).value();
    EXPECT_EQ(fast.shells().size(), slow.shells().size())
        << format_region(robot, RegionFormat::wkt) << format_region(obstacle, RegionFormat::wkt);
    EXPECT_EQ(free_components(fast), free_components(slow))
        << format_region(robot, RegionFormat::wkt) << format_region(obstacle, RegionFormat::wkt);
    EXPECT_EQ(fast.tight().size(), slow.tight().size())
        << format_region(robot, RegionFormat::wkt) << format_region(obstacle, RegionFormat::wkt);
  });
}

// Where patches begin and end: at vertices of slices, whichever way the rod's edge is walked.
TEST(CspaceRod, ends_of_patches_are_vertices_of_slices) {
  for_seeds(20, [](Random& random) {
    const CspaceObstacle c =
        CspaceObstacle::create(random_segment(random, 3), random_shape(random, 4, 6, true)).value();
    for (std::uint32_t slab = 0; slab < slabs(c); slab += 3) {
      const Orientation at = c.inside(slab);
      const PlanarSum sum = *c.slice(at);
      std::vector<Point> vertices;
      const auto add = [&](const SumRing& ring) {
        for (const SumVertex& v : ring.vertices) vertices.push_back(v.at);
      };
      for (const SumPart& part : sum.parts) {
        add(part.outer);
        for (const SumRing& hole : part.holes) add(hole);
      }
      for (const auto& loop : c.loops(slab))
        for (const std::uint32_t p : loop)
          for (const Point end : c.ends(c.patches()[p], at.radians()))
            EXPECT_TRUE(std::any_of(vertices.begin(), vertices.end(),
                                    [&](Point v) { return std::hypot(v.x - end.x, v.y - end.y) < 1e-8; }))
                << "slab " << slab << " patch " << p << " at " << end.x << ' ' << end.y;
    }
  });
}

// The slices of a point are the obstacle itself, moved: nothing happens at any angle.
TEST(CspaceRod, a_point_is_the_obstacle_moved_along_a_circle) {
  for_seeds(40, [](Random& random) {
    const Point r{grid(random, 2), grid(random, 2)};
    const Region obstacle = random() % 4 == 0 ? random_board(random, 3, 2) : random_obstacle(random);
    const Result<CspaceObstacle> c = CspaceObstacle::create(point(r), obstacle);
    ASSERT_TRUE(c.ok()) << c.error().message;
    EXPECT_TRUE(c->angles().empty());
    for (const Patch& p : c->patches()) EXPECT_FALSE(p.rotating());
    EXPECT_EQ(of_slab(*c, 0), of_slice(*c->slice(Orientation()))) << format_region(obstacle, RegionFormat::wkt);
    EXPECT_EQ(of_slab(*c, 0),
              of_slice(*c->slice(*Orientation::nearest(static_cast<double>(random() % 600) / 100 - 3))));
    expect_membership(*c, random);
  });
}

// A rod of length 5 in a room of 3 by 4 stands along a diagonal only, either way round; one that is shorter by a hair
// has four rooms to turn in.
TEST(CspaceRod, fits_along_the_diagonals) {
  const Region room = polygon(box(-8, -8, 12, 12), {reversed(box(0, 0, 3, 4))});
  const CspaceObstacle fits = CspaceObstacle::create(segment({0, 0}, {5, 0}), room).value();
  ASSERT_EQ(fits.tight().size(), 4u);
  const std::array<Point, 4> starts{Point{3, 4}, {0, 4}, {0, 0}, {3, 0}};  // by increasing angle
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(fits.tight()[k].from, fits.tight()[k].to);
    EXPECT_NEAR(fits.tight()[k].from.x, starts[k].x, 1e-12);
    EXPECT_NEAR(fits.tight()[k].from.y, starts[k].y, 1e-12);
  }
  EXPECT_EQ(free_components(fits), 1u);
  const CspaceObstacle longer = CspaceObstacle::create(segment({0, 0}, {5 + 0x1p-40, 0}), room).value();
  EXPECT_TRUE(longer.tight().empty());
  EXPECT_EQ(free_components(longer), 1u);
  const CspaceObstacle shorter = CspaceObstacle::create(segment({0, 0}, {5 - 0x1p-40, 0}), room).value();
  EXPECT_EQ(free_components(shorter), 5u);
  EXPECT_TRUE(shorter.tight().empty());
}

// In a slot as long as itself and of some width: free along an interval, at two angles.
TEST(CspaceRod, fits_into_a_slot_along_a_stretch) {
  const Region slot = polygon(box(-8, -8, 12, 12), {reversed(box(0, 0, 3, 1))});
  const CspaceObstacle c = CspaceObstacle::create(segment({0, 0}, {3, 0}), slot).value();
  // Turned a little it fits as well: sqrt 10 is the diagonal.
  EXPECT_EQ(free_components(c), 5u);
  const CspaceObstacle diagonal = CspaceObstacle::create(segment({0, 0}, {3, 1}), slot).value();
  EXPECT_EQ(diagonal.tight().size(), 4u);
}

// Turns on the spot and motions against membership at angles between; rings that touch included.
TEST(CspaceRod, motions_equal_membership_on_the_way) {
  int free = 0, blocked = 0;
  for_seeds(60, [&](Random& random) {
    const Region robot = random() % 4 == 0 ? point({grid(random, 3), grid(random, 3)}) : random_segment(random, 3);
    const Region obstacle = random() % 3 == 0 ? random_board(random, 3, 2) : random_obstacle(random);
    const Point at{grid(random, 12) / 2, grid(random, 12) / 2};
    const Orientation from = *Orientation::of(static_cast<int>(random() % 5) - 2, 3),
                      to = *Orientation::of(static_cast<int>(random() % 7) + 2, 2);
    const RotationCheck turn = check_rotation(robot, obstacle, at, from, to, TurnDirection::counter_clockwise).value();
    const double end = turn.free ? to.radians() : turn.first->theta;
    const auto overlaps = [&](Point p, double theta) {
      return !check_translation(robot, obstacle, p, p, *Orientation::nearest(theta))->free;
    };
    for (int k = 1; k < 8; ++k)
      if (end > from.radians() + 1e-9) {  // its double may lie beyond
        EXPECT_FALSE(overlaps(at, from.radians() + (end - from.radians()) * k / 8))
            << at.x << ' ' << at.y << " from " << from.radians() << " to " << end << " step " << k
            << format_region(robot, RegionFormat::wkt) << format_region(obstacle, RegionFormat::wkt);
      }
    const Configuration a{at.x, at.y, 0.25}, b{grid(random, 12) / 2, grid(random, 12) / 2, 1.5};
    const MotionCheck way = check_motion(robot, obstacle, a, b).value();
    free += way.outcome == MotionCheck::Outcome::free;
    blocked += way.outcome == MotionCheck::Outcome::blocked;
    const double low = way.outcome == MotionCheck::Outcome::free ? 1 : way.low;
    const auto pose = [&](double t) {
      return overlaps({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)}, a.theta + t * (b.theta - a.theta));
    };
    for (int k = 0; k < 8; ++k) EXPECT_FALSE(low > 0 && pose(low * k / 8));
    if (way.outcome == MotionCheck::Outcome::blocked) {
      EXPECT_TRUE(pose(way.high));
    }
  });
  if (std::getenv("DYMSUM_SEED") == nullptr) {
    EXPECT_GT(free, 3);
    EXPECT_GT(blocked, 3);
  }
}

TEST(CspaceRod, a_file_holds_the_same_obstacle) {
  const Region room = polygon(box(-8, -8, 12, 12), {reversed(box(0, 0, 3, 4))});
  for (const Region& robot : {segment({0.5, 0.25}, {2, 1}), point({1, 0.5})}) {
    const std::string text = format_obstacle(CspaceObstacle::create(robot, room).value());
    const Result<CspaceObstacle> read = parse_obstacle(text, "text");
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_EQ(read->robot().data(), robot.data());
    EXPECT_EQ(format_obstacle(*read), text);
  }
}

}  // namespace
}  // namespace dymsum
