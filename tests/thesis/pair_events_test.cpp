#include "thesis/pair_events.h"

#include <gtest/gtest.h>

namespace dymsum {
namespace {

TEST(PairEvents, of_two_triangles_are_counted) {
  const Region p = Region::create({{{{{0, 0}, {4, 1}, {1, 3}}, {}}}, {}, {}}).value(),
               q = Region::create({{{{{0, 0}, {3, 0}, {0, 2}}, {}}}, {}, {}}).value();
  const PairEventCount convex = count_pair_events(p, q, MovingOperand::p).value();
  // Convex operands: the convolution is the boundary, nothing ever crosses.
  EXPECT_EQ(convex.events, 0u);
  EXPECT_EQ(convex.segments, 6u);
}

}  // namespace
}  // namespace dymsum
