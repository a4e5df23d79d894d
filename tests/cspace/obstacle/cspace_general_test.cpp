// The obstacle of any two regions: every slab against static slices, on tiny integer grids where events coincide in
// hundreds, and the same obstacle by whole slices.
#include "cspace/obstacle/obstacle_slices.h"

#include "dymsum/shapes.h"
#include "oracles/snapped_shapes.h"

namespace dymsum {
namespace {

using namespace testing_obstacles;

TEST(CspaceGeneral, random_pairs_equal_slices) {
  for_seeds(400, [](Random& random) {
    const bool hole = random() % 3 == 0;
    const int reach = random() % 2 == 0 ? 5 : 1000;
    const Region robot = random_shape(random, reach, 6, false),
                 obstacle = random_shape(random, hole ? 2 * reach : reach, 7, hole);
    const Result<CspaceObstacle> c = CspaceObstacle::create(robot, obstacle);
    ASSERT_TRUE(c.ok()) << c.error().message;
    expect_slices(*c, random, 400);
  });
}

TEST(CspaceGeneral, several_parts_and_holes_equal_slices) {
  for_seeds(8, [](Random& random) {
    const int reach = random() % 2 == 0 ? 6 : 1000;
    const Region robot = random_shape(random, reach, 5, false, 1 + static_cast<int>(random() % 2));
    const Region obstacle = random_shape(random, 2 * reach, 7, random() % 2 == 0, 1 + static_cast<int>(random() % 2));
    const Result<CspaceObstacle> c = CspaceObstacle::create(robot, obstacle);
    ASSERT_TRUE(c.ok()) << c.error().message;
    expect_slices(*c, random, 60);
    for (const Patch& p : c->patches()) ASSERT_LT(p.shell, c->shells().size());
    for (const FreeCell& cell : c->free_cells()) ASSERT_LT(cell.component, free_components(*c));
  });
}

TEST(CspaceGeneral, robots_in_rooms_equal_slices) {
  for_seeds(100, [](Random& random) {
    const bool cells = random() % 2 == 0;
    const int reach = random() % 2 == 0 ? 6 : 1000;
    const Region robot = cells ? random_cells(random, 2, 1) : random_shape(random, std::max(2, reach / 3), 5, false);
    RegionData data;
    data.parts.push_back({box(-40.0 * reach, -40.0 * reach, 40.0 * reach, 40.0 * reach), {}});
    const Region room = cells ? random_cells(random, 4, 1 + static_cast<double>(random() % 3) / 2)
                              : random_shape(random, reach, 8, false);
    for (const Part& part : room.parts()) data.parts[0].holes.push_back(reversed(part.outer));
    const CspaceObstacle c = CspaceObstacle::create(robot, *Region::create(data)).value();
    expect_slices(c, random, 200);
    // Rooms of configuration space are closed surfaces.
    for (const Shell& shell : c.shells()) ASSERT_EQ(shell.euler % 2, 0);
  });
}

// Decimal distances: points that would be one, or in line, differ by rounding, and events come within 10^-16 of each
// other.
TEST(CspaceGeneral, several_parts_at_decimal_distances_equal_slices) {
  const auto parts = [](Random& random, int reach, int most, int count, double step) {
    RegionData data;
    while (static_cast<int>(data.parts.size()) < count) {
      RegionData more = data;
      more.parts.push_back(
          {random_ring(random, reach, most, step * reach * static_cast<double>(data.parts.size())), {}});
      const Result<Repaired> repaired = repair(more);
      if (repaired.ok() && repaired->region.touching_points().empty() &&
          repaired->region.parts().size() == more.parts.size())
        data = more;
    }
    return data;
  };
  for_seeds(60, [&](Random& random) {
    const bool large = random() % 3 == 0;
    RegionData obstacle = parts(random, large ? 20 : 6, large ? 7 : 6, 1 + static_cast<int>(random() % 3), 2.2);
    if (random() % 2 == 0) {
      const double q = 8 + static_cast<double>(random() % 30), wide = q + static_cast<double>(random() % 40);
      RegionData room = obstacle;
      room.parts.push_back({box(-60, -60, 90, 60), {{{-q, -q}, {-q, q}, {wide, q}, {wide, -q}}}});
      const Result<Region> region = Region::create(room);
      if (region.ok() && region->touching_points().empty()) obstacle = room;
    }
    const RegionData robot = parts(random, random() % 2 == 0 ? 3 : 8, 6, 1 + static_cast<int>(random() % 2), 1.5);
    const Result<Repaired> r = repair(robot), o = repair(obstacle);
    ASSERT_TRUE(r.ok() && o.ok());
    expect_slices(CspaceObstacle::create(r->region, o->region).value(), random, 12);
  });
}

// The fourth and the last two vertices of the obstacle are in line but for the last bit: six events within 10^-16, at
// one of which two of three segments are nearly parallel.
CspaceObstacle nearly_in_line() {
  RegionData robot, obstacle;
  robot.parts = {{{{-5, -4}, {-2, -7}, {6, 4}, {0, 8}, {-3, 0}, {-1, -4}}, {}},
                 {{{13, -8}, {16, -8}, {19, 6}, {9, 6}, {11, -4}}, {}}};
  obstacle.parts = {{{{3, -2}, {5, -2}, {4, 5}, {-2, 3}}, {}},
                    {{{19.200000000000003, 6},
                      {17.200000000000003, 6},
                      {12.200000000000001, -3},
                      {10.200000000000001, 6},
                      {11.200000000000001, -5}},
                     {}},
                    {{{27.400000000000002, 0}, {32.400000000000006, 0}, {21.400000000000002, 5}}, {}}};
  return CspaceObstacle::create(*Region::create(robot), *Region::create(obstacle)).value();
}

// The crossing of the two told nothing about the position, which was taken for covered.
TEST(CspaceGeneral, places_of_events_of_nearly_parallel_segments_are_not_guessed) {
  Random random(1);
  expect_slices(nearly_in_line(), random, 1000);
}

TEST(CspaceGeneral, whole_slices_give_the_same_obstacle) {
  for_seeds(25, [](Random& random) {
    const Region robot = random_shape(random, 5, 6, false), obstacle = random_shape(random, 10, 7, true);
    const CspaceObstacle fast = CspaceObstacle::create(robot, obstacle).value();
    ObstacleOptions options;
    options.reference = true;
    const CspaceObstacle slow = CspaceObstacle::create(robot, obstacle, options).value();
    EXPECT_EQ(fast.shells().size(), slow.shells().size());
    EXPECT_EQ(free_components(fast), free_components(slow));
    EXPECT_GE(slow.angles().size(), fast.angles().size());
    for (std::uint32_t slab = 0; slab < slabs(slow); ++slab) {
      const Orientation at = slow.inside(slab);
      const std::optional<std::uint32_t> same = fast.slab_of(at);
      if (same) {
        ASSERT_EQ(of_slab(slow, slab), of_slab(fast, *same));
      }
    }
  });
}

TEST(CspaceGeneral, shapes_with_many_coinciding_events_equal_slices) {
  Random random(1);
  const std::vector<std::pair<Region, Region>> pairs = {
      {snapped_shapes::star(5, 0.5, 1), snapped_shapes::star(5, 0.5, 1)},
      {shapes::grate(4, 2, 1, 6), shapes::grate(3, 2, 0.5, 5)},
      {shapes::letter_l(3, 3, 1), shapes::letter_l(3, 3, 1)},
      {shapes::letter_u(3, 3, 1), shapes::comb(4, 2, 1, 2)},
      {snapped_shapes::gear(6, 0.8, 1), snapped_shapes::gear(8, 1.5, 2)},
      {shapes::rectangle(0, 0, 1, 1), snapped_shapes::pockets(6, 10)},
      {shapes::noisy_star(30, 0.5, 1), shapes::noisy_star(25, 0.5, 2)}};
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    SCOPED_TRACE(testing::Message() << "pair " << k);
    const Result<CspaceObstacle> c = CspaceObstacle::create(pairs[k].first, pairs[k].second);
    ASSERT_TRUE(c.ok()) << c.error().message;
    expect_slices(*c, random, 120);
    EXPECT_GT(c->work().local_updates + c->work().slices, 0u);
  }
}

TEST(CspaceGeneral, a_square_in_its_exact_cavity_is_held_at_quarter_turns_only) {
  const Region robot = polygon(box(-1, -1, 1, 1)), obstacle = polygon(box(-5, -5, 5, 5), {reversed(box(-1, -1, 1, 1))});
  const CspaceObstacle c = CspaceObstacle::create(robot, obstacle).value();
  for (const double theta : {-M_PI / 2, 0.0, M_PI / 2, M_PI}) EXPECT_EQ(tight_at(c, theta), 1u) << theta;
  EXPECT_EQ(free_components(c), 1u);
  EXPECT_FALSE(c.contains(0, 0, Orientation()));
  EXPECT_TRUE(c.contains(0, 0, *Orientation::of(1, 1000000000)));
}

TEST(CspaceGeneral, a_cavity_a_hair_larger_is_a_closed_room_of_its_own) {
  const double hair = 1 + 0x1p-20;
  const Region robot = polygon(box(-1, -1, 1, 1)),
               obstacle = polygon(box(-5, -5, 5, 5), {reversed(box(-hair, -hair, hair, hair))});
  const CspaceObstacle c = CspaceObstacle::create(robot, obstacle).value();
  EXPECT_EQ(free_components(c), 5u);  // outside, and a room around every quarter turn
  EXPECT_EQ(c.shells().size(), 5u);
  for (const Shell& shell : c.shells()) EXPECT_EQ(shell.euler, shell.outer ? 0 : 2);
}

TEST(CspaceGeneral, an_island_in_a_room_shares_its_free_component) {
  RegionData data;
  data.parts.push_back({box(-10, -10, 10, 10), {reversed(box(-8, -8, 8, 8))}});
  data.parts.push_back({box(-1, -1, 1, 1), {}});
  const Region robot = polygon(box(-0.5, -0.25, 0.5, 0.25));
  const CspaceObstacle c = CspaceObstacle::create(robot, *Region::create(data)).value();
  EXPECT_EQ(free_components(c), 2u);  // the room around the island, and outside
  EXPECT_EQ(c.shells().size(), 3u);
}

TEST(CspaceGeneral, an_alignment_with_a_third_vertex_in_line_changes_hands) {
  // Robot vertices 1, 3 and 4 are in line: at the alignment of edge 3 a segment begins on the very line of a visible
  // one.
  const Region robot = polygon({{0, 0}, {-2, -2}, {2, 0}, {-2, 2}, {-2, -1}});
  const Region obstacle =
      polygon(box(-240, -240, 240, 240), {{{3, -6}, {-6, -3}, {-5, 4}, {-3, -3}, {-2, 0}, {-4, 5}}});
  Random random(1);
  expect_slices(CspaceObstacle::create(robot, obstacle).value(), random, 1000);
}

TEST(CspaceGeneral, segments_that_live_for_a_millionth_of_a_turn_have_their_events) {
  // Nearly straight chains, as six digits leave them: edges whose directions differ by some millionths.
  const Region shape = polygon({{-2.886511, 4.636227},
                                {-3.873049, 5.009661},
                                {-4.207426, 5.136232},
                                {-4.124304, 4.636227},
                                {-3.873049, 3.124781},
                                {-3.750273, 2.386228},
                                {-3.707415, 2.128419},
                                {-3.873049, 2.065723},
                                {-6.473051, 1.081543},
                                {-5.393225, 0.136228},
                                {-4.894720, -2.113772},
                                {2.800402, -3.543459}});
  Random random(1);
  expect_slices(CspaceObstacle::create(shape, shape).value(), random, 2000);
}

// Some angles are equal as doubles: their half tangents distinguish them, in the order of the list.
TEST(CspaceGeneral, half_tangents_tell_all_event_angles_apart) {
  const CspaceObstacle c = nearly_in_line();
  int equal_doubles = 0;
  for (std::uint32_t k = 0; k < c.angles().size(); ++k) {
    const CspaceObstacle::HalfTangent t = c.half_tangent(k);
    const double theta = 2 * std::atan(t.high) + (t.opposite ? std::numbers::pi : 0);
    EXPECT_NEAR(std::remainder(theta - c.angles()[k].theta, 2 * std::numbers::pi), 0, 1e-13);
    EXPECT_LE(std::abs(t.low), 0x1p-52 * std::abs(t.high));
    if (k == 0) continue;
    equal_doubles += c.angles()[k].theta == c.angles()[k - 1].theta;
    const CspaceObstacle::HalfTangent before = c.half_tangent(k - 1);
    if (before.opposite != t.opposite || (before.high > 0) != (t.high > 0)) continue;
    EXPECT_GT((t.high - before.high) + (t.low - before.low), 0) << k;
  }
  EXPECT_GT(equal_doubles, 0);
}

// Three obstacle edges on lines through the origin and three robot vertices T_i = d_i from it: with weights d_j x d_k
// the concurrency of the three segments vanishes as a polynomial, and around theta = 0 the segments do meet. They begin
// to and end to where one of them does: an event of its end on the other two.
TEST(CspaceGeneral, three_segments_concurrent_at_every_angle_need_no_whole_slices) {
  const Ring reflected = {{9, 3},  {10, 0}, {11, 3}, {20, 3}, {13, 9}, {10, 10},
                          {11, 7}, {9, 5},  {3, 11}, {0, 10}, {3, 9},  {8, 4}};
  Ring robot;
  for (const Point& p : reflected) robot.push_back({-p.x, -p.y});
  RegionData data;
  data.parts.push_back({{{-13, 0}, {-7, 0}, {-10, 4}}, {}});
  data.parts.push_back({{{0, -7}, {0, -13}, {4, -10}}, {}});
  data.parts.push_back({{{-8, -8}, {-12, -12}, {-8, -12}}, {}});
  const CspaceObstacle c = CspaceObstacle::create(polygon(robot), *Region::create(data)).value();
  EXPECT_GT(c.work().local_updates, 200u);
  EXPECT_LT(c.work().slices, 20u);
  Random random(1);
  expect_slices(c, random, 1000);
}

// Two bars on either arm of both, all of one width and at equal distances: the same thing happens at several positions
// at once, often along one segment. That takes no whole slice.
TEST(CspaceGeneral, events_at_one_angle_and_several_places_are_handled_one_by_one) {
  const Region robot =
      polygon({{-1, -1},    {31.125, -1}, {31.125, 0}, {30.125, 0}, {30.125, 8}, {30, 8},     {30, 0},     {28.125, 0},
               {28.125, 8}, {28, 8},      {28, 0},     {0, 0},      {0, 28},     {8, 28},     {8, 28.125}, {0, 28.125},
               {0, 30},     {8, 30},      {8, 30.125}, {0, 30.125}, {0, 31.125}, {-1, 31.125}});
  const Region obstacle =
      polygon({{0, 19}, {19, 19},    {19, 0},     {20, 0},     {20, 1},  {28, 1},     {28, 1.125}, {20, 1.125},
               {20, 2}, {28, 2},     {28, 2.125}, {20, 2.125}, {20, 20}, {2.125, 20}, {2.125, 28}, {2, 28},
               {2, 20}, {1.125, 20}, {1.125, 28}, {1, 28},     {1, 20},  {0, 20}});
  const CspaceObstacle c = CspaceObstacle::create(robot, obstacle).value();
  Random random(1);
  expect_slices(c, random, 1000);
  EXPECT_LT(c.work().slices, 50u);  // 86 where a shared segment was enough for one
  EXPECT_EQ(c.shells().size(), 17u);
  ObstacleOptions options;
  options.reference = true;
  const CspaceObstacle slow = CspaceObstacle::create(robot, obstacle, options).value();
  EXPECT_EQ(slow.shells().size(), 17u);
  EXPECT_EQ(free_components(slow), free_components(c));
}

// Two opposite segments come to lie along each other, with an event at either end: one of them begins a loop near its
// position, the other one needs a whole slice, in which that loop is none. It was left without patches.
TEST(CspaceGeneral, an_event_is_not_handled_where_another_one_of_its_angle_takes_a_slice) {
  const Ring star{{16, 2}, {4, 3}, {4, 13}, {-4, -3}, {-4, -13}, {9, -12}, {4, -1}};
  const std::vector<Ring> pins{{{20, 6}, {21, 6}, {19, 7}}, {{29, 16}, {29, 17}, {28, 16}}};
  Random random(1);
  // In a mirror the events come in another order; so they do with the pins or the vertices numbered from others.
  for (const bool mirrored : {false, true})
    for (std::size_t first = 0; first < star.size(); ++first)
      for (const bool swapped : {false, true}) {
        const auto seen = [&](Ring ring) {
          if (!mirrored) return ring;
          for (Point& p : ring) p.x = -p.x;
          return reversed(ring);
        };
        Ring robot = star;
        std::rotate(robot.begin(), robot.begin() + static_cast<std::ptrdiff_t>(first), robot.end());
        RegionData obstacle;
        for (const bool second : {swapped, !swapped}) obstacle.parts.push_back({seen(pins[second ? 1 : 0]), {}});
        const CspaceObstacle c = CspaceObstacle::create(polygon(seen(robot)), *Region::create(obstacle)).value();
        expect_slices(c, random, 1000);
        for (const FreeCell& cell : c.free_cells()) EXPECT_TRUE(cell.begin == Patch::kNone || cell.begin != cell.end);
      }
}

// A rhombus in a corridor as high as its longer diagonal is held, upright, between floor and ceiling: touching is no
// connection, so there is a room for either half of the turn.
TEST(CspaceGeneral, a_passage_that_is_shut_at_one_angle_separates) {
  const auto room = [](double half_width, double half_height) {
    return polygon(box(-40, -40, 40, 40), {reversed(box(-half_width, -half_height, half_width, half_height))});
  };
  const Region rhombus = polygon({{2, 0}, {0, 1}, {-2, 0}, {0, -1}}),
               diamond = polygon({{2, 0}, {0, 2}, {-2, 0}, {0, -2}});
  Random random(1);
  for (const bool reference : {false, true}) {
    ObstacleOptions options;
    options.reference = reference;
    const CspaceObstacle shut = CspaceObstacle::create(rhombus, room(20, 2), options).value();
    EXPECT_EQ(free_components(shut), 3u);
    EXPECT_EQ(shut.shells().size(), 3u);
    for (const Shell& shell : shut.shells()) EXPECT_EQ(shell.euler, shell.outer ? 0 : 2);
    expect_slices(shut, random, 100);
    // A hair higher it turns all round, a hair lower it never stands upright.
    EXPECT_EQ(free_components(CspaceObstacle::create(rhombus, room(20, 2.0625), options).value()), 2u);
    EXPECT_EQ(free_components(CspaceObstacle::create(rhombus, room(20, 1.9375), options).value()), 3u);
    // In a square room of the diagonal's size the loop shrinks to a point four times a turn.
    const CspaceObstacle point = CspaceObstacle::create(diamond, room(2, 2), options).value();
    EXPECT_EQ(free_components(point), 5u);
    EXPECT_EQ(point.shells().size(), 5u);
    for (const Shell& shell : point.shells()) EXPECT_EQ(shell.euler, shell.outer ? 0 : 2);
    expect_slices(point, random, 100);
    // Two rooms and a corridor between them that is shut at one angle: the rooms are not.
    const Ring rooms{{-20, -5}, {-10, -5}, {-10, -2}, {10, -2}, {10, -5}, {20, -5},
                     {20, 5},   {10, 5},   {10, 2},   {-10, 2}, {-10, 5}, {-20, 5}};
    const Region dumbbell = polygon(box(-40, -40, 40, 40), {reversed(rooms)});
    EXPECT_EQ(free_components(CspaceObstacle::create(rhombus, dumbbell, options).value()), 2u);
  }
}

}  // namespace
}  // namespace dymsum
