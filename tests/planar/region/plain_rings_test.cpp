// What validation saves itself: plain rings are proved without a sweep, and never where the sweep says otherwise.
#include "planar/region/plain_rings.h"
#include "oracles/snapped_shapes.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

#include "dymsum/shapes.h"
#include "planar/region/region_validate.h"

namespace dymsum::planar {
namespace {

Ring square(double x, double y, double side) { return {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}}; }
Ring hole(double x, double y, double side) { return {{x, y}, {x, y + side}, {x + side, y + side}, {x + side, y}}; }
RegionData one(Ring ring) { return {{{std::move(ring), {}}}, {}, {}}; }

TEST(PlainRings, GeneratedShapesNeedNoSweep) {
  for (const Region& region :
       {shapes::rectangle(0, 0, 3, 2), snapped_shapes::disc(32, 1), snapped_shapes::disc(5000, 1),
        shapes::grate(20, 1, 0.25, 20), shapes::noisy_star(100, 0.5, 1), snapped_shapes::pockets(20, 10)}) {
    EXPECT_TRUE(plainly_valid(region.data())) << region.vertex_count() << " vertices";
  }
}

TEST(PlainRings, HolesAndSeveralParts) {
  RegionData data{{{square(0, 0, 8), {hole(1, 1, 2), hole(4, 4, 3)}}, {square(9, 0, 3), {hole(10, 1, 1)}}}, {}, {}};
  EXPECT_TRUE(plainly_valid(data));
  data.parts[0].holes[1] = hole(1.5, 1.5, 1);  // inside the other hole
  EXPECT_FALSE(plainly_valid(data));
  data.parts[0].holes[1] = hole(20, 20, 1);  // outside
  EXPECT_FALSE(plainly_valid(data));
  data.parts[0].holes[1] = hole(3, 3, 2);  // touches a corner of the other hole
  EXPECT_FALSE(plainly_valid(data));
}

TEST(PlainRings, WhatIsNotPlainIsLeftToTheSweep) {
  EXPECT_FALSE(plainly_valid({}));
  EXPECT_FALSE(plainly_valid(one({{0, 0}, {1, 0}})));
  EXPECT_FALSE(plainly_valid(one({{0, 0}, {1, 0}, {1, 0}, {0, 1}})));
  EXPECT_FALSE(plainly_valid(one({{0, 0}, {1, 0}, {2, 0}})));
  EXPECT_FALSE(plainly_valid(one({{0, 0}, {2, 0}, {1, 0}, {0, 1}})));  // runs back
  EXPECT_FALSE(plainly_valid(one({{0, 0}, {2, 2}, {2, 0}, {0, 2}})));  // crosses itself
  EXPECT_FALSE(plainly_valid(one({{0, 0}, {0, 1}, {1, 0}})));          // clockwise
  EXPECT_FALSE(
      plainly_valid(one({{0, 3}, {-2, -3}, {3, 1}, {-3, 1}, {2, -3}})));  // turns left everywhere, but twice round
  EXPECT_FALSE(
      plainly_valid(one({{0, 0}, {2, 0}, {1, 0x1p-1074}, {1, 0}})));  // touches itself by less than any product tells
  EXPECT_FALSE(
      plainly_valid(one({{0, 0}, {1e308, -1e308}, {1e308, 1e308}, {-1e308, 1e308}})));  // too large for doubles
  EXPECT_FALSE(plainly_valid(one({{0, 0}, {1, 0}, {NAN, 1}})));
  EXPECT_FALSE(plainly_valid(one({{0, 0}, {1, 0}, {1, INFINITY}})));
}

// Rings of every size up to where boxes around boxes begin, one vertex moved across: whichever way pairs are
// distinguished, none is missed.
TEST(PlainRings, OneVertexAcrossIsSeenInRingsOfEverySize) {
  std::size_t crossing = 0;
  for (int n = 5; n <= 130; ++n) {
    const RegionData star = shapes::noisy_star(n, 0.4, n).data();
    ASSERT_TRUE(plainly_valid(star)) << n;
    for (int k = 0; k < n; ++k) {
      RegionData moved = star;
      Point& v = moved.parts[0].outer[static_cast<std::size_t>(k)];
      v = {-3 * v.x, -3 * v.y};
      const bool valid = !validate_in_full(moved).error;
      crossing += !valid;
      ASSERT_EQ(plainly_valid(moved), valid) << n << ", " << k;
    }
  }
  EXPECT_GT(crossing, 7000u);
}

// Rings on tiny grids touch, cross, fold and nest in every way: what is called plain is valid and touches nowhere.
TEST(PlainRings, NeverSayMoreThanTheSweep) {
  std::mt19937_64 random(20261);
  const auto below = [&](std::uint64_t n) { return random() % n; };
  std::size_t plain = 0, valid = 0;
  for (int k = 0; k < 60000; ++k) {
    const std::uint64_t grid = 3 + below(6);
    const auto ring = [&](std::size_t n) {
      Ring made;
      for (std::size_t i = 0; i < n; ++i)
        made.push_back({static_cast<double>(below(grid)), static_cast<double>(below(grid))});
      return made;
    };
    RegionData data = one(ring(3 + below(6)));
    if (below(4) == 0) data.parts[0].holes.push_back(ring(3 + below(2)));
    if (below(8) == 0) {
      data.parts[0].outer = square(-1, -1, 10);
      data.parts[0].holes.push_back(ring(3 + below(2)));
    }
    if (below(6) == 0) data.parts.push_back({ring(3 + below(2)), {}});
    const Validation full = validate_in_full(data);
    const bool proved = plainly_valid(data);
    plain += proved;
    valid += !full.error && full.touching_points.empty();
    if (proved) {
      ASSERT_FALSE(full.error) << full.error->to_string() << ", case " << k;
      ASSERT_TRUE(full.touching_points.empty()) << "case " << k;
    }
  }
  EXPECT_GT(valid, 1000u);
  EXPECT_GT(plain, valid * 9 / 10);
}

}  // namespace
}  // namespace dymsum::planar
