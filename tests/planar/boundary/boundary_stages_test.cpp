// The last stages of the reduced engine one by one: loops, tight features, rings.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <random>
#include <set>
#include <tuple>
#include <utility>

#include "dymsum/shapes.h"
#include "planar/arrangement/find_meetings.h"
#include "planar/boundary/boundary.h"
#include "planar/placed_pair.h"
#include "planar/sum/reduced.h"

namespace dymsum::planar {
namespace {

Region polygon(Ring outer, std::vector<Ring> holes = {}) {
  return Region::create({{{std::move(outer), std::move(holes)}}, {}, {}}).value();
}

/// Everything up to the collision tests, without a mask.
struct Stages {
  Stages(const Region& a, const Region& b)
      : o(placed_pair(a, b)),
        convolution(*o.lattice, *o.p, *o.q),
        soup(filled(convolution, o)),
        chain(soup, convolution, Array<std::uint32_t>(), static_cast<std::uint32_t>(soup.size())),
        arrangement(soup, all_meetings(soup, &chain, Poll(never)), chain, Array<CoveredMark>()),
        collision(*o.lattice, *o.p, *o.q, true),
        sorted(verify_loops(soup, arrangement, find_loops(soup, arrangement), collision, false)) {}
  static Soup filled(const ReducedConvolution& convolution, const PlacedPair& o) {
    Soup soup(*o.lattice, *o.p, *o.q);
    add_all(convolution, soup);
    return soup;
  }
  RawBoundary tight() {
    RawBoundary out;
    double error = 0;
    find_tight_features(soup, arrangement, sorted.kept, collision, out, error);
    return out;
  }

  PlacedPair o;
  Progress never;
  ReducedConvolution convolution;
  Soup soup;
  ReducedChain chain;
  Arrangement arrangement;
  Collision collision;
  SortedLoops sorted;
};

const Region kUnit = shapes::rectangle(0, 0, 1, 1);

TEST(TightFeatures, a_slot_as_wide_as_the_part_is_a_crack) {
  Stages s(polygon({{0, 0}, {5, 0}, {5, 5}, {3, 5}, {3, 1}, {2, 1}, {2, 5}, {0, 5}}), kUnit);
  const RawBoundary found = s.tight();
  double low = 9, high = 0, length = 0;
  for (const SumSegment& crack : found.cracks) {
    EXPECT_EQ(crack.from.at.x, 3);
    EXPECT_EQ(crack.to.at.x, 3);
    low = std::min({low, crack.from.at.y, crack.to.at.y});
    high = std::max({high, crack.from.at.y, crack.to.at.y});
    length += std::abs(crack.to.at.y - crack.from.at.y);
  }
  EXPECT_EQ(low, 2);
  EXPECT_EQ(high, 6);
  EXPECT_EQ(length, 4) << "each place once";
}

TEST(TightFeatures, a_hole_like_the_part_is_a_puncture) {
  Stages s(polygon({{0, 0}, {3, 0}, {3, 3}, {0, 3}}, {{{1, 1}, {1, 2}, {2, 2}, {2, 1}}}), kUnit);
  const RawBoundary found = s.tight();
  EXPECT_TRUE(found.cracks.empty());
  ASSERT_EQ(found.punctures.size(), 1u);
  EXPECT_EQ(found.punctures[0].at, (Point{2, 2}));
}

/// All of a vertex that results say.
auto names(const SumVertex& v) {
  return std::tuple{v.in.kind, v.in.p, v.in.q, v.out.kind, v.out.p, v.out.q, v.corner_p, v.corner_q};
}

/// Four corners meet in the puncture: the pair of the least indices names it, in whatever order they are found.
TEST(TightFeatures, a_puncture_has_one_name_in_whatever_order_meetings_are_found) {
  constexpr std::uint32_t kSeed = 37;
  std::printf("seed %u\n", kSeed);
  std::mt19937 random(kSeed);
  const Region plate = polygon({{0, 0}, {10, 0}, {10, 6}, {0, 6}}, {{{3, 2}, {3, 3}, {4, 3}, {4, 2}}});
  Stages s(plate, shapes::rectangle(-0.5, -0.5, 0.5, 0.5));
  const RawBoundary expected = s.tight();
  ASSERT_EQ(expected.punctures.size(), 1u);
  EXPECT_EQ(expected.punctures[0].corner_p, 4u);
  for (int trial = 0; trial < 50; ++trial) {
    Meetings meetings = all_meetings(s.soup, &s.chain, Poll(s.never));
    std::shuffle(meetings.same.begin(), meetings.same.end(), random);
    for (auto& [a, b] : meetings.same)
      if (random() % 2 == 0) std::swap(a, b);
    const Arrangement arrangement(s.soup, std::move(meetings), s.chain, Array<CoveredMark>());
    const SortedLoops sorted = verify_loops(s.soup, arrangement, find_loops(s.soup, arrangement), s.collision, false);
    RawBoundary found;
    double error = 0;
    find_tight_features(s.soup, arrangement, sorted.kept, s.collision, found, error);
    ASSERT_EQ(found.punctures.size(), 1u) << "trial " << trial;
    EXPECT_EQ(names(found.punctures[0]), names(expected.punctures[0])) << "trial " << trial;
  }
}

TEST(TightFeatures, none_where_the_part_fits_loosely) {
  Stages s(polygon({{0, 0}, {5, 0}, {5, 5}, {3.5, 5}, {3.5, 1}, {2, 1}, {2, 5}, {0, 5}}), kUnit);
  const RawBoundary found = s.tight();
  EXPECT_TRUE(found.cracks.empty());
  EXPECT_TRUE(found.punctures.empty());
}

TEST(SimpleRings, holes_that_meet_at_a_node_bound_connected_interiors) {
  // Free positions of the unit square in two holes: squares that touch at (3, 3) only, so one pinched loop or two.
  Stages s(polygon({{0, 0}, {6, 0}, {6, 6}, {0, 6}},
                   {{{1, 1}, {1, 3}, {3, 3}, {3, 1}}, {{2, 4}, {2, 5.5}, {5, 5.5}, {5, 2}, {4, 2}, {4, 4}}}),
           kUnit);
  std::size_t steps = 0, after = 0;
  for (const BoundaryLoop& loop : s.sorted.kept) steps += loop.steps.size();
  const Array<BoundaryLoop> rings = simple_rings(s.soup, s.arrangement, std::move(s.sorted.kept));
  for (const BoundaryLoop& ring : rings) {
    after += ring.steps.size();
    EXPECT_EQ(std::abs(ring.turning), 1);
    std::set<std::uint32_t> nodes;
    for (const Step& step : ring.steps)
      if (const std::uint32_t node = s.arrangement.end_node(step); node != kNone) {
        EXPECT_TRUE(nodes.insert(node).second) << "a ring meets itself";
      }
  }
  EXPECT_EQ(after, steps) << "rings have the sub-edges of the loops";
  EXPECT_EQ(std::count_if(rings.begin(), rings.end(), [](const BoundaryLoop& r) { return r.turning > 0; }), 1);
}

}  // namespace
}  // namespace dymsum::planar
