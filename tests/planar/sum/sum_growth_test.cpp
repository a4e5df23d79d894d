// Sums of large operands: their work and memory are counted, their boundaries compared with membership by definition,
// and they stop soon when asked to.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <string>

#include "dymsum/planar_sum.h"
#include "dymsum/shapes.h"
#include "oracles/random.h"
#include "oracles/sanitized.h"
#include "oracles/verdict.h"
#include "planar/operand/operand.h"
#include "planar/result/planar_sum.h"
#include "planar/sum/minkowski_sum.h"

namespace dymsum {
namespace {

constexpr int kFineGrid = 1024;  ///< a mask of more cells is refined

Result<PlanarSum> refined_sum(const Region& p, const Region& q, const SumOptions& options = {}) {
  Result<planar::SumState> state = planar::compute_boundary(
      planar::prepared_operand(p, 0), planar::prepared_operand(q, 1), options, planar::Refine::always);
  if (!state.ok()) return state.error();
  return planar::finish_sum(std::move(state).value(), options);
}

/// Whether the heavier cases run: DYMSUM_FUZZ_PAIRS at least this.
bool heavy() { return oracles::setting("DYMSUM_FUZZ_PAIRS", 0) >= 100000; }

TEST(SumGrowth, crossings_and_memory_of_a_star_with_itself_grow_little) {
  const int n = oracles::kSanitized ? 1000 : 2000;
  const Region star = shapes::noisy_star(n, 0.6, 1);
  const Result<PlanarSum> sum = minkowski_sum(star, star);
  ASSERT_TRUE(sum.ok());
  EXPECT_TRUE(n < 2000 || sum->stats.mask_grid > kFineGrid);
  EXPECT_LT(sum->stats.crossings, 100u * static_cast<unsigned>(n));
  EXPECT_LT(sum->stats.peak_bytes, 40000u * static_cast<unsigned>(n));
}

TEST(SumGrowth, coarse_sums_are_not_refined) {
  const Region star = shapes::noisy_star(300, 0.6, 1);
  EXPECT_LE(minkowski_sum(star, star)->stats.mask_grid, kFineGrid);
}

// Beside the midpoint of an edge, on either side.
void check_beside_edges(const Region& p, const Region& q, const PlanarSum& sum, int count, std::uint64_t seed) {
  oracles::Random random(seed);
  const std::vector<SumVertex>& ring = sum.parts.at(0).outer.vertices;
  for (int checked = 0; checked < count;) {
    const std::size_t k = random.below(static_cast<int>(ring.size()));
    const Point a = ring[k].at, b = ring[(k + 1) % ring.size()].at;
    const double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
    if (length < 1e-6) continue;
    ++checked;
    const double aside = 1e-10 / length;
    const auto beside = [&](double way) {
      return Point{(a.x + b.x) / 2 - way * aside * dy, (a.y + b.y) / 2 + way * aside * dx};
    };
    EXPECT_TRUE(contains(p, q, beside(1))) << "edge " << k;
    EXPECT_FALSE(contains(p, q, beside(-1))) << "edge " << k;
  }
}

TEST(SumGrowth, boundaries_of_large_sums_are_those_of_the_definition) {
  const int n = heavy() ? 4000 : oracles::kSanitized ? 900 : 1800;
  const Region p = shapes::noisy_star(n, 0.8, 1), q = shapes::noisy_star(n, 0.8, 2);
  const Result<PlanarSum> sum = n < 1500 ? refined_sum(p, q) : minkowski_sum(p, q);
  ASSERT_TRUE(sum.ok());
  EXPECT_GT(sum->stats.mask_grid, kFineGrid);
  check_beside_edges(p, q, *sum, heavy() ? 40 : 3, 5);
}

TEST(SumGrowth, large_sums_equal_those_of_the_reference) {
  const int n = heavy() ? 600 : oracles::kSanitized ? 60 : 150;
  const Region p = shapes::noisy_star(n, 0.5, 3), q = shapes::noisy_star(n, 0.9, 4);
  SumOptions brute;
  brute.engine = Engine::brute;
  EXPECT_TRUE(*refined_sum(p, q) == *minkowski_sum(p, q, brute));
}

TEST(SumGrowth, every_stage_stops_on_request) {
  const Region star = shapes::noisy_star(120, 0.6, 1);
  for (const std::string_view stage :
       {"convolution", "mask", "segments", "refinement", "crossings", "arrangement", "loops", "collision"}) {
    SumOptions options;
    options.progress = [&](std::string_view at, double) { return at != stage; };
    const Result<PlanarSum> sum = refined_sum(star, star, options);
    ASSERT_FALSE(sum.ok()) << stage;
    EXPECT_EQ(sum.error().code, ErrorCode::cancelled);
  }
}

TEST(SumGrowth, large_sums_ask_often_whether_to_go_on) {
  if (oracles::kSanitized) GTEST_SKIP() << "times";
  const Region star = shapes::noisy_star(2000, 0.6, 1);
  std::clock_t last = std::clock(), longest = 0;
  SumOptions options;
  options.progress = [&](std::string_view, double fraction) {
    EXPECT_GE(fraction, 0);
    EXPECT_LE(fraction, 1);
    const std::clock_t now = std::clock();
    longest = std::max(longest, now - last);
    last = now;
    return true;
  };
  ASSERT_TRUE(minkowski_sum(star, star, options).ok());
  EXPECT_LT(static_cast<double>(longest) / CLOCKS_PER_SEC, 0.5);
}

}  // namespace
}  // namespace dymsum
