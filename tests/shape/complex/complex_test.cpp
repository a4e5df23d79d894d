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
        for (const Ring& h : p.holes) { std::cout << " hole "; for (const Point& v : h) std::cout << v.x << "," << v.y << " "; }
        std::cout << std::endl;
      }
    }
    expect_sound(*region, "seed " + std::to_string(seed));
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace dymsum
