// Overlays that follow a motion: equal to those from nothing, whichever operand is walked, and repaired where they
// broke only.
#include "spatial/gauss/overlay.h"

#include <map>
#include <numbers>
#include <set>
#include <string>

#include "spatial/convex/convex_cases.h"
#include "spatial/convex/setting.h"
#include "spatial/gauss/as_built.h"

namespace dymsum::test {
namespace {

using spatial::Crossing;
using spatial::kNoCrossing;
using spatial::Overlay;
using spatial::Polytope;
using spatial::PoseFactors;
using spatial::RelativeMap;

/// A prism over a regular polygon whose side faces lean by a little: its arcs from the caps to the sides are long.
Mesh leaning_prism(int sides, double height) {
  std::vector<Point3> at;
  const auto snap = [](double v) { return std::nearbyint(v * 0x1p20) * 0x1p-20; };
  for (int k = 0; k < sides; ++k) {
    const double angle = 2 * std::numbers::pi * k / sides;
    at.push_back({snap(std::cos(angle)), snap(std::sin(angle)), 0});
    at.push_back({snap(1.1 * std::cos(angle)), snap(1.1 * std::sin(angle)), height});
  }
  return *convex_hull(at);
}

/// A box one of whose faces bulges a little over a grid of points: many normals close together, and cells far smaller
/// than usual moves.
Mesh bulging_box(int n, double bulge) {
  std::vector<Point3> at{{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1}};
  for (int i = -n; i <= n; ++i)
    for (int j = -n; j <= n; ++j) {
      const double x = static_cast<double>(i) / n, y = static_cast<double>(j) / n;
      at.push_back({x, y, std::nearbyint(0x1p20 * bulge * (2 - x * x - y * y - 0.1 * x * x * y)) * 0x1p-20});
    }
  return *convex_hull(at);
}

std::string position(std::uint64_t seed, std::size_t pair, std::uint64_t move) {
  return "seed " + std::to_string(seed) + " pair " + std::to_string(pair) + " move " + std::to_string(move);
}

/// Few faces with long arcs and many with short ones, the former as P, as Q and on both sides.
std::vector<PolytopePair> pairs_of_long_arcs(std::mt19937_64& random) {
  const auto make = [](const Mesh& mesh) { return *spatial::make_polytope(mesh); };
  const Polytope prism = make(leaning_prism(24, 1.5)), rod = make(leaning_prism(5, 6));
  const Polytope ball = make(random_round_polytope(random, 150)), other = make(random_round_polytope(random, 60));
  const Polytope tips = make(spindle(20)), sharp = make(spindle(70));  // of many edges
  return {{prism, ball}, {ball, prism}, {rod, ball},  {ball, rod},    {prism, rod},  {other, ball},
          {ball, other}, {other, tips}, {tips, ball}, {other, sharp}, {sharp, ball}, {sharp, tips}};
}

TEST(OverlayUpdate, equals_the_static_overlay_and_reports_its_changes) {
  const std::uint64_t seed = setting("DYMSUM_FUZZ_SEED", 51), moves = setting("DYMSUM_FUZZ_MOVES", 2100);
  std::mt19937_64 random(seed);
  const std::vector<double> angles{1e-5, 1e-3, 0.005, 0.0126, 0.03, 0.08, 0.2, 2};
  const std::vector<PolytopePair> all = pairs_of_long_arcs(random);
  for (std::size_t i = 0; i < all.size(); ++i) {
    Overlay moving(all[i].p, all[i].q);
    SolidPose pose{random_rotation(random), {}};
    moving.build(map_of(pose));
    for (std::uint64_t k = 0; k < moves / all.size(); ++k) {
      if (random() % 20 == 0) {
        pose.scale = {random_scale(random), random_scale(random), random_scale(random)};
      } else if (random() % 4 == 0) {
        pose.scale[random() % 3] = *Scale::of(1 + 1e-3 * static_cast<double>(random() % 30));
      } else {
        pose.rotation = small_rotation(random, angles[random() % angles.size()]) * pose.rotation;
      }
      const Overlay before = moving;
      const RelativeMap map = map_of(pose);
      moving.update(map);
      expect_as_built(before, moving, map, position(seed, i, k));
      if (HasFatalFailure()) return;
    }
  }
}

TEST(OverlayUpdate, short_moves_into_ties_and_out_of_them) {
  const std::uint64_t seed = setting("DYMSUM_FUZZ_SEED", 56), moves = setting("DYMSUM_FUZZ_MOVES", 1200);
  std::mt19937_64 random(seed);
  const std::vector<Rotation> turns{Rotation(),
                                    *Rotation::of(100, 1, 0, 0),
                                    *Rotation::of(100, 0, 1, 0),
                                    *Rotation::of(100, 0, 0, -1),
                                    *Rotation::of(20, 1, 1, 0),
                                    *Rotation::of(30, 1, 1, 1),
                                    *Rotation::of(12, 0, 0, 1),
                                    *Rotation::of(1000, 1, 2, 3)};
  std::uint64_t exact = 0, repaired = 0;
  for (std::size_t i = 0; i < 12; ++i) {
    const Mesh a = random_grid_polytope(random, 8 + static_cast<int>(i), 3);
    const Mesh b = i % 3 == 0 ? negated(a) : i % 3 == 1 ? a : random_grid_polytope(random, 10, 2);
    const Polytope p = *spatial::make_polytope(a);
    const Polytope q = *spatial::make_polytope(b);
    Overlay moving(p, q);
    moving.build(map_of({}));
    for (std::uint64_t k = 0; k < moves / 12; ++k) {
      SolidPose pose{turns[random() % turns.size()], {}};
      if (random() % 4 == 0) pose.scale[random() % 3] = *Scale::of(1.03125);
      const Overlay before = moving;
      moving.update(map_of(pose));
      exact += moving.work().exact_signs;
      repaired += moving.work().crossing_checks;
      expect_as_built(before, moving, map_of(pose), position(seed, i, k));
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(exact, moves);
  EXPECT_GT(repaired, moves);
}

// Turning by hundreds of radians in all leaves room for scales that change by 2^-47.
TEST(OverlayUpdate, minute_steps_are_noticed_after_many_turns) {
  std::mt19937_64 random(58);
  const Polytope p = *spatial::make_polytope(random_grid_polytope(random, 12, 3));
  Overlay moving(p, p);
  moving.build(map_of({}));
  SolidPose pose;
  for (int k = 0; k < 200; ++k) {
    pose.rotation = *Rotation::of(1, k % 2, 0, 0);
    moving.update(map_of(pose));
  }
  std::uint64_t changes = 0;
  for (int k = 3 << 9; k > -(3 << 9); k -= k > 0 ? 1 : 64) {
    pose = {};
    pose.scale[0] = *Scale::of(1 - k * 0x1p-47);
    const Overlay before = moving;
    moving.update(map_of(pose));
    changes += moving.work().vertex_errors;
    if (k % 32 != 0) continue;
    expect_as_built(before, moving, map_of(pose), position(58, 0, static_cast<std::uint64_t>(k + 2000)));
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(changes, 0u);
}

TEST(OverlayUpdate, cells_smaller_than_the_move_jump_over_normals) {
  const std::uint64_t seed = setting("DYMSUM_FUZZ_SEED", 57), moves = setting("DYMSUM_FUZZ_MOVES", 3000);
  std::mt19937_64 random(seed);
  const Polytope box = *spatial::make_polytope(bulging_box(2, 0.05));
  std::uint64_t repaired = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    const Polytope ball = *spatial::make_polytope(random_round_polytope(random, i % 3 == 2 ? 20 : 45));
    Overlay moving(i % 2 ? ball : box, i % 2 ? box : ball);
    moving.build(map_of({}));
    for (std::uint64_t k = 0; k < moves / 6; ++k) {
      const RelativeMap map = map_of({small_rotation(random, 0.1), {}});
      const Overlay before = moving;
      moving.update(map);
      repaired += moving.work().crossing_checks > 0;
      expect_as_built(before, moving, map, position(seed, i, k));
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(2 * repaired, moves) << "not leaps";
}

TEST(OverlayUpdate, either_operand_may_be_walked) {
  std::mt19937_64 random(52);
  for (const PolytopePair& pair : pairs_of_long_arcs(random)) {
    Overlay one(pair.p, pair.q), two(pair.q, pair.p);
    Rotation turn = random_rotation(random);
    for (int k = 0; k < 30; ++k) {
      turn = small_rotation(random, k % 10 == 0 ? 1.0 : 0.01) * turn;
      one.update(map_of({turn, {}}));
      two.update(RelativeMap(PoseFactors{}, PoseFactors::of({turn, {}})));
      std::vector<std::pair<std::uint32_t, std::uint32_t>> a, b;
      for (const auto& [id, edges] : by_number(one)) a.push_back(edges);
      for (const auto& [id, edges] : by_number(two)) b.emplace_back(edges.second, edges.first);
      std::sort(a.begin(), a.end());
      std::sort(b.begin(), b.end());
      ASSERT_EQ(a, b);
      for (int op = 0; op < 2; ++op)
        for (std::uint32_t f = 0; f < one.poly(op).face_count(); ++f)
          ASSERT_EQ(one.extreme(op, f), two.extreme(1 - op, f));
    }
  }
}

TEST(OverlayUpdate, long_arcs_are_walked_where_they_changed) {
  std::mt19937_64 random(53);
  const Polytope rod = *spatial::make_polytope(leaning_prism(5, 6));
  const Polytope ball = *spatial::make_polytope(random_round_polytope(random, 400));
  Overlay moving(rod, ball);
  Rotation turn = random_rotation(random);
  moving.build(map_of({turn, {}}));
  std::uint64_t steps = 0, arcs = 0, checks = 0, changed = 0, crossings = 0;
  for (int k = 0; k < 300; ++k) {
    turn = small_rotation(random, 0.002) * turn;
    moving.update(map_of({turn, {}}));
    steps += moving.work().steps;
    arcs += moving.work().arc_checks;
    checks += moving.work().crossing_checks;
    changed += moving.work().crossings_added;
    crossings += moving.crossing_count();
  }
  const std::uint64_t per_arc = crossings / 300 / rod.edge_count();
  EXPECT_GT(per_arc, 5u);
  EXPECT_GT(changed, 300u);
  EXPECT_LT(steps, 3 * (changed + arcs)) << "not whole arcs";
  EXPECT_LT(3 * steps, per_arc * arcs);
  EXPECT_LT(4 * checks, crossings) << "certificates hold for an angle";
}

TEST(OverlayUpdate, faces_of_the_other_operand_are_not_checked) {
  std::mt19937_64 random(54);
  const Polytope box = *spatial::make_polytope(cube(1));
  const Polytope ball = *spatial::make_polytope(random_round_polytope(random, 200));
  for (const bool box_first : {true, false}) {
    Overlay moving(box_first ? box : ball, box_first ? ball : box);
    Rotation turn = random_rotation(random);
    moving.build(map_of({turn, {}}));
    std::uint64_t checks = 0, changed = 0;
    for (int k = 0; k < 100; ++k) {
      turn = small_rotation(random, 0.01) * turn;
      moving.update(map_of({turn, {}}));
      checks += moving.work().vertex_checks;
      changed += moving.changes().faces[box_first ? 1 : 0].size();
    }
    EXPECT_LE(checks, 6u * 100);
    EXPECT_GT(changed, 100u);
  }
}

TEST(OverlayUpdate, leaps_look_at_no_certificates_and_leave_them_to_the_next_short_move) {
  std::mt19937_64 random(55);
  const Polytope p = *spatial::make_polytope(random_round_polytope(random, 100));
  const Polytope q = *spatial::make_polytope(random_round_polytope(random, 100));
  Overlay moving(p, q);
  Rotation turn = random_rotation(random);
  moving.update(map_of({turn, {}}));
  EXPECT_EQ(moving.work().crossing_checks, 0u);
  EXPECT_EQ(moving.work().arc_checks, p.edge_count());
  turn = small_rotation(random, 1e-6) * turn;
  moving.update(map_of({turn, {}}));
  EXPECT_EQ(moving.work().crossing_checks, moving.crossing_count());
  turn = small_rotation(random, 1e-6) * turn;
  moving.update(map_of({turn, {}}));
  EXPECT_LT(moving.work().crossing_checks + moving.work().vertex_checks, 10u);
}

/// Solids with edges and faces along the axes, scaled along these: their ties are told without exact numbers, and as
/// these tell them. Exact numbers decide where both solids are stretched by a factor of too many digits, which leaves
/// all else as it is.
TEST(OverlayUpdate, ties_along_the_axes_are_those_of_exact_numbers) {
  std::mt19937_64 random(58);
  // (10^51 + 1) / 10^51, and three digits times that.
  const std::string zeros(48, '0'), more = zeros + "000";
  const Scale wide = *Scale::parse("1" + zeros + "001/1" + more);
  std::uint64_t plain = 0, exact = 0;
  for (int k = 0; k < 300; ++k) {
    const Polytope p = *spatial::make_polytope(random_grid_polytope(random, 9, 2));
    const Polytope q = *spatial::make_polytope(k % 3 == 0 ? cube(1) : random_grid_polytope(random, 9, 2));
    SolidPose pose, stretched, other;
    const std::size_t axis = random() % 3;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string n = std::to_string(500 + random() % 500);
      pose.scale[i] = stretched.scale[i] = *Scale::parse(n + "/1000");
      if (i == axis) stretched.scale[i] = *Scale::parse(n + zeros + n + "/1000" + more);
    }
    other.scale[axis] = wide;
    const RelativeMap map = map_of(pose), same(PoseFactors::of(stretched), PoseFactors::of(other));
    ASSERT_GT(same.bits(), 126);
    Overlay narrow(p, q), large(p, q), moved(p, q);
    narrow.build(map);
    large.build(same);
    moved.update(map);
    plain += narrow.work().exact_signs;
    exact += large.work().exact_signs;
    ASSERT_TRUE(narrow == large) << k;
    ASSERT_TRUE(moved == large) << k;
  }
  EXPECT_GT(exact, 1000u);
  EXPECT_LT(20 * plain, exact);
}

}  // namespace
}  // namespace dymsum::test
