// The solid that follows equals one from nothing, face by face, after any moves, and says what it changed.
#include "dymsum/convex_solid.h"

#include "spatial/convex/convex_cases.h"
#include "spatial/convex/same_solid.h"
#include "spatial/convex/setting.h"

namespace dymsum::test {
namespace {

/// Over a regular polygon about the z axis; with `top` = 0 a cone, else a frustum or cylinder.
Mesh about_z(int sides, double top, double from) {
  const auto snapped = [](double v) { return std::nearbyint(v * 0x1p20) * 0x1p-20; };
  std::vector<Point3> at;
  for (int k = 0; k < sides; ++k) {
    const double a = from + 2 * std::numbers::pi * k / sides, x = snapped(std::cos(a)), y = snapped(std::sin(a));
    at.push_back({x, y, -1});
    if (top > 0) at.push_back({top * x, top * y, 1});
  }
  if (top == 0) at.push_back({0, 0, 1});
  return *convex_hull(at);
}

struct SolidPair {
  Mesh p, q;
};

/// In general position, on small grids, and about one axis.
std::vector<SolidPair> solid_pairs(std::mt19937_64& random) {
  const Mesh cylinder = about_z(12, 1, 0), other = about_z(9, 1, 0.3), cone = about_z(10, 0, 0.1),
             frustum = about_z(12, 0.5, 0), box = solids::box(-1, -2, -1, 1, 2, 1),
             grid = random_grid_polytope(random, 14, 3), again = random_grid_polytope(random, 20, 3),
             ball = random_round_polytope(random, 40), small = random_round_polytope(random, 12);
  return {{ball, small},         {small, ball},
          {grid, again},         {grid, grid},
          {grid, negated(grid)}, {cylinder, cylinder},
          {cylinder, other},     {cylinder, cone},
          {cone, other},         {frustum, cylinder},
          {box, cylinder},       {box, box},
          {spindle(40), small},  {solids::tessellated_cube(2, 3, solids::kDemoSnap), box},
          {ball, cylinder}};
}

/// Twelve kinds.
void move(SolidPose& pose, const SolidPose& before, std::mt19937_64& random) {
  const auto any = [&](int n) { return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(n)); };
  switch (random() % 12) {
    case 0:  // tiny
      pose.rotation = small_rotation(random, 1e-7) * pose.rotation;
      return;
    case 1:  // usual
      pose.rotation = small_rotation(random, 0.0126) * pose.rotation;
      return;
    case 2:
      pose.rotation = small_rotation(random, 0.2) * pose.rotation;
      return;
    case 3:  // huge
      pose.rotation = random_rotation(random);
      return;
    case 4:  // alternating
      pose = before;
      return;
    case 5:  // a quarter or a half turn from the start
      pose.rotation = *Rotation::of(1, any(2), any(2), any(4));
      return;
    case 6:  // composed
      pose.rotation = *Rotation::of(any(2), 1, any(2), any(2)) * pose.rotation * small_rotation(random, 0.01);
      return;
    case 7:  // about an axis that solids share
      pose.rotation = *Rotation::about({0, 0, 1}, 0.01 * static_cast<double>(1 + any(20))) * pose.rotation;
      return;
    case 8:
      pose = {};
      return;
    case 9:
      pose.scale = {random_scale(random), random_scale(random), random_scale(random)};
      return;
    case 10:  // only a little
      pose.scale[static_cast<std::size_t>(any(3))] = *Scale::of(1 + 0x1p-30 * static_cast<double>(any(100)));
      return;
    default:  // extreme
      pose.scale[static_cast<std::size_t>(any(3))] = *Scale::of(std::ldexp(1.0, static_cast<int>(any(100)) - 50));
  }
}

TEST(ConvexSolid, equals_a_fresh_sum_face_by_face_after_any_moves) {
  const std::uint64_t seed = setting("DYMSUM_FUZZ_SEED", 81), moves = setting("DYMSUM_FUZZ_MOVES", 1500);
  std::mt19937_64 random(seed);
  const std::vector<SolidPair> all = solid_pairs(random);
  for (std::size_t i = 0; i < all.size(); ++i) {
    ConvexSum moving = *ConvexSum::create(all[i].p, all[i].q), fresh = moving;
    SolidPose p, q, p_before, q_before;
    ConvexSolid before;
    SolidBuffers buffers, buffers_before;
    for (std::uint64_t k = 0; k < moves / all.size(); ++k) {
      const std::string where =
          "seed " + std::to_string(seed) + " pair " + std::to_string(i) + " move " + std::to_string(k);
      const SolidPose p_here = p, q_here = q;
      if (random() % 4 > 0) move(p, p_before, random);
      else move(q, q_before, random);
      p_before = p_here;
      q_before = q_here;
      moving.set(p, q);
      if (random() % 50 == 0) moving.rebuild();
      if (random() % 8 == 0) continue;  // what it missed counts too
      const ConvexSolid& solid = moving.solid();
      fresh.rebuild(p, q);
      ASSERT_NO_FATAL_FAILURE(expect_same_solid(solid, fresh.sum(), where));
      ASSERT_NO_FATAL_FAILURE(expect_true_changes(before, solid, where));
      before = solid;
      if (random() % 8 == 0) continue;
      solid.write(buffers);
      ASSERT_NO_FATAL_FAILURE(expect_true_buffers(solid, buffers_before, buffers, where));
      buffers_before = buffers;
    }
  }
}

// Touching at one pose only: facets of two edges become one of a face and an edge, and come back.
TEST(ConvexSolid, coincidences_of_one_pose_leave_no_trace) {
  const Mesh box = cube(1), bar = solids::box(-2, -0.5, -0.5, 2, 0.5, 0.5);
  ConvexSum moving = *ConvexSum::create(box, bar);
  const double quarter = std::acos(-1.0) / 2;
  for (const double turn : {0.3, 0.0, 0.01, 0.0, 1.0, 1.0, 0.0}) {
    moving.set(*Rotation::about({0, 0, 1}, turn * quarter));
    const ConvexSolid& solid = moving.solid();
    EXPECT_EQ(solid.facet_count, turn == 0 || turn == 1 ? 6u : 10u) << turn;
    expect_same_solid(solid, moving.sum(), std::to_string(turn));
  }
}

TEST(ConvexSolid, standing_still_changes_nothing_and_small_moves_change_little) {
  std::mt19937_64 random(82);
  ConvexSum moving = *ConvexSum::create(random_round_polytope(random, 120), random_round_polytope(random, 90));
  moving.set(random_rotation(random));
  const std::uint64_t first = moving.solid().frame;
  const ConvexSolid before = moving.solid();
  EXPECT_TRUE(before.changes.facets.empty() && !before.changes.moved && before.changes.triangles.empty());
  EXPECT_EQ(before.frame, first + 1);
  std::size_t changed = 0;
  for (int k = 0; k < 100; ++k) {
    const MotionWork work = moving.set(small_rotation(random, 1e-3) * moving.p_pose().rotation);
    const ConvexSolid& solid = moving.solid();
    EXPECT_TRUE(solid.changes.moved);
    EXPECT_EQ(solid.changes.facets.empty(), work.facets_added + work.facets_removed == 0);
    changed += solid.changes.facets.size();
  }
  EXPECT_GT(changed, 0u);
  EXPECT_LT(changed, before.facet_count);
}

// Rebuilding gives crossings other indices, and so does what goes and comes back.
TEST(ConvexSolid, facets_keep_their_indices_when_all_is_made_anew) {
  std::mt19937_64 random(84);
  for (const auto& [p, q] : solid_pairs(random)) {
    ConvexSum moving = *ConvexSum::create(p, q);
    for (int k = 0; k < 3; ++k) {
      if (k > 0) moving.set(k == 1 ? random_rotation(random) : small_rotation(random, 0.1));
      const ConvexSolid before = moving.solid();
      const SolidPose pose = moving.p_pose();
      const auto expect_nothing = [&](const char* where) {
        const ConvexSolid& now = moving.solid();
        EXPECT_TRUE(now.changes.facets.empty()) << where;
        EXPECT_TRUE(now.changes.vertices_appeared.empty() && now.changes.vertices_disappeared.empty()) << where;
        EXPECT_FALSE(now.changes.moved) << where;
        // There may be more room for facets to come.
        EXPECT_TRUE(std::equal(before.facets.begin(), before.facets.end(), now.facets.begin())) << where;
        EXPECT_TRUE(now.vertices == before.vertices && now.at == before.at) << where;
        expect_same_solid(now, moving.sum(), where);
      };
      moving.rebuild();
      expect_nothing("walk");
      moving.rebuild(ConvexEngine::brute);
      expect_nothing("brute");
      moving.set(small_rotation(random, 0.05) * pose.rotation);
      moving.set(pose);
      expect_nothing("there and back");
    }
  }
}

TEST(ConvexSolid, facets_seen_from_the_other_side_are_turned) {
  std::size_t turned = 0;
  for (const double angle : {0.01, 0.05, 0.2}) {
    ConvexSum moving = *ConvexSum::create(cube(1), solids::box(-2, -0.5, -0.25, 2, 0.5, 0.25));
    for (int k = 0; k < 40; ++k) {
      const double sign = k % 2 == 0 ? 1 : -1;
      moving.set(*Rotation::about({sign, 2 * sign, 3 * sign}, angle + 0.002 * k));
      const ConvexSolid before = moving.solid();
      moving.set(*Rotation::about({-sign, -2 * sign, -3 * sign}, angle + 0.002 * k));
      const ConvexSolid& now = moving.solid();
      expect_true_changes(before, now, std::to_string(k));
      expect_same_solid(now, moving.sum(), std::to_string(k));
      for (const FacetChange& c : now.changes.facets) turned += c.kind == FacetChange::Kind::turned;
    }
  }
  EXPECT_GT(turned, 10u);
}

TEST(ConvexSolid, copies_go_their_own_ways) {
  std::mt19937_64 random(83);
  ConvexSum one = *ConvexSum::create(random_round_polytope(random, 30), cube(1));
  one.solid();
  ConvexSum two = one;
  for (int k = 0; k < 20; ++k) {
    one.set(random_rotation(random));
    two.set(small_rotation(random, 0.01) * two.p_pose().rotation);
    expect_same_solid(one.solid(), one.sum(), "one");
    expect_same_solid(two.solid(), two.sum(), "two");
  }
}

}  // namespace
}  // namespace dymsum::test
