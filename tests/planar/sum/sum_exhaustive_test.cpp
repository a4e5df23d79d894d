// Whole families of small polygons on the 3 x 3 lattice, every pair.
#include <gtest/gtest.h>

#include "oracles/verdict.h"

namespace dymsum::oracles {
namespace {

int check_all(const std::vector<RegionData>& first, const std::vector<RegionData>& second, std::size_t stride) {
  int checked = 0;
  for (std::size_t i = 0; i < first.size(); ++i)
    for (std::size_t j = i % stride; j < second.size(); j += stride) {
      const std::string wrong = verdict(first[i], second[j]);
      ++checked;
      if (wrong.empty()) continue;
      ADD_FAILURE() << failure_report(first[i], second[j], wrong);
      return checked;
    }
  return checked;
}

/// In ./run verify every pair, otherwise every `stride`-th.
std::size_t stride(std::size_t quick) { return setting("DYMSUM_FUZZ_PAIRS", 0) >= 100000 ? 1 : quick; }

TEST(SumExhaustive, triangles_with_triangles) {
  const std::vector<RegionData> triangles = all_small_polygons(3);
  EXPECT_EQ(triangles.size(), 44u);
  EXPECT_GT(check_all(triangles, triangles, stride(7)), 250);
}

TEST(SumExhaustive, quadrilaterals_with_triangles) {
  const std::vector<RegionData> quadrilaterals = all_small_polygons(4), triangles = all_small_polygons(3);
  EXPECT_EQ(quadrilaterals.size(), 77u);
  EXPECT_GT(check_all(quadrilaterals, triangles, stride(12)), 250);
}

TEST(SumExhaustive, quadrilaterals_with_quadrilaterals) {
  const std::vector<RegionData> quadrilaterals = all_small_polygons(4);
  EXPECT_GT(check_all(quadrilaterals, quadrilaterals, stride(40)), 140);
}

}  // namespace
}  // namespace dymsum::oracles
