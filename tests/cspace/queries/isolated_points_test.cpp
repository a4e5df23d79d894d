// Isolated points beside other pieces, and robots of a few vertices that fit between them.
#include "cspace/queries/questions_by_definition.h"
#include "oracles/sanitized.h"

namespace dymsum {
namespace isolated_points {

using namespace testing_questions;

// Squares, bars, parallelograms, triangles, an L, and a square that is flush at a turn by (4, 3); about any vertex;
// or a room of such a shape.
Region random_body(Random& random) {
  static const std::vector<Ring> kBodies{box(0, 0, 1, 1),
                                         box(0, 0, 2, 2),
                                         box(0, 0, 2, 1),
                                         {{0, 0}, {2, 0}, {3, 1}, {1, 1}},
                                         {{0, 0}, {1, 0}, {2, 2}, {1, 2}},
                                         {{0, 0}, {2, 0}, {0, 1}},
                                         {{0, 0}, {2, 0}, {1, 2}},
                                         {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}},
                                         {{0, 0}, {4, 3}, {1, 7}, {-3, 4}},
                                         {{0, 0}, {4, 3}, {4, 8}, {0, 5}}};
  Ring ring = kBodies[random() % kBodies.size()];
  const Point origin = random() % 4 == 0 ? Point{0.5, 0.5} : ring[random() % ring.size()];
  for (Point& p : ring) p = {p.x - origin.x, p.y - origin.y};
  return random() % 4 == 0 ? polygon(box(-12, -12, 12, 12), {reversed(ring)}) : polygon(ring);
}

// Of the grid, on the ring of a body: points that all of them hold it. Of a room on its walls.
std::vector<Point> rim_of(const Region& body) {
  const Part& part = body.parts()[0];
  const Ring& ring = part.holes.empty() ? part.outer : part.holes[0];
  std::vector<Point> all;
  for (double x = -8; x <= 8; x += 0.5)
    for (double y = -8; y <= 8; y += 0.5)
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Point a = ring[k], b = ring[(k + 1) % ring.size()], d{b.x - a.x, b.y - a.y};
        const double along = d.x * (x - a.x) + d.y * (y - a.y);
        if (d.x * (y - a.y) == d.y * (x - a.x) && along >= 0 && along < d.x * d.x + d.y * d.y) all.push_back({x, y});
      }
  return all;
}

// One to four pieces, one of them a point; either anywhere, or each with a corner on the rim of the body.
Region random_pieces(Random& random, int reach, const Region& body) {
  const std::vector<Point> rim = rim_of(body);
  const bool on_rim = random() % 3 != 0;
  for (;;) {
    RegionData data;
    const auto at = [&] { return Point{grid(random, reach), grid(random, reach)}; };
    const auto corner = [&] { return on_rim ? rim[random() % rim.size()] : at(); };
    data.points.push_back(corner());
    for (std::uint64_t more = random() % 4; more > 0; --more) {
      const std::uint64_t kind = random() % 6;
      if (kind < 3) data.points.push_back(corner());
      else if (kind == 3) data.polylines.push_back({corner(), at()});
      else if (kind == 4) data.polylines.push_back({at(), corner(), at()});
      else data.parts.push_back({{corner(), at(), at()}, {}});
    }
    const Result<Repaired> repaired = repair(data);
    if (repaired.ok() && !repaired->region.points().empty()) return repaired->region;
  }
}

void query_everything(const Region& robot, const Region& obstacle, Random& random, Tally& tally) {
  SCOPED_TRACE("robot " + format_region(robot, RegionFormat::wkt) + "\nobstacle " +
               format_region(obstacle, RegionFormat::wkt));
  const Result<CspaceObstacle> c = CspaceObstacle::create(robot, obstacle);
  if (!c) {
    EXPECT_EQ(c.error().code, ErrorCode::unsupported_operand) << c.error().message;
    return;
  }
  Questions(*c, random, tally).query();
}

RegionData points(std::vector<Point> at) {
  RegionData data;
  data.points = std::move(at);
  return data;
}

void expect_contact_at(const CspaceObstacle& c, const Configuration& at) {
  const ObstacleQueries queries(c);
  for (const double weight : {queries.gyration_radius(), kOnlyMoves}) {
    const Clearance found = queries.clearance(at, weight);
    EXPECT_EQ(found.distance, 0) << weight;
    EXPECT_EQ(found.error, 0) << weight;
  }
}

TEST(IsolatedPoints, a_square_that_fits_between_two_points_is_jammed) {
  const Region square = polygon(box(-1, -1, 1, 1)), pair = made(points({{0, 0}, {0, 2}}));
  const CspaceObstacle c = CspaceObstacle::create(square, pair).value(),
                       swapped = CspaceObstacle::create(pair, square).value();
  for (const CspaceObstacle* one : {&c, &swapped}) EXPECT_EQ(one->work().tight_events, 8u);
  expect_contact_at(c, {0, 1, 0});
  expect_contact_at(swapped, {0, -1, 0});
}

TEST(IsolatedPoints, a_square_between_a_point_and_a_part_or_a_line_is_jammed) {
  const Region square = polygon(box(-1, -1, 1, 1));
  RegionData roof = points({{0, 2}}), line = points({{0, 2}});
  roof.parts = {{{{0, 0}, {-1, -1}, {1, -1}}, {}}};
  line.polylines = {{{0, 0}, {0, -1}}};
  for (const RegionData& data : {roof, line}) {
    const CspaceObstacle c = CspaceObstacle::create(square, made(data)).value();
    expect_contact_at(c, {0, 1, 0});
    EXPECT_FALSE(c.tight().empty());
  }
}

// The robot's origin at the only point of the obstacle: no segment leads from there to another vertex of the obstacle.
TEST(IsolatedPoints, an_obstacle_that_is_one_point_is_asked_at_that_point) {
  for (const Point origin : {Point{0, 0}, {0.5, 0}, {0.5, 0.5}, {2, 2}}) {
    const Ring ring = box(-origin.x, -origin.y, 1 - origin.x, 1 - origin.y);
    const CspaceObstacle c = CspaceObstacle::create(polygon(ring), made(points({{3, -2}}))).value();
    for (const Turn& turn : kTurns)
      EXPECT_EQ(c.contains(3, -2, turn.orientation()), origin == Point({0.5, 0.5})) << origin.x << ' ' << origin.y;
  }
}

// A wall below and two points above: the lid of the robot turns about the one or the other, and what lies between the
// two ways is held at one angle only.
TEST(IsolatedPoints, a_stretch_is_tight_where_nothing_comes_to_it) {
  RegionData data = points({{0, 2}, {0.5, 2}});
  data.parts = {{box(-9, -1, 9, 0), {}}};
  const Region house = polygon({{0, -1}, {1, 0}, {1, 1}, {-1, 1}, {-1, 0}});
  const CspaceObstacle c = CspaceObstacle::create(house, made(data)).value();
  std::size_t level = 0;
  for (const TightFeature& f : c.tight()) {
    if (c.angles()[f.angle].theta != 0) continue;
    ++level;
    EXPECT_EQ(std::min(f.from.x, f.to.x), 0);
    EXPECT_EQ(std::max(f.from.x, f.to.x), 0.5);
    EXPECT_EQ(f.from.y, 1);
    EXPECT_EQ(f.to.y, 1);
  }
  EXPECT_EQ(level, 1u);
  EXPECT_EQ(tight_at(c, 0), 2u);
}

// Two pieces without area never overlap, but where touching is forbidden they meet.
TEST(IsolatedPoints, pieces_without_area_on_both_sides_touch) {
  int touching = 0, entered = 0;
  for_seeds(60, [&](Random& random) {
    const auto thin = [&] {
      RegionData data = points({{grid(random, 2), grid(random, 2)}});
      while (random() % 2 == 0) data.points.push_back({grid(random, 2), grid(random, 2)});
      if (random() % 2 == 0) data.polylines.push_back({{grid(random, 2), grid(random, 2)}, {3, grid(random, 3)}});
      return repair(data)->region;
    };
    const Region robot = thin(), obstacle = thin();
    SCOPED_TRACE("robot " + format_region(robot, RegionFormat::wkt) + "\nobstacle " +
                 format_region(obstacle, RegionFormat::wkt));
    const Turn& turn = kTurns[random() % 4];
    const Truth truth(robot, obstacle, turn);
    for (int k = 0; k < 12; ++k) {
      const Point a{grid(random, 8) / 2, grid(random, 8) / 2}, b{grid(random, 8) / 2, grid(random, 8) / 2};
      const auto way = [&](Point to, Touching touch) {
        return check_translation(robot, obstacle, a, to, turn.orientation(), touch).value();
      };
      EXPECT_TRUE(way(a, Touching::allowed).free && way(b, Touching::allowed).free);
      EXPECT_EQ(way(a, Touching::forbidden).free, !truth.touches(a)) << a.x << ' ' << a.y;
      const TranslationCheck to_b = way(b, Touching::forbidden);
      const auto touches_at = [&](double f) { return truth.touches({a.x + f * (b.x - a.x), a.y + f * (b.y - a.y)}); };
      touching += truth.touches(a);
      entered += !to_b.free && !truth.touches(a);
      for (int i = 0; i <= 64; ++i)
        EXPECT_FALSE(touches_at(i / 64.0) && (to_b.free || i / 64.0 < to_b.first.to_double())) << i;
    }
  });
  if (std::getenv("DYMSUM_SEED") != nullptr) return;
  EXPECT_GT(touching, oracles::kSanitized ? 3 : 10);
  EXPECT_GT(entered, oracles::kSanitized ? 3 : 10);
}

TEST(IsolatedPoints, obstacles_equal_those_by_whole_slices) {
  for_seeds(40, [](Random& random) {
    const Region body = random_body(random), pieces = random_pieces(random, 3, body);
    const bool swapped = random() % 3 == 0;
    const Region &robot = swapped ? pieces : body, &obstacle = swapped ? body : pieces;
    const auto made_with = [&](bool reference) {
      ObstacleOptions options;
      options.reference = reference;
      return CspaceObstacle::create(robot, obstacle, options);
    };
    const Result<CspaceObstacle> fast = made_with(false), slow = made_with(true);
    ASSERT_EQ(fast.ok(), slow.ok());
    if (!fast) return;
    const auto shells = [](const CspaceObstacle& c) {
      std::vector<std::int64_t> all;
      for (const Shell& s : c.shells()) all.push_back(s.euler);
      std::sort(all.begin(), all.end());
      return all;
    };
    const std::string pair =
        "robot " + format_region(robot, RegionFormat::wkt) + "\nobstacle " + format_region(obstacle, RegionFormat::wkt);
    EXPECT_EQ(shells(*fast), shells(*slow)) << pair;
    EXPECT_EQ(free_components(*fast), free_components(*slow)) << pair;
    EXPECT_EQ(fast->tight().empty(), slow->tight().empty()) << pair;
  });
}

TEST(IsolatedPoints, every_question_agrees_with_membership) {
  Tally tally;
  for_seeds(40, [&](Random& random) {
    const Region body = random_body(random);
    const bool swapped = random() % 3 == 0;
    const Region pieces = random_pieces(random, 3, body);
    if (swapped) query_everything(pieces, body, random, tally);
    else query_everything(body, pieces, random, tally);
  });
  if (std::getenv("DYMSUM_SEED") != nullptr) return;
  const int fraction = oracles::kSanitized ? 8 : 1;
  EXPECT_GT(tally.touching, 3000 / fraction);
  EXPECT_GT(tally.jammed, 10 / fraction);
  EXPECT_GT(tally.single, 40 / fraction);
  EXPECT_GT(tally.tight, 15 / fraction);
  EXPECT_GT(tally.reached, 40 / fraction);
  EXPECT_GT(tally.plans, 4 / fraction);
}

}  // namespace isolated_points
}  // namespace dymsum
