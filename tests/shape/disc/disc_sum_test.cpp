#include <gtest/gtest.h>
#include <cmath>
#include <numbers>
#include <random>

#include "dymsum/shapes.h"
#include "oracles/snapped_shapes.h"
#include "shape/disc/disc_oracle.h"

namespace dymsum {
namespace {

constexpr double kPi = std::numbers::pi;

Rational fraction(std::int64_t n, std::int64_t d) { return *Rational::of(n, d); }

std::vector<Region> sample_regions() {
  std::vector<Region> regions{shapes::rectangle(0, 0, 3, 2), shapes::letter_u(6, 5, 1),
                              shapes::letter_l(5, 4, 1),     shapes::comb(4, 2, 1, 3),
                              snapped_shapes::star(5, 2, 5), snapped_shapes::gear(6, 4, 5),
                              shapes::grate(3, 2, 1, 4),     snapped_shapes::pockets(3, 1)};
  for (const std::uint64_t seed : {1, 2, 3, 5, 6})
    regions.push_back(shapes::random_polygon(12 + 4 * int(seed), int(seed % 3), seed));
  return regions;
}

struct Box {
  double x0, y0, x1, y1;
};
Box around(const Region& region, double margin) {
  const auto b = bounds(region);
  return {b[0] - margin, b[1] - margin, b[2] + margin, b[3] + margin};
}

/// Radii below, at and beyond the events.
std::vector<DiscRadius> sample_radii(const GrowingDisc& disc, DiscSide side, std::size_t most) {
  const auto events = *disc.events(side);
  std::vector<DiscRadius> radii;
  const std::size_t step = 1 + events.size() / most;
  for (std::size_t i = 0; i < events.size(); i += step) {
    radii.push_back(DiscRadius::at_event(std::uint32_t(i)));
    const double next = i + 1 < events.size() ? events[i + 1].radius : 1.5 * events[i].radius;
    radii.push_back(*Rational::of((events[i].radius + next) / 2));
  }
  if (radii.empty()) radii.push_back(fraction(1, 3));
  return radii;
}

void expect_levels(const DiscSet& set, const Region& region, bool inside, std::mt19937_64& random) {
  oracles::check_form(set);
  const double r = set.radius, margin = 1e-6 * r + 1e-9;
  const auto level = [&](Point z) { return inside ? oracles::depth(region, z) : oracles::distance(region, z); };
  for (const auto& position : oracles::midpoints(set)) {
    EXPECT_NEAR(level(position.at), r, 1e-9 * (1 + r));
    const double step = (inside ? 1 : -1) * std::min(1e-7, position.length / 1000);
    EXPECT_GT(level({position.at.x + step * position.left.x, position.at.y + step * position.left.y}) - r,
              -1e-9 * (1 + r))
        << "towards what is beyond the level";
  }
  const Box box = around(region, inside ? 0 : 1.2 * r);
  std::uniform_real_distribution<double> x(box.x0, box.x1), y(box.y0, box.y1);
  for (int i = 0; i < 30; ++i) {
    const Point z{x(random), y(random)};
    const double d = level(z);
    if (std::abs(d - r) < margin) continue;
    const bool member = inside ? d > r : d < r;
    EXPECT_EQ(oracles::winding(set, z), member ? 1 : 0) << z.x << " " << z.y << " at " << d << " of " << r;
  }
}

TEST(DiscSum, PointsAreInItIfTheirDistanceIsAtMostTheRadius) {
  std::mt19937_64 random(7);
  for (const Region& region : sample_regions()) {
    const GrowingDisc disc(region);
    for (const DiscRadius& r : sample_radii(disc, DiscSide::outside, 8)) {
      const auto set = disc.sum_at(r);
      ASSERT_TRUE(set.ok()) << set.error().to_string();
      SCOPED_TRACE(set->radius_exact);
      expect_levels(*set, region, false, random);
    }
  }
}

TEST(DiscErosion, PointsAreInItIfTheirDepthIsAtLeastTheRadius) {
  std::mt19937_64 random(8);
  for (const Region& region : sample_regions()) {
    const GrowingDisc disc(region);
    for (const DiscRadius& r : sample_radii(disc, DiscSide::inside, 8)) {
      const auto set = disc.eroded_at(r);
      ASSERT_TRUE(set.ok()) << set.error().to_string();
      SCOPED_TRACE(set->radius_exact);
      expect_levels(*set, region, true, random);
    }
  }
}

template <class Clear>
void expect_reached(const DiscSet& set, const Region& region, const Clear& clear, bool opening,
                    std::mt19937_64& random) {
  oracles::check_form(set);
  const Box box = around(region, 0.3 * set.radius);
  std::uniform_real_distribution<double> x(box.x0, box.x1), y(box.y0, box.y1);
  int decided = 0;
  for (int i = 0; i < 16; ++i) {
    const Point z{x(random), y(random)};
    const auto reached = oracles::reached(clear, z, set.radius, 12);
    if (!reached) continue;
    ++decided;
    const bool member = opening ? *reached : !*reached;
    EXPECT_EQ(oracles::winding(set, z), member ? 1 : 0) << z.x << " " << z.y;
  }
  EXPECT_GT(decided, 3);
}

TEST(DiscOpening, PointsAreInItIfADiscInsideTheRegionReachesThem) {
  std::mt19937_64 random(9);
  for (const Region& region : sample_regions()) {
    const GrowingDisc disc(region);
    for (const DiscRadius& r : sample_radii(disc, DiscSide::inside, 4)) {
      const auto set = disc.opened_at(r);
      ASSERT_TRUE(set.ok()) << set.error().to_string();
      SCOPED_TRACE(set->radius_exact);
      expect_reached(
          *set, region, [&](Point z) { return oracles::depth(region, z); }, true, random);
    }
  }
}

TEST(DiscClosing, PointsAreInItIfNoDiscOutsideTheRegionReachesThem) {
  std::mt19937_64 random(10);
  for (const Region& region : sample_regions()) {
    const GrowingDisc disc(region);
    for (const DiscRadius& r : sample_radii(disc, DiscSide::outside, 4)) {
      const auto set = disc.closed_at(r);
      ASSERT_TRUE(set.ok()) << set.error().to_string();
      SCOPED_TRACE(set->radius_exact);
      expect_reached(
          *set, region, [&](Point z) { return oracles::distance(region, z); }, false, random);
    }
  }
}

}  // namespace
}  // namespace dymsum
