// Balls round the edges of a vertex tell what looking at all edges tells, and look at few.
#include "spatial/gauss/ring_bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace dymsum::test {
namespace {

using spatial::RingBounds;
using spatial::Vec3;

/// Round a cone that is not quite round.
std::vector<Vec3> ring_of(std::uint32_t n, double opening, double uneven) {
  std::vector<Vec3> ring;
  for (std::uint32_t k = 0; k < n; ++k) {
    const double a = 2 * std::numbers::pi * k / n, r = opening * (1 + uneven * std::cos(2 * a));
    const Vec3 v{r * std::cos(a), r * std::sin(a), -1};
    ring.push_back((1 / length(v)) * v);
  }
  return ring;
}

Vec3 random_vector(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return {normal(random), normal(random), normal(random)};
}

TEST(RingBounds, tell_what_all_vectors_tell) {
  std::mt19937_64 random(91);
  for (const std::uint32_t n : {32u, 33u, 64u, 65u, 511u, 1000u, 5000u})
    for (const double opening : {0.1, 1.0, 20.0}) {
      const std::vector<Vec3> ring = ring_of(n, opening, 0.3);
      const RingBounds bounds(ring);
      std::size_t looked = 0;
      for (int k = 0; k < 200; ++k) {
        Vec3 along = random_vector(random);
        if (k % 4 == 0) along = cross(along, ring[random() % n]);                       // zero for one of them, nearly
        if (k % 4 == 1) along = Vec3{0, 0, 1} + 0.3 / opening * random_vector(random);  // all fall, perhaps
        const auto value = [&](std::uint32_t i) {
          ++looked;
          return dot(ring[i], along);
        };
        double most = -1e300;
        for (const Vec3& v : ring) most = std::max(most, dot(v, along));
        const double above = bounds.above_all(along, value);
        ASSERT_GE(above, most);
        if (most < 0 && above != most) {
          ASSERT_LE(above, most / 4);
        }
        ASSERT_EQ(dot(ring[bounds.largest(along, value)], along), most);
        // Where look_above does not look, all are below.
        const double least = most - 0.01 * static_cast<double>(random() % 10);
        std::vector<bool> seen(n, false);
        bounds.look_above(along, least, [&](std::uint32_t first, std::uint32_t last) {
          std::fill(seen.begin() + first, seen.begin() + last, true);
        });
        std::uint32_t end = 0;
        bounds.signs(along, 1e-12, [&](std::uint32_t first, std::uint32_t last, int sign) {
          EXPECT_EQ(first, end);
          end = last;
          for (std::uint32_t i = first; i < last; ++i) EXPECT_TRUE(sign == 0 || sign * dot(ring[i], along) > 1e-12);
          if (sign == 0) looked += last - first;
          return false;
        });
        ASSERT_EQ(end, n);
        for (std::uint32_t i = 0; i < n; ++i) ASSERT_TRUE(seen[i] || dot(ring[i], along) < least);
      }
      if (n >= 1000) {
        EXPECT_LT(looked, 200u * 3 * n / 8) << n << " " << opening;
      }
    }
}

}  // namespace
}  // namespace dymsum::test
