// Validation of large and of ill-distributed regions. The limits, in processor time, are about ten times what is
// needed; a quadratic method misses them by orders of magnitude.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <numbers>

#include "dymsum/region.h"
#include "oracles/sanitized.h"
#include "planar/region/region_cases.h"

namespace dymsum::test {
namespace {

const double kSlowdown = oracles::kSanitized ? 10 : 1;

std::string timed_verdict(const char* what, RegionData data, double limit_s) {
  const std::clock_t start = std::clock();
  const Result<Region> result = Region::create(std::move(data));
  const double taken_s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  std::printf("%s: %.3f s\n", what, taken_s);
  EXPECT_LT(taken_s, limit_s * kSlowdown) << what;
  return result.ok() ? "valid" : std::string(name(result.error().code));
}

double noise(std::uint64_t& state) {
  state = state * 6364136223846793005u + 1442695040888963407u;
  return static_cast<double>(state >> 40) / (1 << 24);
}

Ring noisy_star(int count, std::uint64_t seed) {
  Ring ring;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count, radius = 0.5 + 0.5 * noise(seed);
    ring.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return ring;
}

// Teeth of the given length; the long edges all meet one line across.
Ring comb(int teeth, double length, bool upright) {
  Ring ring;
  const auto add = [&ring, upright](double along, double across) {
    ring.push_back(upright ? Point{along, across} : Point{across, -along});
  };
  add(0, -1);
  add(2.0 * teeth, -1);
  for (int i = teeth; i > 0; --i) {
    add(2.0 * i, 0);
    add(2.0 * i - 0.3, length);
    add(2.0 * i - 0.7, length);
    add(2.0 * i - 1, 0);
  }
  add(0, 0);
  return ring;
}

TEST(RegionSize, NoisyStarWith100000Vertices) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    EXPECT_EQ(timed_verdict("noisy star", one_ring(noisy_star(100000, seed)), 1), "valid") << "seed " << seed;
  }
}

TEST(RegionSize, AStarWithOneVertexMovedAcrossTheCentre) {
  Ring ring = noisy_star(100000, 4);
  ring[12345] = {-3 * ring[12345].x, -3 * ring[12345].y};
  EXPECT_EQ(timed_verdict("crossed star", one_ring(ring), 1), "self_crossing");
}

TEST(RegionSize, CombsWith100000Teeth) {
  EXPECT_EQ(timed_verdict("upright comb", one_ring(comb(100000, 1e6, true)), 5), "valid");
  EXPECT_EQ(timed_verdict("lying comb", one_ring(comb(100000, 1e6, false)), 5), "valid");
}

TEST(RegionSize, ConcentricPartsAndHoles) {
  RegionData data;
  const int depth = 20000;
  for (int i = depth; i > 0; --i) {
    const double r = 2 * i;
    data.parts.push_back({box(-r, -r, r, r), {reversed(box(1 - r, 1 - r, r - 1, r - 1))}});
  }
  EXPECT_EQ(timed_verdict("concentric frames", data, 2), "valid");
  data.parts[depth / 2].holes.clear();
  EXPECT_EQ(timed_verdict("one of them filled", data, 2), "parts_overlap");
}

TEST(RegionSize, ManyPartsAndHolesTouchingInCorners) {
  RegionData board;
  Part frame{box(-1, -1, 301, 301), {}};
  for (int x = 0; x < 300; ++x) {
    for (int y = x % 2; y < 300; y += 2) frame.holes.push_back(reversed(box(x, y, x + 1, y + 1)));
  }
  board.parts.push_back(frame);
  EXPECT_EQ(timed_verdict("chessboard of holes", board, 2), "valid");
  RegionData parts;
  for (const Ring& hole : frame.holes) parts.parts.push_back({reversed(hole), {}});
  EXPECT_EQ(timed_verdict("chessboard of parts", parts, 2), "valid");
}

TEST(RegionSize, ManyVerticesOnOneLongEdge) {
  RegionData data;
  const int count = 50000;
  data.parts.push_back({{{0, 0}, {0, -1}, {2.0 * count, -1}, {2.0 * count, 0}}, {}});
  for (int i = 0; i < count; ++i) {
    data.parts.push_back({{{2.0 * i + 1, 0}, {2.0 * i + 1.5, 1}, {2.0 * i + 0.5, 1}}, {}});
  }
  EXPECT_EQ(timed_verdict("triangles standing on an edge", data, 2), "valid");
}

TEST(RegionSize, EmptyRegionIsValid) { EXPECT_EQ(timed_verdict("nothing", {}, 1), "valid"); }

}  // namespace
}  // namespace dymsum::test
