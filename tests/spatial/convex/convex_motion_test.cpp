// Moving equals starting anew, after every move, and reports what it did.
#include "spatial/convex/convex_cases.h"
#include "spatial/convex/setting.h"

namespace dymsum::test {
namespace {

/// Same combinatorics along every arc as the two walks from nothing, and the same canonical sum.
void expect_as_rebuilt(const ConvexSum& moved, const std::string& where) {
  ConvexSum fresh = moved;
  fresh.rebuild();
  ASSERT_TRUE(moved.same_combinatorics(fresh)) << where;
}

TEST(ConvexMotion, random_rotations_equal_the_static_sum) {
  const std::uint64_t seed = setting("DYMSUM_FUZZ_SEED", 21), moves = setting("DYMSUM_FUZZ_MOVES", 1800);
  std::mt19937_64 random(seed);
  const std::vector<double> angles{1e-6, 1e-3, 0.0126, 0.1, 1, 3};
  for (int pair = 0; pair < 3; ++pair) {
    const Mesh p = random_round_polytope(random, 20 + 40 * pair), q = random_round_polytope(random, 100 - 30 * pair);
    ConvexSum moving = *ConvexSum::create(p, q);
    Rotation a, b;
    for (std::uint64_t k = 0; k < moves / 3; ++k) {
      const double angle = angles[random() % angles.size()];
      (random() % 4 == 0 ? b : a) = small_rotation(random, angle) * (random() % 4 == 0 ? b : a);
      moving.set(SolidPose{a, {}}, SolidPose{b, {}});
      expect_as_rebuilt(
          moving, "seed " + std::to_string(seed) + " pair " + std::to_string(pair) + " move " + std::to_string(k));
      if (k % 50 != 0) continue;
      ConvexSum brute = moving;
      brute.rebuild(ConvexEngine::brute);
      EXPECT_TRUE(moving.same_combinatorics(brute));
      EXPECT_TRUE(identical(moving.sum(), brute.sum()));
    }
  }
}

TEST(ConvexMotion, grid_polytopes_through_ties) {
  const std::uint64_t seed = setting("DYMSUM_FUZZ_SEED", 22), moves = setting("DYMSUM_FUZZ_MOVES", 1800);
  std::mt19937_64 random(seed);
  const std::vector<Rotation> turns{
      *Rotation::of(1, 1, 0, 0), *Rotation::of(1, 0, -1, 0), *Rotation::of(1, 0, 0, 1), *Rotation::of(1, 1, 1, 1),
      *Rotation::of(0, 1, 1, 0), *Rotation::of(3, 1, 0, 0),  *Rotation::of(7, 0, 1, 0), Rotation()};
  for (int pair = 0; pair < 6; ++pair) {
    const Mesh p = random_grid_polytope(random, 5 + 3 * pair, 3),
               q = pair % 2 ? negated(p) : random_grid_polytope(random, 8, 2);
    ConvexSum moving = *ConvexSum::create(p, q);
    Rotation a;
    for (std::uint64_t k = 0; k < moves / 6; ++k) {
      a = turns[random() % turns.size()] * a;
      moving.set(a);
      const std::string where =
          "seed " + std::to_string(seed) + " pair " + std::to_string(pair) + " move " + std::to_string(k);
      expect_as_rebuilt(moving, where);
      ConvexSum brute = moving;
      brute.rebuild(ConvexEngine::brute);
      ASSERT_TRUE(moving.same_combinatorics(brute)) << where;
      const SpatialSum sum = moving.sum();
      ASSERT_TRUE(identical(sum, brute.sum())) << where;
      if (k % 10 == 0) expect_closed(sum);
    }
  }
}

TEST(ConvexMotion, scaling_and_rotation_together) {
  const std::uint64_t seed = setting("DYMSUM_FUZZ_SEED", 23), moves = setting("DYMSUM_FUZZ_MOVES", 1800);
  std::mt19937_64 random(seed);
  for (int pair = 0; pair < 2; ++pair) {
    const Mesh p = pair ? random_grid_polytope(random, 14, 3) : random_round_polytope(random, 60);
    const Mesh q = pair ? random_grid_polytope(random, 9, 3) : random_round_polytope(random, 40);
    ConvexSum moving = *ConvexSum::create(p, q);
    SolidPose a, b;
    for (std::uint64_t k = 0; k < moves / 2; ++k) {
      SolidPose& one = random() % 2 ? a : b;
      switch (random() % 3) {
        case 0:
          one.scale = {random_scale(random), random_scale(random), random_scale(random)};
          break;
        case 1:
          one.scale[random() % 3] = *Scale::of(1 + 1e-3 * static_cast<double>(random() % 100));
          break;
        default:
          one.rotation = small_rotation(random, 0.02) * one.rotation;
      }
      moving.set(a, b);
      expect_as_rebuilt(
          moving, "seed " + std::to_string(seed) + " pair " + std::to_string(pair) + " move " + std::to_string(k));
      if (k % 20 == 0) {
        EXPECT_EQ(moving.sum().volume_exact(), moving.volume_exact());
      }
    }
  }
}

TEST(ConvexMotion, cubes_by_quarter_turns_and_through_parallel_faces) {
  ConvexSum moving = *ConvexSum::create(cube(1), cube(1));
  const double pi = std::acos(-1.0);
  for (int k = 1; k <= 16; ++k) {
    moving.set(*Rotation::about({0, 0, 1}, k * pi / 8));
    const SpatialSum sum = moving.sum();
    expect_closed(sum);
    // Aligned every fourth time: a cube; otherwise a prism over an octagon.
    EXPECT_EQ(sum.faces.size(), k % 4 == 0 ? 6u : 10u) << k;
    EXPECT_EQ(sum.vertices.size(), k % 4 == 0 ? 8u : 16u) << k;
    expect_as_rebuilt(moving, std::to_string(k));
  }
}

TEST(ConvexMotion, uniform_scaling_moves_positions_only) {
  std::mt19937_64 random(24);
  ConvexSum moving = *ConvexSum::create(random_round_polytope(random, 60), random_round_polytope(random, 60));
  moving.set(random_rotation(random));
  moving.set(small_rotation(random, 1e-4) * moving.p_pose().rotation);  // certificates are made by the first short move
  EXPECT_GT(moving.work().vertex_checks, 0u);
  const SpatialSum before = moving.sum();
  SolidPose pose = moving.p_pose();
  pose.scale.fill(*Scale::of(3.5));
  const MotionWork work = moving.set(pose);
  EXPECT_EQ(work.vertex_errors + work.facets_added + work.facets_removed, 0u);
  EXPECT_EQ(work.vertex_checks + work.crossing_checks + work.arc_checks, 0u)
      << "certificates do not feel a common factor";
  const SpatialSum after = moving.sum();
  EXPECT_EQ(structure(after), structure(before));
  EXPECT_NE(after.vertices, before.vertices);
}

TEST(ConvexMotion, there_and_back_is_the_same_state_and_standing_still_is_no_work) {
  std::mt19937_64 random(25);
  ConvexSum moving = *ConvexSum::create(random_round_polytope(random, 80), random_round_polytope(random, 50));
  const Rotation start = random_rotation(random);
  moving.set(start);
  const ConvexSum kept = moving;
  for (int k = 0; k < 30; ++k) moving.set(small_rotation(random, 0.3) * moving.p_pose().rotation);
  EXPECT_FALSE(moving.same_combinatorics(kept));
  moving.set(start);
  EXPECT_TRUE(moving.same_combinatorics(kept));
  EXPECT_TRUE(identical(moving.sum(), kept.sum()));
  moving.set(start);
  EXPECT_EQ(moving.work(), MotionWork());
}

TEST(ConvexMotion, nothing_counts_as_changed_before_the_first_move) {
  std::mt19937_64 random(27);
  ConvexSum sum = *ConvexSum::create(random_round_polytope(random, 30), random_round_polytope(random, 30));
  EXPECT_TRUE(sum.changed_facets().empty());
  sum.set(random_rotation(random));
  EXPECT_FALSE(sum.changed_facets().empty());
}

TEST(ConvexMotion, small_motions_check_few_features_and_errors_come_with_changes) {
  std::mt19937_64 random(26);
  const Mesh p = random_round_polytope(random, 200), q = random_round_polytope(random, 200);
  ConvexSum moving = *ConvexSum::create(p, q);
  moving.set(random_rotation(random));
  std::uint64_t checks = 0, most = 0, errors = 0;
  for (int k = 0; k < 200; ++k) {
    const SpatialSum before = moving.sum();
    const MotionWork work = moving.set(small_rotation(random, 1e-4) * moving.p_pose().rotation);
    checks += work.vertex_checks + work.crossing_checks + work.arc_checks;
    most += p.faces().size() + q.faces().size() + p.edge_count();
    errors += work.vertex_errors;
    const SpatialSum after = moving.sum();
    EXPECT_EQ(work.facets_added == 0 && work.facets_removed == 0, structure(after) == structure(before));
    EXPECT_EQ(moving.changed_facets().size(), work.facets_added);
    // Theorem 1 of the thesis: errors of both kinds come together.
    EXPECT_EQ(work.vertex_errors > 0,
              work.facets_added > work.vertex_errors || work.facets_removed > work.vertex_errors);
  }
  EXPECT_LT(checks * 20, most) << "certificates hold for an angle";
  EXPECT_GT(errors, 0u);
}

}  // namespace
}  // namespace dymsum::test
