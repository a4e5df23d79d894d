// Planar sums of coordinates of all kinds: the set by definition of small pairs, and the same from every engine of
// pairs in which hundreds of edges are nearly parallel and hundreds of vertices nearly coincide.
#include <gtest/gtest.h>

#include <cstdio>

#include "dymsum/shapes.h"
#include "oracles/check_sum.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/pair_text.h"
#include "oracles/random.h"
#include "oracles/sanitized.h"
#include "oracles/snapped_shapes.h"
#include "oracles/tiny_regions.h"
#include "oracles/verdict.h"

namespace dymsum::oracles {
namespace {

TEST(PlanarCoordinates, of_every_kind_have_the_sum_by_definition) {
  const std::uint64_t seed = setting("DYMSUM_FUZZ_SEED", 7300), count = setting("DYMSUM_FUZZ_PAIRS", 600) / 200;
  for (const CoordinateKind kind : kCoordinateKinds) {
    std::uint64_t checked = 0;
    for (std::uint64_t k = 0; k < count; ++k) {
      Random random(seed + k);
      std::mt19937_64 noise(seed + k);
      auto [p, q] = random_pair(random, 2 + random.below(3));
      p = of_kind(p, kind, noise), q = of_kind(q, kind, noise);
      const std::string wrong = verdict(p, q);
      if (refused(wrong)) continue;  // rounding made a flat corner cross its neighbour
      ++checked;
      ASSERT_EQ(wrong, "") << name_of(kind) << ", DYMSUM_FUZZ_SEED=" << seed + k << "\n" << to_text(p, q);
    }
    EXPECT_GE(2 * checked, count) << name_of(kind);
  }
}

TEST(PlanarCoordinates, of_every_kind_are_alike_to_every_engine) {
  std::mt19937_64 random(7301);
  const std::pair<Region, Region> pairs[] = {{shapes::comb(7, 2, 1, 3), shapes::comb(4, 2, 1, 3)},
                                             {shapes::grate(4, 2, 1, 8), shapes::letter_l(3, 3, 1)},
                                             {snapped_shapes::gear(9, 3, 4), snapped_shapes::gear(5, 1, 2)},
                                             {shapes::random_polygon(24, 2, 5), shapes::noisy_star(15, 0.6, 5)}};
  for (const CoordinateKind kind : kCoordinateKinds)
    for (const auto& [one, other] : pairs) {
      const Result<Region> p = Region::create(of_kind(one.data(), kind, random)),
                           q = Region::create(of_kind(other.data(), kind, random));
      if (!p.ok() || !q.ok()) continue;
      const PlanarSum sum = minkowski_sum(*p, *q).value();
      ASSERT_EQ(spot_check_sum(*p, *q, sum, 40, 7301), "") << name_of(kind) << "\n" << to_text(p->data(), q->data());
      for (const Engine engine : {Engine::brute, Engine::winding}) {
        SumOptions options;
        options.engine = engine;
        ASSERT_TRUE(minkowski_sum(*p, *q, options).value() == sum) << name_of(kind) << "\n"
                                                                   << to_text(p->data(), q->data());
      }
    }
}

}  // namespace
}  // namespace dymsum::oracles
