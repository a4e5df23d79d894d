// The way of finding meetings that is chosen finds what all pairs show; and each way is chosen somewhere.
#include "planar/arrangement/find_meetings.h"
#include "oracles/snapped_shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "dymsum/shapes.h"
#include "planar/placed_pair.h"
#include "planar/sum/reduced.h"

namespace dymsum::planar {
namespace {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

Pairs crossing_pairs(const Meetings& meetings) {
  Pairs pairs;
  for (const Crossing& c : meetings.crossings) pairs.emplace_back(c.a, c.b);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Without a mask; whether a grid was used.
bool finds_all(const Region& a, const Region& b) {
  const PlacedPair o = placed_pair(a, b);
  const ReducedConvolution convolution(*o.lattice, *o.p, *o.q);
  Soup soup(*o.lattice, *o.p, *o.q);
  add_all(convolution, soup);
  const ReducedChain chain(soup, convolution, Array<std::uint32_t>(), static_cast<std::uint32_t>(soup.size()));
  const Progress never;
  const Meetings all = all_meetings(soup, &chain, Poll(never));
  const MarkedMeetings open = open_meetings(soup, chain, {}, Poll(never));
  EXPECT_FALSE(all.crossings.empty());
  EXPECT_EQ(crossing_pairs(open.meetings), crossing_pairs(all));
  EXPECT_TRUE(open.marks.empty()) << "nothing is covered without a mask";
  return open.meetings.cell_entries > 0;
}

TEST(FindMeetings, few_segments_are_swept) {
  EXPECT_FALSE(finds_all(snapped_shapes::star(5, 1, 3), shapes::letter_u(3, 4, 1)));
  EXPECT_FALSE(finds_all(shapes::noisy_star(60, 0.5, 1), shapes::noisy_star(50, 0.5, 2)));
}

TEST(FindMeetings, many_wide_segments_go_to_a_grid) {
  Ring teeth;
  for (int k = 0; k < 70; ++k) {
    teeth.push_back({200.0 + k % 3, 2.0 * k});
    teeth.push_back({1.0 + k % 7, 2.0 * k + 1});
  }
  teeth.push_back({0, 200});
  teeth.push_back({0, -1});
  const Region comb = Region::create({{{std::move(teeth), {}}}, {}, {}}).value();
  EXPECT_TRUE(finds_all(comb, comb));
}

}  // namespace
}  // namespace dymsum::planar
