#include "thesis/solid_pair_events.h"

#include <gtest/gtest.h>

#include <tuple>

#include "spatial/moving/moving_cases.h"
#include "thesis/pair_intervals.h"

namespace dymsum {
namespace {

TEST(SolidPairEvents, DoublesAgreeWithExactIntervals) {
  for (const auto& [name, p, q] : moving_cases::small_pairs()) {
    if (name == "torus with itself" || name == "gears in mesh") continue;
    SpatialStats stats;
    SpatialOptions options;
    spatial::StageWatch watch(options, stats);
    watch.begin("convolution");
    const spatial::PairFacets all(spatial::ScalingPair(spatial::solid_pair(p, q), 1), watch);
    std::size_t decided = 0, unsure = 0;
    for (std::uint32_t f = 0; f < all.facets().size(); ++f)
      for (std::uint32_t g = f % 5 + 1 + f; g < all.facets().size(); g += 5) {
        if (share_corner(all.facets()[f], all.facets()[g])) continue;
        const std::optional<spatial::PairInterval> near = near_interval(all, f, g);
        ++(near ? decided : unsure);
        const spatial::BigVector &n = all.plane(f).n, &m = all.plane(g).n;
        if (n[1] * m[2] == n[2] * m[1] && n[2] * m[0] == n[0] * m[2] && n[0] * m[1] == n[1] * m[0]) continue;
        const spatial::PairInterval exact = exact_interval(all, f, g, spatial::Ahead::nothing),
                                    quick = exact_interval(all, f, g);
        ASSERT_EQ(std::tie(exact.meets, exact.low, exact.high), std::tie(quick.meets, quick.low, quick.high))
            << name << ": facets " << f << " and " << g;
        if (!near) continue;
        ASSERT_EQ(near->meets, exact.meets) << name << " " << f << " " << g;
        ASSERT_EQ(near->low, exact.low) << name << " " << f << " " << g;
        ASSERT_EQ(near->high, exact.high) << name << " " << f << " " << g;
      }
    EXPECT_GT(decided, unsure / 4) << name;
  }
}

TEST(SolidPairEvents, CountsAreThoseOfEitherOperand) {
  const Mesh p = moving_cases::mesh_of(moving_cases::bumpy(2, 1)), q = moving_cases::mesh_of(moving_cases::bumpy(2, 2));
  SolidScaleOptions of_p;
  of_p.moving = MovingOperand::p;
  const SolidPairEventCount a = count_solid_pair_events(p, q).value(), b = count_solid_pair_events(p, q, of_p).value();
  EXPECT_GT(a.events(), 0u);
  EXPECT_EQ(a.pairs_that_meet, b.pairs_that_meet);
  EXPECT_EQ(a.vertex_on_facet, b.vertex_on_facet);
  EXPECT_EQ(a.edge_on_edge, b.edge_on_edge);
}

}  // namespace
}  // namespace dymsum
