// Coordinates on a grid, the hint at noise, and lines joined where they nearly meet.
#include <cmath>
#include <limits>
#include <random>

#include "dymsum/snapping.h"
#include "io/reading.h"

namespace dymsum::io_test {
namespace {

CoordinateGrid grid(const std::string& text) { return coordinate_grid(text).value(); }
double snapped_to(double x, const std::string& text) {
  return snapped(RegionData{{}, {}, {{x, 0}}}, grid(text))->data.points[0].x;
}

TEST(Snap, grids_are_named_by_powers_of_two_and_ten) {
  EXPECT_EQ(grid("2^-20"), (CoordinateGrid{2, -20}));
  EXPECT_EQ(grid("1e-6"), (CoordinateGrid{10, -6}));
  EXPECT_EQ(grid("0.001"), (CoordinateGrid{10, -3}));
  EXPECT_EQ(grid("1"), (CoordinateGrid{10, 0}));
  for (const char* text : {"2^-20", "1e-6", "1", "2^970", "2^-1074", "1e-100"}) EXPECT_EQ(grid(text).to_string(), text);
  for (const char* text :
       {"", "2^", "2^x", "2^971", "2^-1075", "0.5", "0", "-1", "10", "1e-101", "1e-6x", "nan", "inf"})
    EXPECT_FALSE(coordinate_grid(text)) << text;
  EXPECT_FALSE(snapped(RegionData{}, {3, 0}));
}

TEST(Snap, coordinates_become_the_nearest_multiple) {
  EXPECT_EQ(snapped_to(0.1, "2^-3"), 0.125);
  EXPECT_EQ(snapped_to(2.5, "2^0"), 2) << "halfway: the even one";
  EXPECT_EQ(snapped_to(3.5, "2^0"), 4);
  EXPECT_EQ(snapped_to(0.30000000000000004, "0.1"), 0.3);
  EXPECT_EQ(snapped_to(-0.04, "0.1"), 0);
  EXPECT_FALSE(std::signbit(snapped_to(-0.04, "0.1")));
  EXPECT_EQ(snapped_to(1e22 + 2097152, "2^3"), 1e22 + 2097152) << "a multiple already";
  constexpr double kMost = std::numeric_limits<double>::max(), kLeast = std::numeric_limits<double>::denorm_min();
  for (const char* text : {"2^-1074", "2^970", "1e-100", "1"}) EXPECT_EQ(snapped_to(kMost, text), kMost) << text;
  EXPECT_EQ(snapped_to(kLeast, "2^-1074"), kLeast);
  EXPECT_EQ(snapped_to(kLeast, "1e-100"), 0);
  EXPECT_EQ(snapped(RegionData{{}, {}, {{std::nan(""), 0}}}, {2, 0}).error().code, ErrorCode::not_finite);
}

// Whatever the coordinate: a multiple, no further than half a step, and the same again.
TEST(Snap, random_coordinates) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  std::uniform_int_distribution<int> exponent(-60, 60), step(-40, 40);
  for (int round = 0; round < 2000; ++round) {
    const double x = std::ldexp(mantissa(random), exponent(random));
    const int k = step(random);
    const double y = snapped_to(x, "2^" + std::to_string(k));
    EXPECT_LE(std::abs(y - x), std::ldexp(0.5, k));
    EXPECT_EQ(std::fmod(y, std::ldexp(1.0, k)), 0);
    EXPECT_EQ(snapped_to(y, "2^" + std::to_string(k)), y);
    const double decimal = snapped_to(x, "1e-6");
    EXPECT_EQ(snapped_to(decimal, "1e-6"), decimal);
    EXPECT_LE(std::abs(decimal - x), 0.5000001e-6 + std::abs(x) * 0x1p-52);
  }
}

TEST(Snap, what_moved_is_counted) {
  const MeshData data{{{0, 0.26, 1}, {1, 1, 1.0000001}}, {}};
  const Snapped<MeshData> done = snapped(data, grid("2^-2")).value();
  EXPECT_EQ(done.data.vertices, (std::vector<Point3>{{0, 0.25, 1}, {1, 1, 1}}));
  EXPECT_EQ(done.report.coordinates, 6u);
  EXPECT_EQ(done.report.moved, 2u);
  EXPECT_EQ(done.report.largest_move, 0.26 - 0.25);
  EXPECT_EQ(snapped(done.data, grid("2^-2"))->report.to_string(), "all coordinates were on the grid");
}

RegionData points(const std::vector<double>& values) {
  RegionData data;
  for (const double x : values) data.points.push_back({x, x});
  return data;
}

TEST(Snap, noise_is_found_where_rounding_made_it) {
  const auto noise = [](const std::vector<double>& values) { return coordinate_noise(points(values)); };
  EXPECT_EQ(noise({0.1 + 0.2, 0.5, 1})->grid, (CoordinateGrid{10, -1}));
  EXPECT_EQ(noise({1.0000000000000002, 3, 7.5})->grid, (CoordinateGrid{2, -1}));
  EXPECT_EQ(noise({std::cos(3.14159265358979 / 2), 3, 7})->grid, (CoordinateGrid{2, 0})) << "a zero that is none";
  EXPECT_EQ(noise({1.0000000000000002, 3, 7.5})->noisy, 2u);
  EXPECT_FALSE(noise({0.1, 0.2, 0.3})) << "decimals as they are written";
  EXPECT_FALSE(noise({1, 2, 3}));
  EXPECT_FALSE(noise({}));
  EXPECT_FALSE(noise({0, 0}));
  EXPECT_FALSE(noise({0.123456789123, 0.98765432198, 0.55555555555}));
  EXPECT_FALSE(noise({1e300, 1.5}));
  EXPECT_FALSE(coordinate_noise(points({std::numeric_limits<double>::infinity()})));
}

JoinedChains joined(std::vector<Polyline> lines, double tolerance) {
  return joined_chains({{}, std::move(lines), {}}, tolerance).value();
}

TEST(JoinChains, gaps_are_closed_by_segments_and_no_vertex_moves) {
  const JoinedChains square = joined({{{0, 0}, {4, 0}}, {{4, 0.001}, {4, 4}, {0, 4}}, {{0, 4}, {0, 0.002}}}, 0.01);
  EXPECT_EQ(square.report.joints, 2u);
  EXPECT_EQ(square.report.largest_gap, 0.002);
  EXPECT_EQ(square.report.rings, 1u);
  ASSERT_EQ(square.data.parts.size(), 1u);
  EXPECT_EQ(square.data.parts[0].outer, (Ring{{0, 0}, {4, 0}, {4, 0.001}, {4, 4}, {0, 4}, {0, 0.002}}));
  EXPECT_TRUE(Region::create(square.data).ok());
}

TEST(JoinChains, rings_nest_and_open_chains_stay_lines) {
  const JoinedChains holed = joined(
      {{{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}}, {{2, 2}, {4, 2}, {4, 4}}, {{2, 2.25}, {4, 4}}, {{20, 20}, {21, 21}}},
      0.5);
  ASSERT_EQ(holed.data.parts.size(), 1u);
  EXPECT_EQ(holed.data.parts[0].holes.size(), 1u);
  EXPECT_EQ(holed.data.polylines, (std::vector<Polyline>{{{20, 20}, {21, 21}}}));
}

TEST(JoinChains, what_fits_several_ways_is_refused_with_the_position) {
  const Result<JoinedChains> star =
      joined_chains({{}, {{{0, 0}, {1, 0}}, {{0, 0.1}, {0, 1}}, {{-0.1, 0}, {-1, 0}}}, {}}, 0.2);
  ASSERT_FALSE(star);
  EXPECT_EQ(star.error().code, ErrorCode::malformed);
  EXPECT_TRUE(star.error().evidence.x.has_value());
  EXPECT_FALSE(joined_chains({}, -1));
  EXPECT_FALSE(joined_chains({}, std::nan("")));
  EXPECT_FALSE(joined_chains({{}, {{{std::nan(""), 0}, {1, 1}}}, {}}, 1));
  // A segment that is shorter than the tolerance is no ring by itself.
  EXPECT_EQ(joined({{{0, 0}, {0.1, 0}}}, 1).data.polylines.size(), 1u);
  EXPECT_EQ(joined({{}, {{0, 0}, {1, 0}}}, 0).data.polylines.size(), 1u);
}

}  // namespace
}  // namespace dymsum::io_test
