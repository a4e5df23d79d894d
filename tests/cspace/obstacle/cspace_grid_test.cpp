// Polygons of small integer coordinates: many events coincide, and many triples of contacts stay at one point at every
// angle.
#include "cspace/obstacle/obstacle_slices.h"

#include <map>

#include "dymsum/shapes.h"
#include "oracles/snapped_shapes.h"

namespace dymsum {
namespace {

using namespace testing_obstacles;

// Points of a board put one after the other into an edge of a polygon where it stays simple.
Region grid_polygon(Random& random, int size, int points) {
  const auto coordinate = [&] { return static_cast<double>(random() % static_cast<unsigned>(size + 1)); };
  for (;;) {
    Ring ring;
    for (int k = 0; k < points; ++k) {
      const Point p{coordinate(), coordinate()};
      if (ring.size() < 3) {
        ring.push_back(p);
        continue;
      }
      const std::size_t first = random() % ring.size();
      for (std::size_t i = 0; i < ring.size(); ++i) {
        Ring more = ring;
        more.insert(more.begin() + static_cast<std::ptrdiff_t>((first + i) % ring.size() + 1), p);
        RegionData data;
        data.parts.push_back({more, {}});
        if (const Result<Region> made = Region::create(data); !made.ok() || made->vertex_count() != more.size())
          continue;
        ring = std::move(more);
        break;
      }
    }
    RegionData data;
    data.parts.push_back({ring, {}});
    if (Result<Region> made = Region::create(data); made.ok() && made->touching_points().empty()) return *made;
  }
}

// Shells by kind and Euler number.
std::map<std::pair<bool, std::int64_t>, int> shells_of(const CspaceObstacle& c) {
  std::map<std::pair<bool, std::int64_t>, int> all;
  for (const Shell& s : c.shells()) ++all[{s.outer, s.euler}];
  return all;
}

std::size_t tight_events(const CspaceObstacle& c) {
  return static_cast<std::size_t>(std::count_if(c.events().begin(), c.events().end(), [](const ObstacleEvent& e) {
    return e.kind == ObstacleEvent::Kind::tight;
  }));
}

void expect_same(const CspaceObstacle& fast, const CspaceObstacle& slow) {
  EXPECT_EQ(shells_of(fast), shells_of(slow));
  EXPECT_EQ(free_components(fast), free_components(slow));
  EXPECT_EQ(tight_events(fast), tight_events(slow));
  for (std::uint32_t slab = 0; slab < slabs(slow); ++slab)
    if (const std::optional<std::uint32_t> same = fast.slab_of(slow.inside(slab))) {
      ASSERT_EQ(of_slab(slow, slab), of_slab(fast, *same));
    }
}

TEST(CspaceGrid, whole_slices_give_the_same_obstacle) {
  for_seeds(15, [](Random& random) {
    const int size = 3 + static_cast<int>(random() % 5), n = 5 + static_cast<int>(random() % 8);
    const Region robot = grid_polygon(random, size, n), other = grid_polygon(random, size, n);
    Region obstacle = random() % 3 == 0 ? other : robot;
    if (random() % 2 == 0) {
      const double far = 1 + static_cast<double>(random() % 8);
      obstacle = polygon(box(-far, -far, size + far, size + far), {reversed(obstacle.parts()[0].outer)});
      if (!obstacle.touching_points().empty()) return;
    }
    const CspaceObstacle fast = CspaceObstacle::create(robot, obstacle).value();
    ObstacleOptions options;
    options.reference = true;
    expect_same(fast, CspaceObstacle::create(robot, obstacle, options).value());
    if (testing::Test::HasFailure())
      ADD_FAILURE() << format_region(robot, RegionFormat::wkt) << "\n" << format_region(obstacle, RegionFormat::wkt);
  });
}

// Edges with directions d_i on lines through the origin, and vertices lambda_i d_i: where sum (d_j x d_k) lambda_i
// |d_i|^2 = 0, the three contacts stay at one point at every angle. Edges and vertices are those of triangles.
std::optional<std::pair<Region, Region>> always_concurrent(Random& random) {
  const auto small = [&] { return static_cast<double>(static_cast<int>(random() % 9) - 4); };
  const auto cross = [](Point a, Point b) { return a.x * b.y - a.y * b.x; };
  const auto dot = [](Point a, Point b) { return a.x * b.x + a.y * b.y; };
  std::array<Point, 3> d;
  for (Point& e : d) e = {small(), small()};
  std::array<double, 3> lambda{small(), small(), 0};
  const double weight = cross(d[0], d[1]) * dot(d[2], d[2]);
  if (weight == 0 || cross(d[1], d[2]) == 0 || cross(d[2], d[0]) == 0) return std::nullopt;
  lambda[2] = -(cross(d[1], d[2]) * lambda[0] * dot(d[0], d[0]) + cross(d[2], d[0]) * lambda[1] * dot(d[1], d[1]));
  lambda[0] *= weight;
  lambda[1] *= weight;
  const double most = std::max({std::abs(lambda[0]), std::abs(lambda[1]), std::abs(lambda[2])});
  RegionData robot, obstacle;
  for (std::size_t i = 0; i < 3; ++i) {
    const double side = random() % 2 == 0 ? 1 : -1,
                 reach = 1 + std::floor(most * static_cast<double>(random() % 64) / 64);
    const Point n{-d[i].y * side, d[i].x * side}, from{lambda[i] * d[i].x, lambda[i] * d[i].y};
    const auto at = [&](double along, double off) {
      return Point{from.x + along * d[i].x + off * n.x, from.y + along * d[i].y + off * n.y};
    };
    const double depth = 1 + static_cast<double>(random() % 8);
    // The robot is the reflected one; contacts have the obstacle on one side of the edge and the vertex on the other.
    Ring tip{at(0, 0), at(-depth, 2 * depth), at(depth, 2 * depth)},
        edge{at(-reach, 0), at(reach, 0), at(small(), depth)};
    for (Point& p : edge) p = {p.x - from.x - from.x, p.y - from.y - from.y};
    for (Point& p : tip) p = {-p.x, -p.y};
    robot.parts.push_back({side > 0 ? tip : reversed(tip), {}});
    obstacle.parts.push_back({side > 0 ? edge : reversed(edge), {}});
  }
  for (RegionData* data : {&robot, &obstacle})
    for (Part& part : data->parts) {
      const Ring& r = part.outer;
      if (cross({r[1].x - r[0].x, r[1].y - r[0].y}, {r[2].x - r[0].x, r[2].y - r[0].y}) < 0) part.outer = reversed(r);
    }
  const Result<Region> r = Region::create(robot), o = Region::create(obstacle);
  if (!r.ok() || !o.ok() || !r->touching_points().empty() || !o->touching_points().empty()) return std::nullopt;
  return std::pair{*r, *o};
}

TEST(CspaceGrid, three_contacts_at_one_point_at_every_angle_give_the_same_obstacle) {
  for_seeds(8, [](Random& random) {
    std::optional<std::pair<Region, Region>> pair;
    while (!pair) pair = always_concurrent(random);
    const CspaceObstacle fast = CspaceObstacle::create(pair->first, pair->second).value();
    ObstacleOptions options;
    options.reference = true;
    expect_same(fast, CspaceObstacle::create(pair->first, pair->second, options).value());
    if (testing::Test::HasFailure())
      ADD_FAILURE() << format_region(pair->first, RegionFormat::wkt) << "\n"
                    << format_region(pair->second, RegionFormat::wkt);
  });
}

// Between the two angles the three hold the robot's reference point at one position, which has free space on no side.
TEST(CspaceGrid, a_curve_of_tight_placements_is_told_where_it_begins_and_ends) {
  RegionData robot, obstacle;
  robot.parts = {{{{130, -320}, {160, -320}, {142, -344}}, {}},
                 {{{-316, 8}, {-324, 8}, {-320, 0}}, {}},
                 {{{-288, -576}, {-264, -608}, {-248, -576}}, {}}};
  obstacle.parts = {{{{74, -148}, {246, -492}, {175, -320}}, {}},
                    {{{548, 0}, {-1188, 0}, {-332, -4}}, {}},
                    {{{-306, -572}, {-478, -956}, {-98, -196}}, {}}};
  for (RegionData* data : {&robot, &obstacle})
    for (Part& part : data->parts) {
      const Ring& r = part.outer;
      if ((r[1].x - r[0].x) * (r[2].y - r[0].y) < (r[1].y - r[0].y) * (r[2].x - r[0].x)) part.outer = reversed(r);
    }
  for (const bool reference : {false, true}) {
    ObstacleOptions options;
    options.reference = reference;
    const CspaceObstacle c = CspaceObstacle::create(*Region::create(robot), *Region::create(obstacle), options).value();
    ASSERT_EQ(tight_events(c), 2u);
    std::vector<std::uint32_t> angles;
    for (const ObstacleEvent& e : c.events())
      if (e.kind == ObstacleEvent::Kind::tight) angles.push_back(e.angle);
    EXPECT_NE(angles[0], angles[1]);
  }
}

// With itself it has such contacts; then it was swept by 500 whole slices, and larger ones for minutes.
TEST(CspaceGrid, contacts_at_one_point_at_every_angle_are_no_reason_for_whole_slices) {
  const Region shape =
      polygon({{1, 0}, {5, 0}, {5, 4}, {4, 5}, {4, 3}, {3, 5}, {1, 5}, {1, 4}, {0, 0}, {3, 4}, {1, 1}, {3, 3}, {3, 2}});
  const CspaceObstacle c = CspaceObstacle::create(shape, shape).value();
  EXPECT_GT(c.work().local_updates, 20u);
  EXPECT_LT(c.work().slices, 100u);
  Random random(1);
  expect_slices(c, random, 1000);
}

// Their triples are sieved by direction and by sketches of who meets whom, and their ranges are halved.
TEST(CspaceGrid, combs_and_stars_give_the_same_obstacle_as_whole_slices) {
  for_seeds(4, [](Random& random) {
    const auto comb = [&] {
      return shapes::comb(2 + static_cast<int>(random() % 4), 2 + static_cast<double>(random() % 2), 1,
                          2 + static_cast<double>(random() % 3));
    };
    const auto star = [&] { return snapped_shapes::star(3 + static_cast<int>(random() % 5), 0.25, 1); };
    const bool combs = random() % 2 == 0;
    const Region robot = combs ? comb() : star(), obstacle = combs ? comb() : star();
    ObstacleOptions options;
    options.reference = true;
    expect_same(CspaceObstacle::create(robot, obstacle).value(),
                CspaceObstacle::create(robot, obstacle, options).value());
    if (testing::Test::HasFailure())
      ADD_FAILURE() << format_region(robot, RegionFormat::wkt) << "\n" << format_region(obstacle, RegionFormat::wkt);
  });
}

// Segments of this star really meet six to twelve others at every angle: its windows were halved to 320 with as many
// meetings each.
TEST(CspaceGrid, real_crossings_are_no_reason_to_halve_windows) {
  const Region star = snapped_shapes::star(25, 0.2, 1);
  const CspaceObstacle c = CspaceObstacle::create(star, star).value();
  EXPECT_LT(c.work().windows, 200u);
}

}  // namespace
}  // namespace dymsum
