// Obstacles of coordinates of all kinds: between events, slices have the loops of the obstacle.
#include <gtest/gtest.h>

#include "cspace/obstacle/obstacle_slices.h"
#include "dymsum/shapes.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/snapped_shapes.h"

namespace dymsum::testing_obstacles {
namespace {

TEST(CspaceCoordinates, of_every_kind_have_the_loops_of_slices) {
  std::mt19937_64 random(7304);
  const std::pair<Region, Region> pairs[] = {{shapes::letter_l(3, 3, 1), shapes::comb(3, 2, 1, 3)},
                                             {shapes::comb(3, 2, 1, 3), shapes::letter_u(4, 3, 1)},
                                             {snapped::gear(5, 1, 2), shapes::grate(3, 3, 1, 6)}};
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

}  // namespace
}  // namespace dymsum::testing_obstacles
