// Obstacles of coordinates of all kinds: between events, slices have the loops of the obstacle.
#include <gtest/gtest.h>

#include "cspace/obstacle/obstacle_slices.h"
#include "dymsum/shapes.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/snapped_shapes.h"
#include "oracles/verdict.h"

namespace dymsum::testing_obstacles {
namespace {

TEST(CspaceCoordinates, of_every_kind_have_the_loops_of_slices) {
  std::mt19937_64 random(7304);
  const std::pair<Region, Region> pairs[] = {{shapes::letter_l(3, 3, 1), shapes::comb(3, 2, 1, 3)},
                                             {shapes::comb(3, 2, 1, 3), shapes::letter_u(4, 3, 1)},
                                             {snapped_shapes::gear(5, 1, 2), shapes::grate(3, 3, 1, 6)}};
  for (const CoordinateKind kind : kCoordinateKinds)
    for (const auto& [one, other] : pairs) {
      const Result<Region> robot = Region::create(of_kind(one.data(), kind, random)),
                           around = Region::create(of_kind(other.data(), kind, random));
      if (!robot.ok() || !around.ok()) continue;
      SCOPED_TRACE(name_of(kind));
      const CspaceObstacle obstacle = CspaceObstacle::create(*robot, *around).value();
      // In their order: nearly coincident events have intervals that become narrower where they are compared.
      const auto slabs_there = static_cast<std::uint32_t>(obstacle.angles().size());
      for (std::uint32_t slab = 0; slab < slabs_there; ++slab)
        ASSERT_EQ(obstacle.slab_of(obstacle.inside(slab)), slab) << "of " << slabs_there;
      expect_slices(obstacle, random, static_cast<std::uint32_t>(oracles::rounds(16)));
      if (HasFatalFailure()) return;
    }
}

// Parallel segments that come onto one line share an interval of 1e-15: of an L and a comb, turned in doubles, whose
// ends are at one position but for rounding.
TEST(CspaceCoordinates, stretches_that_doubles_do_not_see_are_shared) {
  const Region l = Region::create({{{{{0, 0},
                                      {0.10469849010750323, 2.9981724810572872},
                                      {-0.89469233691159256, 3.0330719777597883},
                                      {-0.96449133031659473, 1.0342903237215968},
                                      {-2.963272984354786, 1.1040893171265991},
                                      {-2.9981724810572872, 0.10469849010750323}},
                                     {}}},
                                   {},
                                   {}})
                       .value(),
               comb = Region::create({{{{{0, 0},
                                         {-6.9957357891336702, 0.244296476917508},
                                         {-7.1004342792411741, -2.7538760041397792},
                                         {-6.1010434522220773, -2.7887755008422803},
                                         {-6.0312444588170759, -0.78999384680408891},
                                         {-5.0318536317979792, -0.82489334350659005},
                                         {-5.1016526252029823, -2.8236749975447815},
                                         {-4.1022617981838865, -2.8585744942472826},
                                         {-4.0324628047788842, -0.85979284020909119},
                                         {-3.0330719777597883, -0.89469233691159233},
                                         {-3.1028709711647906, -2.8934739909497837},
                                         {-2.1034801441456947, -2.9283734876522849},
                                         {-2.0336811507406924, -0.92959183361409348},
                                         {-1.034290323721597, -0.96449133031659462},
                                         {-1.1040893171265993, -2.963272984354786},
                                         {-0.10469849010750343, -2.9981724810572872}},
                                        {}}},
                                      {},
                                      {}})
                          .value();
  const CspaceObstacle obstacle = CspaceObstacle::create(l, comb).value();
  for (std::uint32_t slab = 0; slab < slabs(obstacle); ++slab)
    EXPECT_EQ(of_slab(obstacle, slab), of_slice(*obstacle.slice(obstacle.inside(slab)))) << slab;
}

// Shapes that were turned alike, or by a quarter more, have hundreds of events at nearly one angle.
TEST(CspaceCoordinates, of_turned_shapes_have_the_loops_of_slices) {
  const std::uint64_t count = oracles::setting("DYMSUM_FUZZ_OBSTACLES", 1) * 60;
  for (std::uint64_t seed = 1690; seed < 1690 + count; ++seed) {
    std::mt19937_64 random(seed);
    const auto shape = [&] {
      const int n = 2 + static_cast<int>(random() % 3);
      switch (random() % 4) {
        case 0:
          return shapes::letter_l(3, 3, 1);
        case 1:
          return shapes::letter_u(4, 3, 1);
        case 2:
          return shapes::grate(2, 3, 1, 6);
        default:
          return shapes::comb(n, 2, 1, 3);
      }
    };
    const auto turned = [](const Region& region, int degrees) {
      const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
      return Region::create(mapped(region, [&](Point p) { return Point{c * p.x - s * p.y, s * p.x + c * p.y}; }));
    };
    const Region one = shape(), other = shape();
    const int degrees = random() % 2 == 0 ? 30 : static_cast<int>(random() % 360),
              more = random() % 2 == 0 ? 0 : 90 * static_cast<int>(random() % 4);
    const Result<Region> robot = turned(one, degrees), around = turned(other, degrees + more);
    if (!robot.ok() || !around.ok()) continue;
    SCOPED_TRACE("seed " + std::to_string(seed));
    const CspaceObstacle obstacle = CspaceObstacle::create(*robot, *around).value();
    for (std::uint32_t slab = 0; slab < slabs(obstacle); ++slab)
      ASSERT_EQ(of_slab(obstacle, slab), of_slice(*obstacle.slice(obstacle.inside(slab)))) << slab;
  }
}

}  // namespace
}  // namespace dymsum::testing_obstacles
