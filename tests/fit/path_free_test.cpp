// What doubles leave out of a search for critical scales, and scales that are not tested as they are known to be
// blocked: the answer is that of looking at everything.
#include "fit/path_free.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "dymsum/shapes.h"
#include "fit/blocked_scales.h"
#include "fit/free_intervals.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/pair_text.h"
#include "oracles/tiny_regions.h"
#include "planar/operand/operand.h"

namespace dymsum::oracles {
namespace {

using exact::BigRational;
using planar::PathFree;

constexpr std::uint64_t kPathSeed = 20261130;

/// The path of a part past obstacles, as scale_range looks at it.
struct Walk {
  Walk(const Region& part, const std::vector<Point>& path, const Region& obstacles)
      : base(planar::OperandPair::create(
                 {planar::prepared_operand(obstacles, 0), planar::prepared_operand(part, 1, true)},
                 {path, std::vector<Point>{Point{0, 0}}}, 1, 0)
                 .value()),
        free(base, static_cast<std::uint32_t>(base->lattice->points[0]->input.size() - path.size()),
             static_cast<std::uint32_t>(path.size()),
             static_cast<std::uint32_t>(base->lattice->points[1]->input.size() - 1), beside(path)) {}
  std::uint32_t beside(const std::vector<Point>& path) const {
    std::uint32_t k = 0;
    while (base->lattice->points[0]->input[k] == path[0]) ++k;
    return k;
  }
  std::shared_ptr<const planar::OperandPair> base;
  PathFree free;
};

struct Counts {
  std::size_t rounds = 0, intervals = 0, quick = 0, slow = 0;
};

void expect_same(const Region& part, const std::vector<Point>& path, const Region& obstacles, Counts& counts) {
  const Walk walk(part, path, obstacles);
  const auto nothing = [](double) {};
  const PathFree::Critical all = walk.free.critical(nothing, true);
  EXPECT_EQ(walk.free.critical(nothing), all);
  ScaleRange slow;
  ASSERT_TRUE(
      free_intervals(all, std::nullopt, {}, slow, [&](const BigRational& s) { return walk.free.free(s); }).ok());
  const Result<ScaleRange> quick = scale_range(part, path, obstacles);
  ASSERT_TRUE(quick.ok());
  EXPECT_EQ(quick->critical, slow.critical);
  EXPECT_LE(quick->tested, slow.tested);
  ASSERT_EQ(quick->free.size(), slow.free.size());
  for (std::size_t k = 0; k < slow.free.size(); ++k) {
    const ScaleInterval &a = quick->free[k], &b = slow.free[k];
    EXPECT_TRUE(a.low == b.low && a.high == b.high && a.at_low == b.at_low && a.at_high == b.at_high) << k;
  }
  ++counts.rounds;
  counts.intervals += slow.free.size();
  counts.quick += quick->tested;
  counts.slow += slow.tested;
}

TEST(PathFree, looks_at_less_and_finds_the_same_on_tiny_grids) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kPathSeed));
  Counts counts;
  for (int k = 0; k < 60; ++k) {
    Random random(kPathSeed + static_cast<std::uint64_t>(k));
    const RegionData obstacles = random_parts(random, 7), part = moved(random_parts(random, 3), -1, -1);
    std::vector<Point> path;
    for (int w = 0; w < 1 + k % 4; ++w)
      if (const Point at{random.below(12) - 2.0, random.below(12) - 2.0}; path.empty() || !(path.back() == at))
        path.push_back(at);
    SCOPED_TRACE("pair " + std::to_string(k) + "\n" + to_wkt(obstacles) + "\n" + to_wkt(part));
    expect_same(Region::create(part).value(), path, Region::create(obstacles).value(), counts);
    if (::testing::Test::HasFailure()) return;
  }
  std::printf("%zu tests instead of %zu\n", counts.quick, counts.slow);
  EXPECT_GT(counts.intervals, 20u);
  EXPECT_LT(2 * counts.quick, counts.slow);
}

TEST(PathFree, looks_at_less_and_finds_the_same_of_every_kind_of_coordinates) {
  Counts counts;
  for (const CoordinateKind kind : kCoordinateKinds) {
    SCOPED_TRACE(name_of(kind));
    std::mt19937_64 noise(kPathSeed);
    const Result<Region> part = Region::create(of_kind(shapes::noisy_star(30, 0.7, 3).data(), kind, noise)),
                         grate = Region::create(of_kind(shapes::grate(4, 2, 1, 5).data(), kind, noise));
    if (!part || !grate) continue;
    const auto box = bounds(*grate);
    std::vector<Point> path;
    for (int w = 0; w < 12; ++w)
      path.push_back({box[0] + (box[2] - box[0]) * (w % 4) / 3, box[1] - 1 + (box[3] - box[1] + 2) * w / 11});
    expect_same(*part, path, *grate, counts);
    expect_same(*part, {{box[0] - 1.0 / 3, box[1] - 1}}, *grate, counts);
    if (::testing::Test::HasFailure()) return;
  }
  std::printf("%zu tests instead of %zu\n", counts.quick, counts.slow);
  EXPECT_GT(counts.rounds, 8u);
  EXPECT_LT(4 * counts.quick, counts.slow);
}

TEST(PathFree, a_position_is_blocked_as_long_as_two_edges_cross) {
  // A square of half width s about (5, 1/2) meets the wall x >= 6, and crosses its edge until its corners are beyond
  // it.
  const Region part = shapes::rectangle(-1, -1, 1, 1), wall = shapes::rectangle(6, 0, 7, 1);
  const Walk walk(part, {{5, 0.5}}, wall);
  const planar::BlockedSearch search(*walk.base);
  const auto blocked = search.about({5, BigRational(1, 2)}, BigRational(5, 4));
  ASSERT_TRUE(blocked.has_value());
  EXPECT_EQ(blocked->low, 1);
  ASSERT_TRUE(blocked->high.has_value());
  EXPECT_EQ(*blocked->high, 2);
  EXPECT_FALSE(search.about({5, BigRational(1, 2)}, BigRational(1, 2)).has_value());
}

}  // namespace
}  // namespace dymsum::oracles
