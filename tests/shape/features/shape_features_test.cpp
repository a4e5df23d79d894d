#include "dymsum/shape_features.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "dymsum/region_io.h"
#include "dymsum/shapes.h"
#include "oracles/tiny_regions.h"
#include "oracles/verdict.h"
#include "shape/complex/complex.h"
#include "shape/features/tracks.h"

namespace dymsum {
namespace {

Region ring_region(const Ring& outer, const std::vector<Ring>& holes = {}) {
  return Region::create({{{outer, holes}}, {}, {}}).value();
}

/// A plate with two rectangular notches of widths 2 and 4.
Region two_notches() {
  return ring_region(
      {{0, 0}, {20, 0}, {20, 10}, {14, 10}, {14, 4}, {10, 4}, {10, 10}, {6, 10}, {6, 2}, {4, 2}, {4, 10}, {0, 10}});
}

Region star(int tips) {
  Ring ring;
  for (int i = 0; i < 2 * tips; ++i) {
    const double angle = M_PI * i / tips, r = i % 2 == 0 ? 100 : 40;
    ring.push_back({std::round(r * std::cos(angle) * 64), std::round(r * std::sin(angle) * 64)});
  }
  return ring_region(ring);
}

Region grid_of_holes(int n) {
  std::vector<Ring> holes;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double x = 4 * i + 1, y = 4 * j + 1;
      holes.push_back({{x, y}, {x, y + 2}, {x + 2, y + 2}, {x + 2, y}});
    }
  const double size = 4 * n;
  return ring_region({{0, 0}, {size, 0}, {size, size}, {0, size}}, holes);
}

Region mapped(const Region& region, double a, double b, double c, double d, Point by) {
  RegionData data = region.data();
  const bool reflected = a * d - b * c < 0;
  const auto map = [&](Ring& ring) {
    for (Point& p : ring) p = {a * p.x + b * p.y + by.x, c * p.x + d * p.y + by.y};
    if (reflected) std::reverse(ring.begin(), ring.end());
  };
  for (Part& part : data.parts) {
    map(part.outer);
    for (Ring& hole : part.holes) map(hole);
  }
  return Region::create(std::move(data)).value();
}

ShapeFeatures features_of(const Region& region, const FeatureOptions& options = {}) {
  return ShapeFeatures::create(region, options).value();
}

std::multiset<std::pair<std::uint32_t, std::uint32_t>> events_of_bars(const ShapeFeatures& features) {
  std::multiset<std::pair<std::uint32_t, std::uint32_t>> events;
  for (const FeatureBar& bar : features.bars()) events.insert({bar.birth, bar.death.value_or(0xffffffff)});
  return events;
}

std::size_t reflex_count(const Region& region) {
  std::size_t count = 0;
  const auto see = [&](const Ring& r) {
    for (std::size_t i = 0, n = r.size(); i < n; ++i) {
      const Point a = r[i], b = r[(i + 1) % n], c = r[(i + 2) % n];
      count += (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x) < 0;
    }
  };
  for (const Part& part : region.parts()) {
    see(part.outer);
    for (const Ring& hole : part.holes) see(hole);
  }
  return count;
}

std::vector<Region> shapes() { return {two_notches(), star(5), star(8), grid_of_holes(3)}; }

TEST(ShapeFeatures, BridgesOfDiameterZeroAreTheReflexVertices) {
  for (const Region& region : shapes()) {
    const ShapeFeatures features = features_of(region);
    const std::vector<AlphaBridge> bridges = features.bridges(0).value();
    EXPECT_EQ(bridges.size(), reflex_count(region));
    std::set<std::uint32_t> minima;
    for (const AlphaBridge& b : bridges) {
      EXPECT_EQ(b.length, 0);
      EXPECT_EQ(b.pocket_size, 1u);
      minima.insert(b.minimum.value());
    }
    EXPECT_EQ(minima.size(), bridges.size());
  }
}

TEST(ShapeFeatures, BridgesBeyondTheLastEventAreHullEdges) {
  const ShapeFeatures notches = features_of(two_notches());
  const std::vector<AlphaBridge> bridges = notches.bridges(1000).value();
  ASSERT_EQ(bridges.size(), 2u);
  for (const AlphaBridge& b : bridges)
    EXPECT_TRUE(b.from.at_vertex && b.to.at_vertex && b.from.at.y == 10 && b.to.at.y == 10);
  EXPECT_EQ(features_of(star(5)).bridges(1000000).value().size(), 5u);
  EXPECT_EQ(features_of(grid_of_holes(3)).bridges(1000).value().size(), 0u);
}

TEST(ShapeFeatures, RectangularNotchesMergeAtTheirWidth) {
  const ShapeFeatures features = features_of(two_notches());
  ASSERT_EQ(features.bars().size(), 4u);
  EXPECT_EQ(features.event_count(), 3u);
  EXPECT_EQ(features.event_text(1), "2");
  EXPECT_EQ(features.event_text(2), "4");
  std::size_t endless = 0;
  for (const FeatureBar& bar : features.bars()) {
    EXPECT_EQ(bar.birth_alpha, 0);
    EXPECT_EQ(bar.minimum, bar.vertex);
    endless += bar.died == FeatureBar::Death::never;
  }
  EXPECT_EQ(endless, 2u);
}

TEST(ShapeFeatures, AlikeHolesFillAtOneEvent) {
  const ShapeFeatures features = features_of(grid_of_holes(3));
  ASSERT_EQ(features.bars().size(), 36u);
  for (const FeatureBar& bar : features.bars()) {
    EXPECT_TRUE(bar.in_hole);
    EXPECT_EQ(bar.died, FeatureBar::Death::filled);
    EXPECT_EQ(bar.death_alpha, 2);
    EXPECT_EQ(bar.death, features.bars()[0].death);
  }
}

TEST(ShapeFeatures, GapsBetweenPartsAreBornInPairs) {
  const Region two =
      Region::create({{{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {}}, {{{7, 0}, {11, 0}, {11, 4}, {7, 4}}, {}}}, {}, {}})
          .value();
  const ShapeFeatures features = features_of(two);
  ASSERT_EQ(features.bars().size(), 2u);
  for (const FeatureBar& bar : features.bars()) {
    EXPECT_EQ(bar.born, FeatureBar::Birth::neck);
    EXPECT_EQ(bar.birth_alpha, 3);
    EXPECT_FALSE(bar.minimum.has_value());
  }
  for (const int alpha : {3, 4}) {
    const std::vector<AlphaBridge> bridges = features.bridges(alpha).value();
    ASSERT_EQ(bridges.size(), 2u);
    EXPECT_TRUE(bridges[0].gap && bridges[1].gap);
  }
  EXPECT_EQ(features.bridges(2).value().size(), 0u);
}

TEST(ShapeFeatures, EventsStayUnderRigidMotionsAndScale) {
  for (const Region& region : shapes()) {
    const auto expected = events_of_bars(features_of(region));
    EXPECT_EQ(events_of_bars(features_of(mapped(region, 0, -1, 1, 0, {7, -3}))), expected);
    EXPECT_EQ(events_of_bars(features_of(mapped(region, -1, 0, 0, 1, {0, 5}))), expected);
    EXPECT_EQ(events_of_bars(features_of(mapped(region, 3, -4, 4, 3, {1, 2}))), expected);
    EXPECT_EQ(events_of_bars(features_of(mapped(region, 0.25, 0, 0, 0.25, {}))), expected);
  }
}

/// What motions keep of every bar, in the order of the list.
using BarText = std::tuple<std::uint32_t, std::uint32_t, int, std::uint32_t, double, bool>;
std::vector<BarText> listed(const ShapeFeatures& features) {
  std::vector<BarText> bars;
  for (const FeatureBar& bar : features.bars()) {
    const std::uint32_t parent = bar.parent ? features.bars()[*bar.parent].death.value_or(0xfffffffe) : 0xffffffff;
    bars.emplace_back(bar.birth, bar.death.value_or(0xffffffff), static_cast<int>(bar.died), parent, bar.concavity,
                      bar.in_hole);
  }
  return bars;
}

/// Rings begin elsewhere, parts come in another order.
RegionData begun_elsewhere(RegionData data) {
  for (Part& part : data.parts) {
    std::rotate(part.outer.begin(), part.outer.begin() + std::ptrdiff_t(part.outer.size() / 2), part.outer.end());
    for (Ring& hole : part.holes) std::rotate(hole.begin(), hole.begin() + 1, hole.end());
  }
  std::reverse(data.parts.begin(), data.parts.end());
  return data;
}

TEST(ShapeFeatures, TiesAreDecidedTheSameInAllMotions) {
  std::size_t bars = 0, equal_births = 0;
  const std::uint64_t first = oracles::setting("DYMSUM_FIRST_SEED", 0);
  const std::uint64_t count = oracles::setting("DYMSUM_FUZZ_PAIRS", 250) / 2;
  std::vector<RegionData> all = {two_notches().data(), star(8).data(), grid_of_holes(3).data(),
                                 shapes::comb(6, 2, 1, 3).data(), shapes::noisy_star(40, 0.3, 4).data()};
  for (Point& p : all.back().parts[0].outer) p = {std::round(64 * p.x), std::round(64 * p.y)};
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    oracles::Random random(9000 + seed);
    all.push_back(oracles::random_parts(random, 8));
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    SCOPED_TRACE("region " + std::to_string(i));
    const Region region = Region::create(all[i]).value();
    const ShapeFeatures features = features_of(region);
    const std::vector<BarText> expected = listed(features);
    bars += expected.size();
    for (const FeatureBar& bar : features.bars())
      equal_births += bar.birth == 0 && bar.died == FeatureBar::Death::merged;
    EXPECT_EQ(listed(features_of(mapped(region, 0, -1, 1, 0, {7, -3}))), expected);
    EXPECT_EQ(listed(features_of(mapped(region, -1, 0, 0, 1, {0, 5}))), expected);
    EXPECT_EQ(listed(features_of(mapped(region, 0, 1, 1, 0, {3, 0}))), expected);
    EXPECT_EQ(listed(features_of(mapped(region, 1, 0, 0, -1, {0, 9}))), expected);
    EXPECT_EQ(listed(features_of(Region::create(begun_elsewhere(all[i])).value())), expected);
  }
  EXPECT_GT(equal_births, bars / 20);
}

TEST(ShapeFeatures, ShortestPathsGoAroundCornersOfThePocket) {
  // A pocket with a side arm: the end of the arm is 2 below the bridge, and 2 + 8 - 2 away around its corner.
  const Region region =
      ring_region({{0, 0}, {20, 0}, {20, 10}, {6, 10}, {6, 8}, {14, 8}, {14, 6}, {4, 6}, {4, 10}, {0, 10}});
  const auto largest = [&](Concavity measure) {
    double most = 0;
    const ShapeFeatures features = features_of(region, {measure, 0, 0, {}});
    for (const AlphaBridge& b : features.bridges(1000).value()) most = std::max(most, b.concavity);
    return most;
  };
  EXPECT_EQ(largest(Concavity::straight_line), 4);
  EXPECT_DOUBLE_EQ(largest(Concavity::shortest_path), 2 + std::hypot(8, 2));
  EXPECT_DOUBLE_EQ(largest(Concavity::hybrid1), 2 + std::hypot(8, 2));
  EXPECT_EQ(largest(Concavity::hybrid2), 4);
}

/// Every pocket has ears until it is a triangle, or it is reported as a defect.
TEST(ShapeFeatures, ShortestPathsInPocketsOfAllKinds) {
  std::mt19937 random(5);
  const auto walk = [&](std::size_t n) {
    std::vector<Point> points;
    while (points.size() < n) {
      const Point p{double(random() % 7), double(random() % 7)};
      if (points.empty() || points.back() != p) points.push_back(p);
    }
    return points;
  };
  int made = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::vector<Point> points = walk(5 + std::size_t(i % 4));
    const Result<Region> region =
        i % 2 == 0 ? Region::create({{}, {points}, {}}) : Region::create({{{points, {}}}, {}, {}});
    if (!region) continue;
    for (const Concavity concavity : {Concavity::shortest_path, Concavity::straight_line, Concavity::hybrid1}) {
      const Result<ShapeFeatures> features = ShapeFeatures::create(region.value(), {concavity, 0, 1, {}});
      if (!features) continue;
      ++made;
      for (const FeatureBar& bar : features.value().bars())
        EXPECT_TRUE(std::isfinite(bar.concavity) && bar.concavity >= 0);
    }
  }
  EXPECT_GT(made, 300);
}

/// The oldest birth below an edge, over all ways down.
std::uint32_t oldest_below(const shape::Complex& complex, const std::vector<shape::Junction>& junctions,
                           const std::map<std::uint32_t, std::size_t>& below, std::uint32_t edge) {
  const shape::Junction& j = junctions[below.at(edge)];
  std::uint32_t oldest = complex.nodes[j.node()].rank;
  for (const std::uint32_t e : j.in) oldest = std::min(oldest, oldest_below(complex, junctions, below, e));
  return oldest;
}

TEST(Tracks, WithoutPocketsTheyCountFromTheOldestBirthBelow) {
  for (const Region& region : shapes()) {
    const shape::Complex complex = shape::make_complex(region, shape::Side::outside, shape::Engine::brute).value();
    const std::vector<shape::Junction> junctions = shape::junctions_of(complex);
    std::map<std::uint32_t, std::size_t> below;
    for (std::size_t j = 0; j < junctions.size(); ++j)
      for (const std::uint32_t e : junctions[j].out) below[e] = j;
    const shape::PocketOracle none{[](std::uint32_t) { return shape::PocketMinimumAt{}; },
                                   [](std::uint32_t, std::uint32_t) { return false; },
                                   [](std::uint32_t) { return shape::PocketAt::gap; },
                                   [](std::uint32_t) { return std::array<std::uint32_t, 4>{}; }};
    const std::vector<shape::Since> since = shape::since_of(complex, junctions, none);
    for (const auto& [e, j] : below) {
      EXPECT_EQ(since[e].depth, 0);
      EXPECT_EQ(complex.nodes[since[e].node].rank, oldest_below(complex, junctions, below, e));
    }
  }
}

/// Significances, the largest first.
std::vector<double> significances(const RegionData& data) {
  const ShapeFeatures features = features_of(Region::create(data).value());
  std::vector<double> all;
  for (const FeatureBar& bar : features.bars()) all.push_back(bar.significance);
  std::sort(all.rbegin(), all.rend());
  return all;
}

/// Every edge in `parts`, every vertex moved by at most eps.
Ring noisy(const Ring& ring, double eps, int parts, std::mt19937& random) {
  std::uniform_real_distribution<double> fraction(-0.7 * eps, 0.7 * eps);
  Ring moved;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i], b = ring[(i + 1) % ring.size()];
    for (int k = 0; k < parts; ++k) {
      const double t = double(k) / parts;
      moved.push_back({a.x + t * (b.x - a.x) + fraction(random), a.y + t * (b.y - a.y) + fraction(random)});
    }
  }
  return moved;
}

TEST(ShapeFeatures, NoiseMovesSignificancesByAtMostTwiceItself) {
  const std::vector<Ring> rings{
      // A pocket behind a neck, with a dent in the wall before it, and without.
      {{-20, 0},
       {20, 0},
       {20, 20},
       {15, 20},
       {1.42, 8.359999},
       {1, 8},
       {1.3, 7.5},
       {0, 6.5},
       {-1.3, 7.5},
       {-1, 8},
       {-15, 20},
       {-20, 20}},
      {{-20, 0}, {20, 0}, {20, 20}, {15, 20}, {1, 8}, {1.3, 7.5}, {0, 6.5}, {-1.3, 7.5}, {-1, 8}, {-15, 20}, {-20, 20}},
      // Corridors: noise makes necks, and full places between them.
      {{-20, 0}, {20, 0}, {20, 20}, {1, 20}, {1, 2}, {-1, 2}, {-1, 20}, {-20, 20}},
      {{-20, 0},
       {20, 0},
       {20, 20},
       {8, 20},
       {1, 14},
       {1, 2},
       {-1, 2},
       {-1, 14},
       {-6, 17},
       {-9, 12},
       {-12, 20},
       {-20, 20}}};
  std::mt19937 random(3);
  for (std::size_t r = 0; r < rings.size(); ++r)
    for (const double eps : {1e-2, 1e-3, 1e-5, 1e-7})
      for (const int parts : {1, 3}) {
        const std::vector<double> clean = significances({{{rings[r], {}}}, {}, {}});
        std::vector<double> moved = significances({{{noisy(rings[r], eps, parts, random), {}}}, {}, {}});
        if (moved.size() < clean.size()) moved.resize(clean.size(), 0);
        for (std::size_t i = 0; i < moved.size(); ++i)
          EXPECT_LE(std::abs(moved[i] - (i < clean.size() ? clean[i] : 0)), 2 * eps)
              << "ring " << r << ", noise " << eps << ", " << parts << " parts, bar " << i;
      }
}

TEST(ShapeFeatures, NoiseMovesSignificancesOfARealShapeAsLittleAsItself) {
  const std::filesystem::path folder = std::filesystem::path(DYMSUM_SOURCE_DIR) / "../shared/data/planar";
  if (!std::filesystem::exists(folder / "mammoth_noise.poly")) GTEST_SKIP() << "no such data";
  const auto of = [&](const char* name) {
    const RegionData data = read_region_data((folder / name).string()).value();
    return significances(repair(data).value().region.data());
  };
  const std::vector<double> clean = of("mammoth.poly"), moved = of("mammoth_noise.poly");
  for (std::size_t i = 0; i < 100; ++i) EXPECT_NEAR(clean[i], moved[i], 4 * 4e-4) << "bar " << i;
}

TEST(ShapeFeatures, SelectionByLifeIsExact) {
  const ShapeFeatures features = features_of(two_notches());
  EXPECT_EQ(features.lasting(4).size(), 3u);
  EXPECT_EQ(features.lasting(Rational::parse("4.0000001").value()).size(), 2u);
  EXPECT_EQ(features.lasting(2, 1, 3).size(), 3u);
}

TEST(ShapeFeatures, WhatCannotBeDoneIsTold) {
  EXPECT_EQ(ShapeFeatures::create(Region()).error().code, ErrorCode::unsupported_operand);
  EXPECT_EQ(features_of(star(5)).bridges(-1).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(ShapeFeatures::create(star(5), {Concavity::hybrid2, -1, 0, {}}).error().code, ErrorCode::out_of_range);
  for (const char* const stop : {"complex", "bars"}) {
    FeatureOptions options;
    options.progress = [&](std::string_view stage, double) { return stage != stop; };
    EXPECT_EQ(ShapeFeatures::create(star(5), options).error().code, ErrorCode::cancelled) << stop;
  }
}

}  // namespace
}  // namespace dymsum
