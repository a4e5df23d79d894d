#include "shape/complex/complex.h"

#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "dymsum/region_io.h"
#include "dymsum/shapes.h"
#include "oracles/tiny_regions.h"
#include "shape/complex/definition.h"

namespace dymsum {
namespace {

using shape::Complex;
using shape::Engine;
using shape::Side;
using testing::check_complex;
using testing::summary;
using namespace shapes;

void expect_sound(const Region& region, const std::string& name) {
  for (const Side side : {Side::outside, Side::inside}) {
    Result<Complex> made = make_complex(region, side, Engine::brute);
    ASSERT_TRUE(made.ok()) << name << made.error().to_string();
    EXPECT_EQ(check_complex(*made), "") << name << (side == Side::inside ? " inside" : " outside") << "\n"
                                        << summary(*made);
    Result<Complex> fast = make_complex(region, side, Engine::fast);
    EXPECT_EQ(summary(*fast), summary(*made)) << name;
    EXPECT_TRUE(fast->work.certified) << name;
  }
}

TEST(Complex, Probe) {
  const Region u = letter_u(4, 4, 1);
  expect_sound(u, "u");
  expect_sound(star(5, 1, 3), "star");
  expect_sound(comb(4, 2, 1, 3), "comb");
  expect_sound(grate(4, 2, 1, 3), "grate");
  expect_sound(spiral(2, 12, 1, 0.4), "spiral");
  expect_sound(random_polygon(20, 2, 7), "random");
}

TEST(Complex, Tiny) {
  const char* seeds = std::getenv("SEEDS");
  const int count = seeds != nullptr ? std::atoi(seeds) : 300;
  for (int seed = 0; seed < count; ++seed) {
    oracles::Random random(static_cast<std::uint64_t>(seed));
    const Result<Region> region = Region::create(oracles::random_parts(random, 4 + seed % 5));
    ASSERT_TRUE(region.ok());
    if (std::getenv("SHOW")) {
      std::cout << "seed " << seed << "\n";
      for (const Part& p : region->parts()) {
        for (const Point& v : p.outer) std::cout << v.x << "," << v.y << " ";
        for (const Ring& h : p.holes) {
          std::cout << " hole ";
          for (const Point& v : h) std::cout << v.x << "," << v.y << " ";
        }
        std::cout << std::endl;
      }
    }
    expect_sound(*region, "seed " + std::to_string(seed));
    if (HasFailure()) return;
  }
}

// An isolated point whose cell meets one edge twice, across the direction that its cell is counted from.
TEST(Complex, CellsOfPointsMeetAnEdgeTwice) {
  const Ring triangle = {{0, 6}, {4, 2}, {7, 5}};
  for (const std::vector<Point>& points : {std::vector<Point>{{6, 6}, {7, 7}}, {{6, 6}, {7, 7}, {3, 2}, {-1, 7}}}) {
    for (int quarter = 0; quarter < 4; ++quarter) {
      const auto turned = [&](Point p) {
        for (int k = 0; k < quarter; ++k) p = {-p.y, p.x};
        return p;
      };
      RegionData data{{{{}, {}}}, {}, {}};
      for (const Point& p : triangle) data.parts[0].outer.push_back(turned(p));
      for (const Point& p : points) data.points.push_back(turned(p));
      expect_sound(Region::create(data).value(), "quarter " + std::to_string(quarter));
    }
  }
}

TEST(Complex, PolylinesAndPointsThatTouchAreRefusedWithThePlace) {
  const Part square{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {}};
  const std::vector<RegionData> touching = {
      {{square}, {{{2, 2}, {6, 2}}}, {}},
      {{square}, {{{1, 1}, {2, 2}}}, {}},
      {{square}, {{{4, 4}, {6, 2}}}, {}},
      {{square}, {}, {{1, 1}}},
      {{square}, {}, {{4, 1}}},
      {{}, {{{0, 0}, {4, 0}}, {{2, 0}, {2, 3}}}, {}},
      {{}, {{{0, 0}, {4, 0}}, {{2, -1}, {2, 3}}}, {}},
      {{}, {{{0, 0}, {4, 0}, {2, 0}}}, {}},
      {{}, {{{0, 0}, {4, 0}}}, {{3, 0}}},
  };
  for (const RegionData& data : touching) {
    const Result<Complex> made = make_complex(Region::create(data).value(), Side::outside);
    ASSERT_FALSE(made.ok());
    EXPECT_EQ(made.error().code, ErrorCode::unsupported_operand);
    EXPECT_TRUE(made.error().evidence.x.has_value());
  }
  expect_sound(Region::create({{square}, {{{5, 0}, {9, 0}, {7, 3}, {5, 0}}}, {{7, 1}}}).value(), "apart");
}

}  // namespace
}  // namespace dymsum
