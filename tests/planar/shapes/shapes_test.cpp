#include "dymsum/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

#include "planar/shapes/shape_looks.h"

namespace dymsum::shapes {
namespace {

TEST(Shapes, same_arguments_give_the_same_bits) {
  EXPECT_EQ(fingerprint(noisy_star(100, 0.5, 7)), 0x1c0dcbd9dee311b0u);
  EXPECT_EQ(fingerprint(random_polygon(60, 3, 7)), 0x3fea5fbc54ad6b8du);
  EXPECT_EQ(fingerprint(spiral(3, 24, 2, 0.8, demo_snap(8.8))), 0x5e4eddfc1c1ed5f6u);
  EXPECT_EQ(fingerprint(spiral(3, 24, 2, 0.8)), 0xfde697f218c64da5u);
  EXPECT_NE(fingerprint(noisy_star(100, 0.5, 7)), fingerprint(noisy_star(100, 0.5, 8)));
}

TEST(Shapes, circle_points_are_symmetric_and_on_the_circle) {
  for (const std::int64_t n : {3, 4, 5, 7, 8, 32, 360, 1000}) {
    for (std::int64_t k = 0; k < n; ++k) {
      const Point p = circle_point(k, n), mirror = circle_point((n - k) % n, n);
      const double angle = 2 * std::acos(-1.0) * static_cast<double>(k) / static_cast<double>(n);
      EXPECT_NEAR(p.x, std::cos(angle), 2e-15) << k << "/" << n;
      EXPECT_NEAR(p.y, std::sin(angle), 2e-15) << k << "/" << n;
      EXPECT_EQ(p.x, mirror.x);
      EXPECT_EQ(p.y, 0.0 - mirror.y);
    }
  }
  EXPECT_EQ(circle_point(1, 4), (Point{0, 1}));
  EXPECT_EQ(circle_point(2, 4), (Point{-1, 0}));
  EXPECT_EQ(circle_point(3, 4), (Point{0, -1}));
  EXPECT_EQ(circle_point(1, 8).x, circle_point(1, 8).y);
}

TEST(Shapes, discs_are_strictly_convex) {
  for (const int n : {3, 4, 5, 32, 360, 2000, 2001, 5000}) {
    const Region region = disc(n, 3);
    EXPECT_EQ(region.vertex_count(), static_cast<std::size_t>(n));
    EXPECT_EQ(reflex_count(region.parts().at(0).outer), 0);
    EXPECT_EQ(region.canonical().vertex_count(), static_cast<std::size_t>(n)) << "collinear vertices";
  }
}

TEST(Shapes, round_shapes_are_on_a_grid_where_that_is_asked_for_and_only_there) {
  EXPECT_EQ(demo_snap(4), 0x1p-21);
  EXPECT_EQ(demo_snap(3.9), 0x1p-22);
  const auto shapes = [](double snap) {
    return std::vector<Region>{disc(7, 3.9, snap), gear(5, 3, 3.9, snap), star(5, 1.1, 3.9, snap),
                               spiral(2, 9, 1.1, 0.7, snap), pockets(7, 3.9, snap)};
  };
  for (const Region& region : shapes(0x1p-22)) EXPECT_TRUE(lies_on_grid(region, 22));
  for (const Region& region : shapes(0)) EXPECT_FALSE(lies_on_grid(region, 40));
  for (const double snap : {0.3, -1.0, 0x1p-1001, 0x1p1001})
    EXPECT_THROW(static_cast<void>(star(5, 1, 2, snap)), std::invalid_argument);
  const Region round = disc(360, 1);
  for (const Point& p : round.parts()[0].outer) EXPECT_NEAR(std::hypot(p.x, p.y), 1, 0x1p-51);
}

TEST(Shapes, counts_follow_the_arguments) {
  EXPECT_EQ(gear(12, 3, 4).vertex_count(), 48u);
  EXPECT_EQ(star(9, 1, 2).vertex_count(), 18u);
  EXPECT_EQ(comb(5, 2, 1, 4).vertex_count(), 20u);
  EXPECT_EQ(grate(6, 2, 0.5, 9).hole_count(), 5u);
  EXPECT_EQ(pockets(20, 10).hole_count(), 20u);
  EXPECT_EQ(pockets(1, 10).hole_count(), 1u);
  EXPECT_EQ(letter_u(6, 7, 1.5).vertex_count(), 8u);
  EXPECT_EQ(letter_l(3, 4, 1).vertex_count(), 6u);
  EXPECT_EQ(spiral(2, 16, 2, 1).vertex_count(), 66u);
  EXPECT_EQ(noisy_star(50, 0.9, 1).vertex_count(), 50u);
  EXPECT_EQ(area(rectangle(-1, -2, 3, 4)), 24);
}

TEST(Shapes, random_polygons_have_their_vertices_and_holes) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Region region = random_polygon(40, 3, seed);
    EXPECT_EQ(region.parts().at(0).outer.size(), 40u) << "seed " << seed;
    EXPECT_EQ(region.hole_count(), 3u) << "seed " << seed;
    EXPECT_GT(reflex_count(region.parts().at(0).outer), 0) << "seed " << seed;
  }
}

TEST(Shapes, radii_of_a_noisy_star_stay_within_the_noise) {
  const Region region = noisy_star(200, 0.25, 3);
  for (const Point& p : region.parts().at(0).outer) {
    const double radius = std::sqrt(p.x * p.x + p.y * p.y);
    EXPECT_GE(radius, 0.75 - 1e-7);
    EXPECT_LE(radius, 1 + 1e-7);
  }
}

TEST(Shapes, arguments_that_give_no_region_are_refused) {
  EXPECT_THROW(disc(2, 1), std::invalid_argument);
  EXPECT_THROW(gear(12, 4, 3), std::invalid_argument);
  EXPECT_THROW(grate(1, 2, 0.5, 9), std::invalid_argument);
  EXPECT_THROW(noisy_star(50, 1, 1), std::invalid_argument);
  EXPECT_THROW(spiral(3, 24, 1, 2), std::invalid_argument);
  EXPECT_THROW(letter_u(2, 3, 1), std::invalid_argument);
  EXPECT_THROW(rectangle(0, 0, 0, 1), std::invalid_argument);
  EXPECT_THROW(circle_point(5, 5), std::invalid_argument);
}

}  // namespace
}  // namespace dymsum::shapes
