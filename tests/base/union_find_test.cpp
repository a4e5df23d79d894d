// Classes of elements: the same as by comparing everything with everything.
#include "base/scratch.h"

#include <gtest/gtest.h>

#include <vector>

#include "oracles/random.h"

namespace dymsum {
namespace {

TEST(UnionFind, elements_are_alone_until_they_are_united) {
  UnionFind classes(2);
  EXPECT_EQ(classes.size(), 2u);
  EXPECT_EQ(classes.add(), 2u);
  EXPECT_FALSE(classes.same(0, 2));
  classes.unite(0, 2);
  EXPECT_TRUE(classes.same(0, 2));
  EXPECT_EQ(classes.root(0), 2u) << "the second one stands for both";
  EXPECT_FALSE(classes.same(1, 2));
  classes.unite(2, 0);
  EXPECT_EQ(classes.root(0), 2u);
}

TEST(UnionFind, classes_are_those_of_relabelling) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    oracles::Random random(seed);
    const std::uint32_t n = 40;
    Scratch scratch;
    UnionFind classes(n, &scratch);
    std::vector<std::uint32_t> label(n);
    for (std::uint32_t i = 0; i < n; ++i) label[i] = i;
    for (int round = 0; round < 30; ++round) {
      const auto i = static_cast<std::uint32_t>(random.below(n)), j = static_cast<std::uint32_t>(random.below(n));
      classes.unite(i, j);
      const std::uint32_t from = label[i], to = label[j];
      for (std::uint32_t& l : label) l = l == from ? to : l;
    }
    for (std::uint32_t i = 0; i < n; ++i)
      for (std::uint32_t j = 0; j < n; ++j) ASSERT_EQ(classes.same(i, j), label[i] == label[j]) << "seed " << seed;
  }
}

}  // namespace
}  // namespace dymsum
