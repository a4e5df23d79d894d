// The kill rule on two or three segments that meet at one position, from signs alone.
#include "cspace/obstacle/meeting_plan.h"

#include <gtest/gtest.h>

namespace dymsum::planar {
namespace {

void set_cross(LocalArrangement& local, int a, int b, int sign) {
  local.cross[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)] = sign;
  local.cross[static_cast<std::size_t>(b)][static_cast<std::size_t>(a)] = -sign;
}

/// Three lines whose directions span the plane with positive weights; `free`: the triangle between them is on the right
/// of each.
LocalArrangement triangle(bool free) {
  LocalArrangement local;
  local.size = 3;
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3, last = (k + 2) % 3;
    set_cross(local, k, next, 1);
    local.members[static_cast<std::size_t>(k)].add({free ? next : last, false});
    local.members[static_cast<std::size_t>(k)].add({free ? last : next, false});
  }
  return local;
}

TEST(LocalArrangement, AHoleMayBeBornBetweenThreeSegments) {
  const LocalArrangement::Routes born = triangle(true).routes();
  ASSERT_TRUE(born.paths.has_value());
  EXPECT_TRUE(born.paths->empty());
  ASSERT_EQ(born.cycles.size(), 1U);
  EXPECT_EQ(born.cycles[0], (std::vector<int>{0, 2, 1}));
  EXPECT_TRUE(triangle(false).routes().cycles.empty());
}

// In along the segment that ends, out along the one that starts at its end.
LocalArrangement corner() {
  LocalArrangement local;
  local.size = 2;
  set_cross(local, 0, 1, -1);
  local.members[0].closes = true;
  local.members[0].add({1, true});
  local.members[0].in = 7;
  local.members[1].opens = true;
  local.members[1].add({0, true});
  local.members[1].out = 9;
  return local;
}

TEST(LocalArrangement, AChainLeadsOnAtItsVertex) {
  const LocalArrangement::Routes routes = corner().routes();
  ASSERT_TRUE(routes.paths.has_value());
  ASSERT_EQ(routes.paths->size(), 1U);
  EXPECT_EQ(routes.paths->front().in, 7U);
  EXPECT_EQ(routes.paths->front().out, 9U);
  EXPECT_EQ(routes.paths->front().members, (std::vector<int>{0, 1}));
}

TEST(LocalArrangement, WhatComesInAndDoesNotGoOutIsNotGuessed) {
  LocalArrangement local = corner();
  local.members[1].out = kNobody;
  EXPECT_FALSE(local.routes().paths.has_value());
  local = corner();
  local.members[0].in = kNobody;
  EXPECT_FALSE(local.routes().paths.has_value());
}

// A segment crosses the first one from right to left: what comes before on that is covered.
TEST(LocalArrangement, ACoveredPieceIsNoWay) {
  LocalArrangement local;
  local.size = 2;
  set_cross(local, 0, 1, 1);
  local.members[0].add({1, false});
  local.members[1].add({0, false});
  local.members[0].in = 3;
  local.members[1].out = 4;
  EXPECT_FALSE(local.routes().paths.has_value());
  local = LocalArrangement{};
  local.size = 2;
  set_cross(local, 0, 1, -1);
  local.members[0].add({1, false});
  local.members[1].add({0, false});
  local.members[0].in = 3;
  local.members[1].out = 4;
  ASSERT_TRUE(local.routes().paths.has_value());
  EXPECT_EQ(local.routes().paths->front().members, (std::vector<int>{0, 1}));
}

}  // namespace
}  // namespace dymsum::planar
