// The planner where passages leave little room: ladders round corners, a keyhole, several in a row. What is free is
// known from formulas, so that both answers are tested on either side of the limit.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>

#include "cspace/planner/test_rooms.h"
#include "dymsum/planner.h"
#include "oracles/sanitized.h"

namespace dymsum {
namespace {

using namespace test_rooms;

Region shape(Ring outer, std::vector<Ring> holes = {}) {
  RegionData data;
  data.parts = {{std::move(outer), std::move(holes)}};
  return repair(std::move(data)).value().region;
}

// At angle t the longest ladder that touches both outer walls and the inner corner has (a cos t + b sin t - w) /
// (sin t cos t). The least of these lengths, by narrowing an interval around it.
double longest_ladder(double a, double b, double w) {
  const auto length = [&](double t) { return (a * std::cos(t) + b * std::sin(t) - w) / (std::sin(t) * std::cos(t)); };
  double low = 1e-3, high = std::numbers::pi / 2 - 1e-3;
  for (int k = 0; k < 300; ++k) {
    const double t = low + (high - low) / 3, u = high - (high - low) / 3;
    (length(t) < length(u) ? high : low) = length(t) < length(u) ? u : t;
  }
  return length(low);
}

// Corridors a high and b wide that meet in a corner at the origin.
CspaceObstacle round_the_corner(double length, double w, double a, double b) {
  const double far = 10 * (a + b);
  const Ring corridor{{0, 0}, {far, 0}, {far, a}, {b, a}, {b, far}, {0, far}};
  return CspaceObstacle::create(shape(box(0, 0, length, w)), shape(box(-1, -1, far + 1, far + 1), {corridor})).value();
}

Plan plan_round(const CspaceObstacle& c, double w, double a, double b, Touching touching) {
  PlanOptions options;
  options.touching = touching;
  return plan(c, {2 * b, (a - w) / 2, 0}, {(b - w) / 2, 8 * a + 2 * b, -std::numbers::pi / 2}, options).value();
}

// Every piece by the public checks; of a long path every `stride`th.
void expect_free(const CspaceObstacle& c, const Plan& p, Touching touching, std::size_t stride = 1) {
  ASSERT_TRUE(p.found()) << p.reason->text;
  for (std::size_t k = 1; k < p.path.size(); k += stride) {
    expect_free_piece(c, p, k, touching);
    if (testing::Test::HasFatalFailure()) return;
  }
}

// 88 ladders, a fraction of them unless DYMSUM_FUZZ_PLANS requests more: all are found that fit, and none that does
// not.
TEST(NarrowPassages, ladders_round_a_corner) {
  const char* more = std::getenv("DYMSUM_FUZZ_PLANS");
  const int stride = more != nullptr && std::atoi(more) > 12 ? 1 : oracles::kSanitized ? 27 : 9;
  constexpr double kSlack[] = {0.05, 0.02, 0.01, 0.005, 0.002, 0.001, 0.0003, 0.0001};
  for (int k = 0; k < 88; k += stride) {
    const double slack = kSlack[k % 8], w = 0.015625 * (1 + 3 * (k / 8)), a = 1, b = k % 3 == 0 ? 1 : 1.75;
    SCOPED_TRACE(testing::Message() << "ladder " << k << ", width " << w << ", slack " << slack);
    const double most = longest_ladder(a, b, w);
    const Touching touching = k % 2 == 0 ? Touching::forbidden : Touching::allowed;
    const CspaceObstacle wide = round_the_corner(most * (1 - slack), w, a, b);
    const Plan p = plan_round(wide, w, a, b, touching);
    expect_free(wide, p, touching, stride == 1 || p.path.size() < 100 ? 1 : 37);
    const CspaceObstacle narrow = round_the_corner(most * (1 + slack), w, a, b);
    const Plan none = plan_round(narrow, w, a, b, touching);
    ASSERT_FALSE(none.found());
    EXPECT_EQ(none.reason->kind, NoPath::Kind::separated) << none.reason->text;
    if (testing::Test::HasFatalFailure()) return;
  }
}

// At the angle of a triangle with sides 3, 4, 5 everything is rational: 150 is the longest ladder, 27 wide, in
// corridors of 54 and 93, and it passes there by touching alone, along a curve.
TEST(NarrowPassages, the_longest_ladder_round_a_corner_to_the_last_bit) {
  const auto answer = [](double length, Touching touching) {
    return plan_round(round_the_corner(length, 27, 54, 93), 27, 54, 93, touching);
  };
  EXPECT_NEAR(longest_ladder(54, 93, 27), 150, 1e-9);
  const double longer = std::nextafter(150.0, 151.0);
  for (const Touching touching : {Touching::allowed, Touching::forbidden}) {
    EXPECT_EQ(answer(longer, touching).reason->kind, NoPath::Kind::separated);
    EXPECT_TRUE(answer(150 * (1 - 1e-4), touching).found());
  }
  EXPECT_EQ(answer(150, Touching::forbidden).reason->kind, NoPath::Kind::separated);
}

// Two rooms and a wall between them, 2 t thick, with a doorway.
Region rooms(double t, double doorway) {
  const double h = doorway / 2;
  return shape(box(-12, -6, 12, 6), {{{-11, -5},
                                      {-11, 5},
                                      {-t, 5},
                                      {-t, h},
                                      {t, h},
                                      {t, 5},
                                      {11, 5},
                                      {11, -5},
                                      {t, -5},
                                      {t, -h},
                                      {-t, -h},
                                      {-t, -5}}});
}

// A rod has no width: the longest one is (a^(2/3) + b^(2/3))^(3/2), 125 for corridors 27 and 64 wide.
TEST(NarrowPassages, the_longest_rod_round_a_corner_to_the_last_bit) {
  const auto go = [](double length, Touching touching) {
    RegionData rod;
    rod.polylines.push_back({{0, 0}, {length, 0}});
    const double far = 910;
    const Ring corridor{{0, 0}, {far, 0}, {far, 27}, {64, 27}, {64, far}, {0, far}};
    const CspaceObstacle c =
        CspaceObstacle::create(*Region::create(rod), shape(box(-1, -1, far + 1, far + 1), {corridor})).value();
    const Plan p = plan_round(c, 0, 27, 64, touching);
    if (p.found()) expect_free(c, p, touching, 50);
    return p;
  };
  EXPECT_TRUE(go(125 * (1 - 1e-4), Touching::forbidden).found());
  EXPECT_EQ(go(std::nextafter(125, 126), Touching::allowed).reason->kind, NoPath::Kind::separated);
  EXPECT_EQ(go(125, Touching::forbidden).reason->kind, NoPath::Kind::separated);
}

// An L of arms 1 wide goes through a wall round its inner corner where the doorway is as wide as sqrt 2 and half the
// wall: it turns and moves at once all the way.
TEST(NarrowPassages, an_L_through_a_keyhole) {
  const Region robot = shape({{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}});
  for (const double t : {0.25, 1.0})
    for (const double slack : {1e-2, 1e-3, 1e-4}) {
      if (oracles::kSanitized && (t == 1) != (slack == 1e-3)) continue;
      SCOPED_TRACE(testing::Message() << "wall " << t << ", slack " << slack);
      const double width = std::sqrt(2.0) + t;
      PlanOptions options;
      options.touching = slack == 1e-3 ? Touching::allowed : Touching::forbidden;
      const auto c = CspaceObstacle::create(robot, rooms(t, width * (1 + slack)));
      expect_free(*c, plan(*c, {-7, -2, 0}, {7, 2, std::numbers::pi}, options).value(), options.touching,
                  slack < 1e-3 ? 29 : 7);
      const auto none = CspaceObstacle::create(robot, rooms(t, width * (1 - slack)));
      const Plan p = plan(*none, {-7, -2, 0}, {7, 2, std::numbers::pi}, options).value();
      ASSERT_FALSE(p.found());
      EXPECT_EQ(p.reason->kind, NoPath::Kind::separated);
    }
}

// Four corners one after another, to the left and to the right.
TEST(NarrowPassages, several_in_a_row) {
  const double w = 0.25, length = longest_ladder(1, 1, w) * 0.999;
  const Ring zigzag{{0, 0},   {10, 0},  {10, 9},  {19, 9}, {19, 18}, {27, 18},
                    {27, 19}, {18, 19}, {18, 10}, {9, 10}, {9, 1},   {0, 1}};
  const Region obstacle = shape(box(-1, -1, 29, 20), {zigzag});
  const CspaceObstacle c = CspaceObstacle::create(shape(box(0, 0, length, w)), obstacle).value();
  const Configuration start{1, 0.4, 0}, goal{21, 18.3, 0};
  PlanOptions options;
  for (const Touching touching : {Touching::allowed, Touching::forbidden}) {
    if (oracles::kSanitized && touching == Touching::forbidden) continue;
    options.touching = touching;
    expect_free(c, plan(c, start, goal, options).value(), touching, 31);
  }
  // On the floor: the start touches.
  EXPECT_EQ(plan(c, {1, 0, 0}, goal, options)->reason->kind, NoPath::Kind::start_not_free);
  EXPECT_TRUE(plan(c, {1, 0, 0}, {21, 18, 0})->found());
}

TEST(NarrowPassages, undecided_says_where) {
  const CspaceObstacle c = round_the_corner(longest_ladder(1, 1, 0.25) * 0.9999, 0.25, 1, 1);
  PlanOptions options;
  options.time_limit_seconds = 0;
  const Plan p = plan(c, {2, 0.4, 0}, {0.4, 9, -std::numbers::pi / 2}, options).value();
  ASSERT_FALSE(p.found());
  EXPECT_EQ(p.reason->kind, NoPath::Kind::undecided);
  ASSERT_TRUE(p.reason->limit.has_value());
  EXPECT_TRUE(p.reason->limit->out_of_time);
  EXPECT_EQ(p.reason->limit->seconds, 0);
  ASSERT_TRUE(p.reason->limit->passage.has_value());
  EXPECT_EQ(p.reason->limit->passage->reached.x, 2);
  EXPECT_NE(p.reason->text.find("time limit of 0 s"), std::string::npos) << p.reason->text;
  options.time_limit_seconds = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(plan(c, {2, 0.4, 0}, {0.4, 9, -std::numbers::pi / 2}, options)->found());
  for (const double wrong : {-1.0, std::nan("")}) {
    options.time_limit_seconds = wrong;
    EXPECT_EQ(plan(c, {2, 0.4, 0}, {0.4, 9, -std::numbers::pi / 2}, options).error().code, ErrorCode::out_of_range);
  }
}

}  // namespace
}  // namespace dymsum
