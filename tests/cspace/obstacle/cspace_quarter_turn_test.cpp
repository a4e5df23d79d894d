// Axis-parallel shapes: most of their events are at quarter turns, where a whole slice stands for all of them.
#include "cspace/obstacle/obstacle_slices.h"

#include "dymsum/shapes.h"
#include "oracles/snapped_shapes.h"

namespace dymsum {
namespace {

using namespace testing_obstacles;

// Bars of small integer coordinates, put together: often of several parts or with holes.
Region random_bars(Random& random, int size, int bars) {
  for (;;) {
    std::vector<Region> all;
    for (int k = 0; k < bars; ++k) {
      const auto at = [&](int most) { return static_cast<double>(random() % static_cast<unsigned>(most)); };
      const double x = at(size), y = at(size), length = 1 + at(size), width = 1 + at(2);
      all.push_back(polygon(random() % 2 == 0 ? box(x, y, x + length, y + width) : box(x, y, x + width, y + length)));
    }
    const Result<Region> together = union_of(all).value().rounded();
    if (together.ok() && together->touching_points().empty()) return *together;
  }
}

std::size_t outer_shells(const CspaceObstacle& c) {
  return static_cast<std::size_t>(
      std::count_if(c.shells().begin(), c.shells().end(), [](const Shell& s) { return s.outer; }));
}

std::size_t count_of_tight_events(const CspaceObstacle& c) {
  return static_cast<std::size_t>(std::count_if(c.events().begin(), c.events().end(), [](const ObstacleEvent& e) {
    return e.kind == ObstacleEvent::Kind::tight;
  }));
}

TEST(CspaceQuarterTurn, random_bars_equal_slices_and_the_obstacle_by_whole_slices) {
  for_seeds(60, [](Random& random) {
    const Region robot = random_bars(random, 5, 4), bars = random_bars(random, 9, 7);
    RegionData data = bars.data();
    if (random() % 2 == 0) {
      data.parts = {{box(-30, -30, 50, 50), {}}};
      for (const Part& part : bars.parts()) data.parts[0].holes.push_back(reversed(part.outer));
    }
    const Region obstacle = *Region::create(data);
    const CspaceObstacle fast = CspaceObstacle::create(robot, obstacle).value();
    expect_slices(fast, random, 60);
    if (robot.vertex_count() * obstacle.vertex_count() > 300) return;
    ObstacleOptions options;
    options.reference = true;
    const CspaceObstacle slow = CspaceObstacle::create(robot, obstacle, options).value();
    EXPECT_EQ(fast.shells().size(), slow.shells().size());
    EXPECT_EQ(outer_shells(fast), outer_shells(slow));
    EXPECT_EQ(free_components(fast), free_components(slow));
    EXPECT_LE(fast.work().potential_events, slow.work().potential_events);
  });
}

// A comb against itself: 11,000 events at quarter turns are never made.
TEST(CspaceQuarterTurn, events_of_crowded_quarter_turns_are_not_made) {
  const Region comb = shapes::comb(5, 1, 0.25, 3);
  const CspaceObstacle c = CspaceObstacle::create(comb, comb).value();
  EXPECT_LT(c.work().potential_events, 1000u);
  EXPECT_EQ(c.angles().size(), 8u);
  EXPECT_EQ(c.patches().size(), 224u);
  EXPECT_EQ(c.shells().size(), 1u);
  Random random(1);
  expect_slices(c, random, 12);
}

// Twelve teeth in gaps of their width: 3 million triples of segments met beside the quarter turns, where nearly all
// keep their order.
TEST(CspaceQuarterTurn, lines_that_keep_their_order_beside_quarter_turns_are_no_triples) {
  const Region comb = shapes::comb(12, 2, 1, 5);
  const CspaceObstacle c = CspaceObstacle::create(comb, comb).value();
  EXPECT_LT(c.work().candidate_triples, 300000u);
  EXPECT_EQ(c.angles().size(), 4u);
  Random random(1);
  expect_slices(c, random, 8);
  // Shifted by a fraction of the gap nothing fits exactly, and events come one after the other.
  const CspaceObstacle loose = CspaceObstacle::create(shapes::comb(6, 2, 0.75, 5), shapes::comb(7, 2, 1, 4)).value();
  expect_slices(loose, random, 1000);
}

// Teeth on a long handle: lines come together at quarter turns so closely that doubles do not tell their order beside
// them; 2.5 million triples.
TEST(CspaceQuarterTurn, an_order_that_doubles_do_not_tell_beside_a_quarter_turn_is_kept_too) {
  Ring ring{{0, -1}, {1000, -1}, {1000, 0}, {31, 0}};
  const int last = oracles::kSanitized ? 8 : 15;
  for (int tooth = last; tooth >= 0; --tooth) {
    const double left = 2 * tooth;
    if (tooth < last) ring.push_back({left + 1, 0});
    ring.insert(ring.end(), {{left + 1, 5}, {left, 5}});
    if (tooth > 0) ring.push_back({left, 0});
  }
  const Region comb = polygon(ring);
  const CspaceObstacle c = CspaceObstacle::create(comb, comb).value();
  EXPECT_LT(c.work().candidate_triples, 800000u);
  Random random(1);
  expect_slices(c, random, 4);
}

// Teeth of half a cell had no cell inside them: 217,000 pairs.
TEST(CspaceQuarterTurn, cells_are_finer_than_teeth) {
  const Region comb = shapes::comb(13, 3, 1, 5);
  const CspaceObstacle c = CspaceObstacle::create(comb, comb).value();
  EXPECT_LT(c.work().candidate_pairs, 180000u);
  EXPECT_EQ(c.angles().size(), 8u);
  Random random(1);
  expect_slices(c, random, 12);
}

// All edges are equally long; of the first 24 alone most sectors of the sum had no dead cells: 1.3 million pairs.
TEST(CspaceQuarterTurn, no_sector_of_a_star_is_left_without_dead_cells) {
  const Region star = snapped_shapes::star(oracles::kSanitized ? 15 : 30, 0.2, 1);
  const CspaceObstacle c = CspaceObstacle::create(star, star).value();
  EXPECT_LT(c.work().candidate_pairs, 1000000u);
  Random random(1);
  expect_slices(c, random, 4);
}

// Coordinates beyond 2^28 steps of the grid: the events are made, and tell the same.
TEST(CspaceQuarterTurn, fine_coordinates_go_through_the_events) {
  const Region coarse = shapes::comb(4, 1, 0.25, 3), robot = shapes::letter_l(2, 2, 0.5);
  const auto far = [](const Region& r) {
    RegionData data = r.data();
    data.parts.push_back({box(100, 100, 100 + 0x1p-30, 100 + 0x1p-30), {}});
    return *Region::create(data);
  };
  const CspaceObstacle c = CspaceObstacle::create(robot, coarse).value();
  const CspaceObstacle d = CspaceObstacle::create(robot, far(coarse)).value();
  Random random(1);
  expect_slices(c, random, 100);
  expect_slices(d, random, 100);
  EXPECT_EQ(d.shells().size(), c.shells().size() + 1);
}

// Rooms of the robot's own shape, at whose quarter turns it is free or held: all that the events told.
TEST(CspaceQuarterTurn, exact_fits_are_found) {
  const Region room = polygon(
      box(-20, -20, 20, 20),
      {reversed({{0, 0}, {6, 0}, {6, 2}, {5, 2}, {5, 1}, {4, 1}, {4, 2}, {3, 2}, {3, 1}, {2, 1}, {2, 3}, {0, 3}})});
  const Region robot =
      polygon({{0, 0}, {6, 0}, {6, 2}, {5, 2}, {5, 1}, {4, 1}, {4, 2}, {3, 2}, {3, 1}, {2, 1}, {2, 3}, {0, 3}});
  const CspaceObstacle c = CspaceObstacle::create(robot, room).value();
  EXPECT_EQ(tight_at(c, 0), 1u);
  EXPECT_EQ(count_of_tight_events(c), 1u);
  EXPECT_EQ(c.shells().size(), 1u);
}

}  // namespace
}  // namespace dymsum
