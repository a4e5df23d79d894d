// Where events happen: a position that moves fast with the angle is covered provably only where the angle is.
#include "cspace/events/exact_position.h"

#include <gtest/gtest.h>

#include "dymsum/shapes.h"
#include "planar/motion/operand_pair.h"

namespace dymsum::planar {
namespace {

struct Scene {
  std::shared_ptr<const OperandPair> base;
  TurningForms forms;
  RotationCatalog catalog{forms};
  RotationGrid grid{forms, 8};
  Scene(const Region& obstacle, const Region& robot)
      : base(pair_of_regions(obstacle, robot, PairOptions{.moved = 1, .reflect_q = true}).value()), forms(*base) {}
};

TEST(EventPosition, nearly_parallel_segments_are_covered_at_certain_angles_only) {
  const Scene scene(shapes::noisy_star(40, 0.3, 3), shapes::noisy_star(30, 0.3, 4));
  const RotationRange range{0, 0.1, 0.1 + 0x1p-6};
  const EventWindow window(scene.grid, scene.catalog, range, false);
  const OverlapFilter filter(scene.forms, window);
  int slow = 0, fast = 0;
  for (const EventWindow::SegmentPair& m : window.pairs) {
    RotationEvent event;
    event.kind = RotationEvent::Kind::three_segments;
    event.a = window.segments[m.a];
    event.b = event.c = window.segments[m.b];
    event.low = event.high = window.midpoint;
    if (!provably_covered(event, scene.forms, filter)) continue;
    const double sine = position_of(event, scene.forms, window.heading).sine;
    const auto covered = [&](double width) {
      event.low = window.midpoint - width / 2;
      event.high = window.midpoint + width / 2;
      return provably_covered(event, scene.forms, filter);
    };
    // The position moves by up to 1 + 4 / sine spans for every radian, against the robot by one more.
    EXPECT_TRUE(covered(OverlapFilter::kMoves / (2 + 4 / sine) * 0.9));
    EXPECT_FALSE(covered(OverlapFilter::kMoves / (2 + 4 / sine) * 1.1));
    (sine < 0.1 ? fast : slow)++;
  }
  EXPECT_GT(slow, 10);
  EXPECT_GT(fast, 0);
}

}  // namespace
}  // namespace dymsum::planar
