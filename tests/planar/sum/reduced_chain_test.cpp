// Chains of live segments: every successor starts where its segment ends, and a pair of vertices has all its segments.
#include "planar/sum/reduced.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "dymsum/shapes.h"
#include "oracles/random.h"
#include "oracles/tiny_regions.h"
#include "planar/convolution/convolution.h"
#include "planar/placed_pair.h"

namespace dymsum::planar {
namespace {

using Incident = std::set<std::pair<std::uint32_t, bool>>;

void check(const PlacedPair& o, const InteriorMask* mask) {
  const ReducedConvolution convolution(*o.lattice, *o.p, *o.q);
  Soup soup(*o.lattice, *o.p, *o.q);
  const Progress never;
  Array<std::uint32_t> live;
  if (mask != nullptr) live = add_live(convolution, mask, Twins::kept, soup, Poll(never));
  else add_all(convolution, soup);
  const auto reduced = static_cast<std::uint32_t>(soup.size());
  for (const WalkSegment& side : parallelogram_sides(*o.lattice, *o.p, *o.q)) soup.add(side);
  const ReducedChain chain(soup, convolution, std::move(live), reduced);
  EXPECT_EQ(chain.first_unchained(), reduced);
  std::size_t chained = 0;
  for (std::uint32_t s = 0; s < soup.size(); ++s) {
    if (const std::uint32_t next = chain.next(s); next != kNone) {
      EXPECT_TRUE(soup.start(next) == soup.end(s));
      ++chained;
    }
    Array<Incidence> decided;
    chain.incident(soup.end(s), decided);
    Incident found, expected;
    for (const Incidence& i : decided) found.emplace(i.segment, i.starts);
    EXPECT_EQ(found.size(), decided.size());
    for (std::uint32_t t = 0; t < soup.size(); ++t) {
      if (soup.start(t) == soup.end(s)) expected.emplace(t, true);
      if (soup.end(t) == soup.end(s)) expected.emplace(t, false);
    }
    EXPECT_EQ(found, expected);
  }
  EXPECT_EQ(chained > 0, reduced > 0);
}

TEST(ReducedChain, of_all_segments_and_of_those_outside_a_mask) {
  const PlacedPair o = placed_pair(shapes::noisy_star(40, 0.5, 1), shapes::random_polygon(20, 1, 2));
  check(o, nullptr);
  const InteriorMask fine(*o.p, *o.q, 24), coarse(*o.p, *o.q, 8);
  check(o, &fine);
  check(o, &coarse);
}

TEST(ReducedChain, sides_of_parallelograms_belong_to_none) {
  const Region bent = Region::create({{}, {{{0, 0}, {4, 0}, {4, 3}}}, {}}).value();
  const Region tall = Region::create({{}, {{{0, 0}, {1, 2}}}, {}}).value();
  check(placed_pair(bent, tall), nullptr);
}

}  // namespace
}  // namespace dymsum::planar
