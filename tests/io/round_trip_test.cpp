// A region written in any format reads back as exactly the same region.
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>

#include "dymsum/shapes.h"
#include "io/reading.h"
#include "io/region/read_shapes.h"
#include "io/region/ring_order.h"
#include "oracles/snapped_shapes.h"

namespace dymsum::io_test {
namespace {

void expect_round_trip(const RegionData& data, const std::string& what) {
  for (const RegionFormat format : kFormats) {
    const std::string text = io::format_region_data(data, format);
    ASSERT_EQ(read_one(text, format), data) << what << extension(format) << "\n" << text.substr(0, 1000);
    // the same region, the same text
    ASSERT_EQ(io::format_region_data(read_one(text, format), format), text);
    std::string returns = (format == RegionFormat::poly ? "# hides no other line\n" : "") + text;
    for (char& c : returns) c = c == '\n' ? '\r' : c;
    ASSERT_EQ(read_one(returns, format), data) << what << extension(format) << " with carriage returns";
  }
}

class RandomData {
 public:
  explicit RandomData(std::uint64_t seed) : random_(seed) {}

  RegionData next() {
    RegionData data;
    for (int k = below(4); k > 0; --k) data.parts.push_back(part());
    for (int k = below(3); k > 0; --k) data.polylines.push_back(points(2 + below(4)));
    if (!data.polylines.empty() && below(2) == 0) data.polylines[0].push_back(data.polylines[0][0]);
    for (int k = below(4); k > 0; --k) data.points.push_back(point());
    return data;
  }

 private:
  int below(int end) { return static_cast<int>(random_() % static_cast<std::uint64_t>(end)); }

  /// Small integers, values near one, and any finite double.
  double number() {
    if (below(3) == 0) return below(21) - 10;
    if (below(2) == 0) return static_cast<double>(random_()) / 1e19 - 0.5;
    const auto value = std::bit_cast<double>(random_());
    return std::isfinite(value) ? value : 7;
  }
  Point point() {
    const double x = number();
    return {x, number()};
  }
  std::vector<Point> points(int count) {
    std::vector<Point> points;
    for (int k = 0; k < count; ++k) points.push_back(point());
    return points;
  }
  Part part() {
    Part part{triangle(), {}};
    for (int k = below(3); k > 0; --k) part.holes.push_back(triangle());
    io::orient_rings(part);
    return part;
  }
  /// The readers that orient rings leave these alone; where they lie does not matter to files.
  Ring triangle() {
    for (;;) {
      Ring ring = points(3);
      if (io::ring_sign(ring) != 0) return ring;
    }
  }

  std::mt19937_64 random_;
};

TEST(RoundTrip, random_regions_with_any_coordinates) {
  for (std::uint64_t seed = 1; seed <= 400; ++seed)
    expect_round_trip(RandomData(seed).next(), "seed " + std::to_string(seed));
}

TEST(RoundTrip, nothing_and_the_smallest_things) {
  expect_round_trip({}, "empty");
  expect_round_trip({{}, {}, {{1, 2}}}, "point");
  expect_round_trip({{}, {{{0, 0}, {1, 0}}}, {}}, "segment");
  expect_round_trip({{}, {{{0, 0}, {1, 0}, {0, 1}, {0, 0}}}, {}}, "closed polyline");
  expect_round_trip({{{{{0, 0}, {1, 0}, {0, 1}}, {}}}, {}, {}}, "triangle");
}

TEST(RoundTrip, generated_regions_with_holes) {
  expect_round_trip(shapes::grate(6, 2, 0.7, 9).data(), "grate");
  expect_round_trip(snapped_shapes::pockets(7, 1).data(), "pockets");
  expect_round_trip(snapped_shapes::disc(97, 1.0 / 3).data(), "disc");
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    expect_round_trip(shapes::random_polygon(120, 4, seed).data(), "random polygon");
}

TEST(RoundTrip, through_the_public_functions) {
  const Region region = shapes::grate(3, 2, 0.5, 5);
  for (const RegionFormat format : kFormats) {
    const auto shapes = parse_shapes(format_region(region, format), format, "grate");
    ASSERT_TRUE(shapes.ok()) << shapes.error().to_string();
    EXPECT_EQ(shapes->at(0).data, region.data());
  }
  EXPECT_EQ(read_one(draw_region(region), RegionFormat::svg), region.data());
}

}  // namespace
}  // namespace dymsum::io_test
