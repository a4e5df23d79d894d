#include "thesis/crossing_range.h"

#include <gtest/gtest.h>

namespace dymsum::planar {
namespace {

// a + b s known to be positive somewhere in a range of two roots that both are known badly: doubles do not know.
TEST(CrossingRange, a_badly_known_pair_is_not_called_empty) {
  CrossingRange range;
  range.meet(-1.01, 1.01, 1, 1);   // perhaps -0.01 + 2.01 s: from 0.005 on
  range.meet(1.01, -20.2, 1, 20);  // perhaps 2.01 - 0.2 s: up to 10
  range.settle();
  EXPECT_FALSE(range.empty);
  EXPECT_TRUE(range.unsure);
}

TEST(CrossingRange, well_known_pairs_are_decided) {
  CrossingRange some, none, close;
  for (CrossingRange* r : {&some, &none, &close}) r->meet(-1, 1, 0x1p-50, 0x1p-50);
  some.meet(2, -1, 0x1p-50, 0x1p-50);
  none.meet(1, -2, 0x1p-50, 0x1p-50);
  close.meet(1 + 0x1p-49, -1, 0x1p-50, 0x1p-50);
  for (CrossingRange* r : {&some, &none, &close}) r->settle();
  EXPECT_FALSE(some.empty || some.unsure);
  EXPECT_TRUE(none.empty && !none.unsure);
  EXPECT_TRUE(close.unsure);
}

}  // namespace
}  // namespace dymsum::planar
