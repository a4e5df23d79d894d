// Solids with many coincident directions, turning about an axis that they share: every move equals the overlay from
// nothing and the brute force, and what is there grows with the true facets.
#include <numbers>
#include <string>
#include <vector>

#include "spatial/convex/convex_cases.h"
#include "spatial/convex/setting.h"
#include "spatial/gauss/as_built.h"
#include "spatial/gauss/overlay.h"

namespace dymsum::test {
namespace {

using spatial::Overlay;
using spatial::Polytope;
using spatial::RelativeMap;

double at_20_bits(double v) { return std::nearbyint(v * 0x1p20) * 0x1p-20; }

/// Over a regular polygon about the z axis; with `top` = 0 a cone, with another a frustum. A first corner at `from`.
Mesh turned_profile(int sides, double top, double from) {
  std::vector<Point3> at;
  for (int k = 0; k < sides; ++k) {
    const double a = from + 2 * std::numbers::pi * k / sides, x = std::cos(a), y = std::sin(a);
    at.push_back({at_20_bits(x), at_20_bits(y), -1});
    if (top > 0) at.push_back({top * at_20_bits(x), top * at_20_bits(y), 1});
  }
  if (top == 0) at.push_back({0, 0, 1});
  return *convex_hull(at);
}

std::string position(std::size_t pair, int move) {
  return "pair " + std::to_string(pair) + " move " + std::to_string(move);
}

std::vector<PolytopePair> pairs_with_shared_axes(std::mt19937_64& random) {
  const auto make = [](const Mesh& mesh) { return *spatial::make_polytope(mesh); };
  const Polytope cylinder = make(turned_profile(12, 1, 0)), other = make(turned_profile(9, 1, 0.3)),
                 cone = make(turned_profile(10, 0, 0.1)), frustum = make(turned_profile(12, 0.5, 0)),
                 box = make(solids::box(-1, -2, -1, 1, 2, 1)), grid = make(random_grid_polytope(random, 14, 3)),
                 again = make(random_grid_polytope(random, 20, 3)), cut = make(turned_profile(4, 0.5, 0)),
                 sharp = make(turned_profile(40, 0, 0.1));
  return {{cylinder, cylinder}, {cylinder, other}, {other, cylinder}, {cylinder, cone}, {cone, other},
          {frustum, cylinder},  {box, cylinder},   {box, box},        {grid, again},    {grid, grid},
          {frustum, frustum},   {cut, box},        {again, cylinder}, {sharp, sharp},   {sharp, cylinder}};
}

/// About the shared axis z mostly, to where sides are parallel again and away, quarter turns, flips, and off the axis.
SolidPose next_pose(const SolidPose& pose, std::mt19937_64& random) {
  SolidPose to = pose;
  const auto about = [&](Point3 axis, double angle) {
    to.rotation = *Rotation::about({axis.x, axis.y, axis.z}, angle) * to.rotation;
  };
  switch (random() % 9) {
    case 0:
      to.rotation = *Rotation::of(1, 0, 0, static_cast<std::int64_t>(random() % 4));
      break;
    case 1:
      to.rotation = {};
      break;
    case 2:
      to.rotation = *Rotation::of(0, 1, 0, 0);
      break;
    case 3:
      about({1, 0.3, 0.2}, 1e-3);
      break;
    case 4:
      about({0, 0, 1}, 2);
      break;
    case 5:
      to.scale = {random_scale(random), random_scale(random), random_scale(random)};
      break;
    case 6:
      to.rotation =
          *Rotation::of(1, static_cast<std::int64_t>(random() % 2), 0, static_cast<std::int64_t>(random() % 2));
      break;
    default:
      about({0, 0, 1}, 0.01 * static_cast<double>(1 + random() % 20));
  }
  return to;
}

TEST(SharedAxis, moves_equal_the_overlay_from_nothing_and_the_brute_force) {
  const std::uint64_t seed = setting("DYMSUM_FUZZ_SEED", 61), moves = setting("DYMSUM_FUZZ_MOVES", 1300);
  std::mt19937_64 random(seed);
  const std::vector<PolytopePair> all = pairs_with_shared_axes(random);
  for (std::size_t i = 0; i < all.size(); ++i) {
    Overlay moving(all[i].p, all[i].q);
    SolidPose pose;
    moving.build(map_of(pose));
    for (int k = 0; k < static_cast<int>(moves / all.size()); ++k) {
      pose = next_pose(pose, random);
      const RelativeMap map = map_of(pose);
      const Overlay before = moving;
      moving.update(map);
      ASSERT_NO_FATAL_FAILURE(
          expect_as_built(before, moving, map, "seed " + std::to_string(seed) + " " + position(i, k)));
      Overlay brute(all[i].p, all[i].q);
      brute.build_brute(map);
      ASSERT_TRUE(moving == brute) << "seed " << seed << " " << position(i, k);
    }
  }
}

// Caps of n sides that face the same way, and sides that do: without the crossings near them, which grow with n^2.
TEST(SharedAxis, crossings_grow_with_the_true_facets) {
  for (const int n : {50, 100, 200}) {
    const Polytope p = *spatial::make_polytope(turned_profile(n, 1, 0)),
                   q = *spatial::make_polytope(turned_profile(n, 1, 0.01));
    Overlay turning(p, q);
    turning.build(RelativeMap());
    for (int k = 0; k < 5; ++k) {
      const SolidPose pose{*Rotation::about({0, 0, 1}, 0.01 * k), {}};
      turning.update(map_of(pose));
      EXPECT_LE(turning.crossing_count(), 4u * static_cast<std::size_t>(n)) << n << " move " << k;
      Overlay fresh(p, q);
      fresh.build(map_of(pose));
      EXPECT_TRUE(turning == fresh) << n << " move " << k;
      EXPECT_LE(fresh.work().steps, 30u * static_cast<std::size_t>(n)) << n << " move " << k;
    }
  }
}

TEST(SharedAxis, sums_are_those_of_fresh_hulls) {
  std::mt19937_64 random(63);
  const Mesh cylinder = turned_profile(8, 1, 0), cone = turned_profile(6, 0, 0.1),
             box = solids::box(-1, -2, -1, 1, 2, 1);
  for (const auto& [p, q] : {std::pair{cylinder, cylinder}, {cylinder, cone}, {box, cylinder}, {cone, cone}}) {
    ConvexSum turning = *ConvexSum::create(p, q);
    for (const auto& [w, z] : {std::pair{1, 0}, {1, 1}, {0, 1}, {1, -1}, {1, 0}, {0, 1}}) {
      const Rotation by = *Rotation::of(w, 0, 0, z);
      turning.set({by, {}}, {});
      EXPECT_EQ(whole_mesh(turning.sum()).canonical().data(), hull_of_sums(turned(p, by), q).canonical().data());
      EXPECT_EQ(turning.facet_count().all, turning.sum().faces.size());
    }
  }
}

}  // namespace
}  // namespace dymsum::test
