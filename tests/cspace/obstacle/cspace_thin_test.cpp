// Robots and obstacles with pieces that have no area: bent, closed and branching wires, several pieces, a polygon with
// a whisker, walls. On grids so small that ends, bends and edges coincide, against static slices, membership by
// definition and the obstacle by whole slices.
#include "cspace/obstacle/obstacle_slices.h"
#include "dymsum/motion.h"
#include "dymsum/obstacle_file.h"
#include "dymsum/planner.h"
#include "oracles/sanitized.h"

namespace dymsum {
namespace {

using namespace testing_obstacles;

double grid_coordinate(Random& random, int reach) {
  return static_cast<double>(static_cast<int>(random() % static_cast<unsigned>(2 * reach + 1)) - reach);
}
Point position(Random& random, int reach) { return {grid_coordinate(random, reach), grid_coordinate(random, reach)}; }

Polyline random_line(Random& random, int reach, std::size_t vertices) {
  Polyline line{position(random, reach)};
  while (line.size() < vertices) {
    const Point next = position(random, reach);
    if (next != line.back()) line.push_back(next);
  }
  return line;
}
Region made(RegionData data) { return *Region::create(std::move(data)); }
Region wire(Polyline line) {
  RegionData data;
  data.polylines.push_back(std::move(line));
  return made(std::move(data));
}

// Wires: open, closed, branching at a vertex or within a segment, crossing, several.
RegionData random_wires(Random& random, int reach) {
  RegionData data;
  const Polyline first = random_line(random, reach, 2 + random() % 3);
  switch (random() % 6) {
    case 0:
      data.polylines = {first};
      break;
    case 1: {
      Polyline closed = random_line(random, reach, 3);
      if (closed.front() != closed.back()) closed.push_back(closed.front());
      data.polylines = {closed};
      break;
    }
    case 2: {  // a star of segments
      const Point midpoint = position(random, reach);
      for (int k = 0; k < 3; ++k)
        for (Point end = midpoint; end == midpoint;)
          if ((end = position(random, reach)) != midpoint) data.polylines.push_back({midpoint, end});
      break;
    }
    case 3:
      data.polylines = {first, random_line(random, reach, 2)};
      break;
    case 4:
      data.polylines = {{{-1, 0}, {1, 0}}, {{0, 0}, {0, 1 + grid_coordinate(random, 0)}}};
      break;  // a T
    default:
      data.polylines = {random_line(random, reach, 2 + random() % 2)};
      data.points = {position(random, reach)};
  }
  return data;
}

Region wires(Random& random, int reach) { return made(random_wires(random, reach)); }

Region random_solid(Random& random, int reach) {
  switch (random() % 3) {
    case 0:
      return random_cells(random, 2, 1);
    case 1:
      return random_shape(random, reach, 4, false);
    default:
      return random_shape(random, reach, 5, true);
  }
}
// Parts, and wires anywhere: inside, across, along edges, apart.
Region random_mixed(Random& random, int reach) {
  RegionData data = random_wires(random, reach);
  data.parts = random_shape(random, reach, 4, false).parts();
  return made(std::move(data));
}
// Whether an edge of a polyline has an interval in common with another edge.
bool runs_along(const Region& region) {
  std::vector<std::array<Point, 2>> edges;
  for (const Polyline& line : region.polylines())
    for (std::size_t k = 0; k + 1 < line.size(); ++k) edges.push_back({line[k], line[k + 1]});
  const std::size_t lines = edges.size();
  for (const Part& part : region.parts())
    for (std::size_t h = 0; h <= part.holes.size(); ++h) {
      const Ring& ring = h == 0 ? part.outer : part.holes[h - 1];
      for (std::size_t k = 0; k < ring.size(); ++k) edges.push_back({ring[k], ring[(k + 1) % ring.size()]});
    }
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t j = 0; j < std::min(i, lines); ++j) {
      const auto [a, b] = edges[i];
      const auto [c, d] = edges[j];
      const auto cross = [&](Point p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); };
      const auto dot = [&](Point p) { return (b.x - a.x) * (p.x - a.x) + (b.y - a.y) * (p.y - a.y); };
      if (cross(c) == 0 && cross(d) == 0 && std::max(dot(c), dot(d)) > 0 && std::min(dot(c), dot(d)) < dot(b))
        return true;
    }
  return false;
}
Region plain(Region (*make)(Random&, int), Random& random, int reach) {
  for (;;)
    if (const Region region = make(random, reach); !runs_along(region)) return region;
}
// Parts that touch at points.
Region random_rings_that_touch(Random& random, int reach) {
  for (;;) {
    RegionData data;
    for (int k = 0; k < 2; ++k) data.parts.push_back({random_ring(random, reach, 5, 0), {}});
    const Result<Repaired> repaired = repair(data);
    if (repaired.ok() && !repaired->region.touching_points().empty()) return repaired->region;
  }
}
Region with_wires(Region region, Random& random, int reach) {
  for (;;) {
    RegionData data = random_wires(random, reach);
    data.parts = region.parts();
    if (Region all = made(std::move(data)); !runs_along(all)) return all;
  }
}

struct Pair {
  Region robot, obstacle;
};
// One segment and rings that touch elsewhere; or wires and rings that touch on the same side.
Pair random_touching_pair(Random& random) {
  switch (random() % 4) {
    case 0:
      return {wire(random_line(random, 2, 2)), random_rings_that_touch(random, 3)};
    case 1:
      return {random_rings_that_touch(random, 2), wire(random_line(random, 3, 2))};
    case 2:
      return {with_wires(random_rings_that_touch(random, 1), random, 1), random_solid(random, 2)};
    default:
      return {random_solid(random, 2), with_wires(random_rings_that_touch(random, 2), random, 2)};
  }
}
Pair random_pair(Random& random) {
  switch (random() % 4) {
    case 0:
      return {plain(wires, random, 2), random_solid(random, 3)};
    case 1:
      return {plain(random_mixed, random, 1), random_solid(random, 3)};
    case 2:
      return {random_solid(random, 2), plain(wires, random, 3)};
    default:
      return {random_solid(random, 1), plain(random_mixed, random, 3)};
  }
}

std::string wkt(const Pair& pair) {
  return "\nrobot " + format_region(pair.robot, RegionFormat::wkt) + "\nobstacle " +
         format_region(pair.obstacle, RegionFormat::wkt);
}

// Loops of positions in doubles, without those inside straight lines.
using Loops = std::vector<std::vector<Point>>;
void add_loop(Loops& to, const std::vector<Point>& at) {
  std::vector<Point> kept;
  for (const Point& p : at)
    if (kept.empty() || std::hypot(p.x - kept.back().x, p.y - kept.back().y) > 1e-9) kept.push_back(p);
  while (kept.size() > 1 && std::hypot(kept.back().x - kept[0].x, kept.back().y - kept[0].y) < 1e-9) kept.pop_back();
  std::vector<Point> corners;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const Point a = kept[(k + kept.size() - 1) % kept.size()], b = kept[k], c = kept[(k + 1) % kept.size()];
    const double cross = (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x);
    if (std::abs(cross) > 1e-9 * (std::hypot(b.x - a.x, b.y - a.y) * std::hypot(c.x - b.x, c.y - b.y) + 1e-6))
      corners.push_back(b);
  }
  to.push_back(corners);
}
bool same_loop(const std::vector<Point>& a, const std::vector<Point>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t shift = 0; shift < a.size(); ++shift) {
    bool same = true;
    for (std::size_t k = 0; k < a.size() && same; ++k) {
      const Point p = a[k], q = b[(k + shift) % b.size()];
      same = std::hypot(p.x - q.x, p.y - q.y) < 1e-7;
    }
    if (same) return true;
  }
  return a.empty();
}
bool same_loops(Loops a, Loops b) {
  if (a.size() != b.size()) return false;
  for (const auto& loop : a) {
    const auto it = std::find_if(b.begin(), b.end(), [&](const auto& other) { return same_loop(loop, other); });
    if (it == b.end()) return false;
    b.erase(it);
  }
  return true;
}
Loops loops_at(const CspaceObstacle& c, std::uint32_t slab, double theta) {
  Loops loops;
  for (const auto& loop : c.loops(slab)) {
    std::vector<Point> at;
    for (const std::uint32_t p : loop)
      for (const Point end : c.ends(c.patches()[p], theta)) at.push_back(end);
    add_loop(loops, at);
  }
  return loops;
}
Loops loops_of(const PlanarSum& sum) {
  Loops loops;
  const auto add = [&](const SumRing& ring) {
    std::vector<Point> at;
    for (const SumVertex& v : ring.vertices) at.push_back(v.at);
    add_loop(loops, at);
  };
  for (const SumPart& part : sum.parts) {
    add(part.outer);
    for (const SumRing& hole : part.holes) add(hole);
  }
  return loops;
}
std::string text(const Loops& loops) {
  std::string s;
  for (const auto& l : loops) {
    for (Point p : l) s += "(" + std::to_string(p.x) + " " + std::to_string(p.y) + ")";
    s += "\n";
  }
  return s;
}

Orientation midpoint_of(const CspaceObstacle& c, std::uint32_t slab) {
  if (c.angles().empty()) return {};
  const double low = c.angles()[slab].theta,
               high = slab + 1 < slabs(c) ? c.angles()[slab + 1].theta : c.angles()[0].theta + 2 * std::numbers::pi;
  const Orientation near = *Orientation::nearest(0.5 * (low + high));
  return high - low > 1e-4 && c.slab_of(near) == slab ? near : c.inside(slab);
}

// In every slab the positions of its loops; and nothing is tight between events but along curves.
void expect_positions(const CspaceObstacle& c, const Pair& pair) {
  for (std::uint32_t slab = 0; slab < slabs(c); ++slab) {
    const Orientation at = midpoint_of(c, slab);
    SumOptions options;
    options.semantics = Semantics::open;
    const PlanarSum open = *cspace_slice(pair.robot, pair.obstacle, at, options);
    EXPECT_TRUE(open.tight_segments.empty() && (open.tight_points.empty() || c.may_have_tight_curves()))
        << at.radians() << wkt(pair);
    const Loops made = loops_at(c, slab, at.radians()), expected = loops_of(open);
    ASSERT_TRUE(same_loops(made, expected)) << "slab " << slab << " at " << at.radians() << wkt(pair) << '\n'
                                            << text(made) << "expected\n"
                                            << text(expected);
  }
}

void expect_thin_membership(const CspaceObstacle& c, Random& random, const Pair& pair) {
  for (int k = 0; k < 12; ++k) {
    const Orientation at =
        random() % 3 == 0 ? *Orientation::of(static_cast<int>(random() % 5) - 2, 1 + static_cast<int>(random() % 3))
                          : c.inside(static_cast<std::uint32_t>(random() % slabs(c)));
    const double x = grid_coordinate(random, 8) / 2, y = grid_coordinate(random, 8) / 2;
    const Result<TranslationCheck> still = check_translation(c.robot(), c.obstacle(), Point{x, y}, Point{x, y}, at);
    ASSERT_TRUE(still.ok());
    EXPECT_EQ(c.contains(x, y, at), !still->free) << x << ' ' << y << ' ' << at.radians() << wkt(pair);
  }
}

void expect_slices_and_membership(const Pair& pair, Random& random) {
  const Result<CspaceObstacle> c = CspaceObstacle::create(pair.robot, pair.obstacle);
  ASSERT_TRUE(c.ok()) << c.error().message << wkt(pair);
  expect_positions(*c, pair);
  expect_thin_membership(*c, random, pair);
}
void expect_as_by_whole_slices(const Pair& pair) {
  const CspaceObstacle fast = CspaceObstacle::create(pair.robot, pair.obstacle).value();
  ObstacleOptions options;
  options.reference = true;
  const CspaceObstacle slow = CspaceObstacle::create(pair.robot, pair.obstacle, options).value();
  EXPECT_EQ(fast.tight().size(), slow.tight().size()) << wkt(pair);
  EXPECT_EQ(free_components(fast), free_components(slow)) << wkt(pair);
  const auto shells = [](const CspaceObstacle& c) {
    std::vector<std::int64_t> all;
    for (const Shell& s : c.shells()) all.push_back(s.euler);
    std::sort(all.begin(), all.end());
    return all;
  };
  EXPECT_EQ(shells(fast), shells(slow)) << wkt(pair);
}
bool is_refused(const Pair& pair) { return !CspaceObstacle::create(pair.robot, pair.obstacle).ok(); }

TEST(CspaceThin, slices_and_membership_are_those_of_static_sums) {
  for_seeds(120, [](Random& random) { expect_slices_and_membership(random_pair(random), random); });
}

TEST(CspaceThin, equals_the_obstacle_by_whole_slices) {
  for_seeds(60, [](Random& random) { expect_as_by_whole_slices(random_pair(random)); });
}

// A segment past a touching point is refused exactly where it can pass: in slices something is tight then.
TEST(CspaceThin, rings_that_touch) {
  int refused = 0;
  for_seeds(40, [&](Random& random) {
    const Pair pair = random_touching_pair(random);
    if (is_refused(pair)) {
      ++refused;
      bool tight = false;
      for (int k = 0; k < 1000 && !tight; ++k) {
        SumOptions options;
        options.semantics = Semantics::open;
        tight = !cspace_slice(pair.robot, pair.obstacle, *Orientation::nearest(0.00627 * k - 3.1, 1e-6), options)
                     ->tight_segments.empty();
      }
      EXPECT_TRUE(tight) << wkt(pair);
      return;
    }
    expect_slices_and_membership(pair, random);
    expect_as_by_whole_slices(pair);
  });
  if (std::getenv("DYMSUM_SEED") == nullptr) {
    EXPECT_GT(refused, oracles::kSanitized ? 0 : 5);
  }
}

// Three ends in one place are no tight placements: free space comes to them. Nor is an interval on which one side only
// of a wall is touched, though both are walked.
TEST(CspaceThin, ends_beside_free_space_are_not_tight) {
  RegionData star, junction;
  star.polylines = {{{0, 1}, {-2, -1}}, {{0, 1}, {1, 0}}, {{0, 1}, {2, -2}}};
  const Pair thin{made(star), polygon({{3, 1}, {-3, -3}, {2, 0}})};
  expect_as_by_whole_slices(thin);
  EXPECT_TRUE(CspaceObstacle::create(thin.robot, thin.obstacle)->tight().empty());
  junction.parts = {{{{3, 1}, {2, 1}, {3, 0}}, {}}};
  junction.polylines = {{{-1, 0}, {1, 0}}, {{0, 0}, {0, 1}}};
  expect_as_by_whole_slices({polygon({{-1, 1}, {0, -1}, {0, 0}}), made(junction)});
}

// A room drawn as lines, with a door: a square passes if it is wider, and jams in it at four angles if it fits exactly.
TEST(CspaceThin, a_square_and_a_door_between_walls) {
  const Region square = polygon(box(0, 0, 1, 1));
  const auto room = [&](double door) {
    RegionData walls;
    walls.polylines = {{{3, 1}, {3, 0}, {0, 0}, {0, 3}, {3, 3}, {3, 1 + door}}};
    return CspaceObstacle::create(square, made(walls)).value();
  };
  EXPECT_EQ(free_components(room(0.999)), 2u);
  EXPECT_EQ(free_components(room(1)), 2u);
  const CspaceObstacle open = room(1.25);
  EXPECT_EQ(free_components(open), 1u);
  const Plan way = plan(open, {1, 1, 0}, {5, 1, 0}).value();
  ASSERT_TRUE(way.found());
  for (std::size_t k = 1; k < way.path.size(); ++k) {
    const Waypoint &a = way.path[k - 1], &b = way.path[k];
    const auto turn = b.move == Waypoint::Move::clockwise ? TurnDirection::clockwise : TurnDirection::counter_clockwise;
    const bool free = b.move == Waypoint::Move::translation
                          ? check_translation(open.robot(), open.obstacle(), a.at, b.at, a.theta)->free
                          : check_rotation(open.robot(), open.obstacle(), a.at, a.theta, b.theta, turn)->free;
    EXPECT_TRUE(free) << k;
  }
  EXPECT_EQ(plan(room(0.999), {1, 1, 0}, {5, 1, 0})->reason->kind, NoPath::Kind::separated);
  // A closed room.
  const CspaceObstacle closed = CspaceObstacle::create(square, wire({{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 0}})).value();
  EXPECT_EQ(free_components(closed), 2u);
}

// A wire bent to a U stands over a post that is as wide, at four angles of a square post; over one that is narrower it
// also comes off.
TEST(CspaceThin, a_staple_over_a_post) {
  const Region staple = wire({{0, -3}, {0, 0}, {1, 0}, {1, -3}});
  const CspaceObstacle jammed = CspaceObstacle::create(staple, polygon(box(0, -1, 1, 0))).value();
  EXPECT_FALSE(jammed.contains(0, 0, Orientation()));
  EXPECT_TRUE(jammed.contains(0.25, 0, Orientation()));
  EXPECT_EQ(jammed.tight().size(), 4u);
  const CspaceObstacle loose = CspaceObstacle::create(staple, polygon(box(0.125, -1, 0.875, 0))).value();
  EXPECT_EQ(free_components(loose), 1u);
}

TEST(CspaceThin, a_file_holds_the_same_obstacle) {
  for_seeds(6, [](Random& random) {
    const Pair pair = random_pair(random);
    const CspaceObstacle c = CspaceObstacle::create(pair.robot, pair.obstacle).value();
    const Result<CspaceObstacle> read = parse_obstacle(format_obstacle(c), "text");
    ASSERT_TRUE(read.ok()) << read.error().message << wkt(pair);
    EXPECT_EQ(read->robot().data(), pair.robot.data());
    EXPECT_EQ(read->obstacle().data(), pair.obstacle.data());
    ASSERT_EQ(slabs(*read), slabs(c));
    for (std::uint32_t slab = 0; slab < slabs(c); ++slab)
      EXPECT_EQ(of_slab(*read, slab), of_slab(c, slab)) << wkt(pair);
    expect_positions(*read, pair);
  });
}

TEST(CspaceThin, what_is_refused_has_a_reason_and_a_place) {
  const Region square = polygon(box(0, 0, 1, 1)), rod = wire({{0, 0}, {1, 0}}), bent = wire({{0, 0}, {1, 0}, {1, 1}});
  RegionData along = square.data(), touching;
  along.polylines = {{{0.5, 0}, {2, 0}}};
  touching.parts = {{box(0, 0, 2, 2), {}}, {box(2, 2, 5, 5), {}}};
  const auto error = [](const Region& robot, const Region& obstacle) {
    return CspaceObstacle::create(robot, obstacle).error();
  };
  for (const Region& robot : {rod, bent}) {
    EXPECT_EQ(error(robot, rod).code, ErrorCode::unsupported_operand);
    EXPECT_EQ(check_motion(robot, rod, {}, {1, 1, 1}).error().code, ErrorCode::unsupported_operand);
    EXPECT_EQ(check_rotation(robot, rod, Point{}, {}, {}, TurnDirection::clockwise).error().code,
              ErrorCode::unsupported_operand);
    EXPECT_EQ(error(robot, made(touching)).evidence.x, 2) << error(robot, made(touching)).message;
    EXPECT_EQ(error(made(touching), robot).evidence.x, 2);
  }
  EXPECT_EQ(error(square, wire({{0, 0}, {4, 0}, {3, 0}})).evidence.x, 3);
  EXPECT_EQ(error(made(along), square).evidence.x, 0.5);
  EXPECT_EQ(error(Region(), square).code, ErrorCode::unsupported_operand);
}

}  // namespace
}  // namespace dymsum
