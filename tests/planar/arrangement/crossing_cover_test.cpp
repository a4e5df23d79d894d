// Parts of segments inside parallelograms of edges that cross: sums are the same without them, and few crossings are
// left where spikes are finer than any cell.
#include "planar/arrangement/live_pieces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dymsum/planar_sum.h"
#include "dymsum/shapes.h"
#include "oracles/sanitized.h"
#include "planar/operand/operand.h"
#include "planar/result/planar_sum.h"
#include "planar/sum/minkowski_sum.h"

namespace dymsum::planar {
namespace {

enum class Kind : std::uint8_t { doubles, turned, decimals, floats, noisy };

/// Radii 3 and 5.
Region star(int n, Kind kind) {
  Ring ring;
  for (int k = 0; k < n; ++k) {
    const double r = k % 2 == 0 ? 5 : 3, at = 2 * std::numbers::pi * k / n + (kind == Kind::turned ? 0.3 : 0);
    Point v{r * std::cos(at), r * std::sin(at)};
    if (kind == Kind::decimals) v = {std::round(v.x * 1e4) / 1e4, std::round(v.y * 1e4) / 1e4};
    if (kind == Kind::floats) v = {static_cast<float>(v.x), static_cast<float>(v.y)};
    if (kind == Kind::noisy) v = {v.x + 1e-3 * std::sin(7.0 * k * k), v.y + 1e-3 * std::cos(5.0 * k * k)};
    ring.push_back(v);
  }
  RegionData data;
  data.parts.push_back({ring, {}});
  return Region::create(std::move(data)).value();
}

Result<PlanarSum> refined(const Region& p, const Region& q) {
  Result<SumState> state = compute_boundary(prepared_operand(p, 0), prepared_operand(q, 1), {}, Refine::always);
  if (!state.ok()) return state.error();
  return finish_sum(std::move(state).value(), {});
}

TEST(CrossingCover, sums_are_the_same_as_without) {
  SumOptions brute;
  brute.engine = Engine::brute;
  for (const Kind kind : {Kind::doubles, Kind::turned, Kind::decimals, Kind::floats, Kind::noisy}) {
    const Region s = star(60, kind);
    for (const Region& q : {s, star(22, Kind::doubles), shapes::grate(4, 2, 1, 6), shapes::comb(5, 1, 0.5, 3)}) {
      const Result<PlanarSum> sum = refined(s, q);
      ASSERT_TRUE(sum.ok());
      ASSERT_TRUE(*sum == *minkowski_sum(s, q, brute)) << static_cast<int>(kind);
    }
  }
}

// Without it ten crossings for every vertex, and 160 for stars of 1,600 points, whose memory and time that took.
TEST(CrossingCover, regular_stars_with_themselves_have_few_crossings) {
  for (const Kind kind : {Kind::doubles, Kind::turned, Kind::decimals, Kind::floats, Kind::noisy}) {
    const Region s = star(oracles::kSanitized ? 100 : 400, kind);
    const Result<PlanarSum> sum = refined(s, s);
    ASSERT_TRUE(sum.ok());
    EXPECT_LT(sum->stats.crossings, 2 * sum->vertex_count()) << static_cast<int>(kind);
  }
}

}  // namespace
}  // namespace dymsum::planar
