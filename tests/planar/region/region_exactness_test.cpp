// Decisions a hair apart, and coordinates at the ends of the double range.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "dymsum/region.h"
#include "planar/region/region_cases.h"

namespace dymsum::test {
namespace {

std::string exact_verdict(RegionData data) {
  const Result<Region> result = Region::create(std::move(data));
  return result.ok() ? "valid" : std::string(name(result.error().code));
}

double up(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }
double down(double x) { return std::nextafter(x, -std::numeric_limits<double>::infinity()); }

TEST(RegionExactness, AHoleCornerAnUlpFromTheOuterRing) {
  // (0.5, 0.5) lies exactly on the slanted edge x = y of the outer ring.
  const auto hole_to = [](double x, double y) {
    return with_holes({{12, 12}, {0, 0}, {24, 0}}, {{{x, y}, {4, 2}, {3, 1}}});
  };
  EXPECT_EQ(exact_verdict(hole_to(0.5, 0.5)), "valid");
  EXPECT_EQ(exact_verdict(hole_to(0.5, down(0.5))), "valid");
  EXPECT_EQ(exact_verdict(hole_to(up(0.5), 0.5)), "valid");
  EXPECT_EQ(exact_verdict(hole_to(0.5, up(0.5))), "rings_cross");
  EXPECT_EQ(exact_verdict(hole_to(down(0.5), 0.5)), "rings_cross");
}

TEST(RegionExactness, NearlyCollinearVerticesAreNotCollinear) {
  EXPECT_EQ(exact_verdict(one_ring({{0.5, 0.5}, {12, 12}, {24, 24}})), "no_area");
  EXPECT_EQ(exact_verdict(one_ring({{0.5, up(0.5)}, {12, 12}, {24, 24}})), "valid");
  EXPECT_EQ(exact_verdict(one_ring({{0.5, down(0.5)}, {12, 12}, {24, 24}})), "wrong_orientation");
  EXPECT_EQ(exact_verdict(one_ring({{0.5, down(0.5)}, {24, 24}, {12, 12}})), "valid");
}

TEST(RegionExactness, PartsAnUlpApart) {
  const double x = 0.1 + 0.2;  // not 0.3
  EXPECT_EQ(exact_verdict(two_parts(box(0, 0, 0.3, 1), box(x, 0, 1, 1))), "valid");
  EXPECT_EQ(exact_verdict(two_parts(box(0, 0, x, 1), box(x, 0, 1, 1))), "rings_cross");
  EXPECT_EQ(exact_verdict(two_parts(box(0, 0, x, 1), box(0.3, 0, 1, 1))), "rings_cross");
  EXPECT_EQ(exact_verdict(two_parts(box(0, 0, 0.3, 1), {{0.3, 0.5}, {1, 0}, {1, 1}})), "valid");
}

TEST(RegionExactness, TheWholeDoubleRange) {
  const double big = std::numeric_limits<double>::max();
  const double tiny = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(exact_verdict(one_ring(box(-big, -big, big, big))), "valid");
  EXPECT_EQ(exact_verdict(with_holes(box(-big, -big, big, big), {reversed(box(-tiny, -tiny, tiny, tiny))})), "valid");
  EXPECT_EQ(exact_verdict(one_ring(reversed(box(-tiny, 0, 0, tiny)))), "wrong_orientation");
  EXPECT_EQ(exact_verdict(one_ring({{-big, -big}, {big, big}, {big, -big}, {-big, big}})), "self_crossing");
  EXPECT_EQ(exact_verdict(one_ring({{-big, -big}, {big, big}, {0, tiny}})), "valid");
  EXPECT_EQ(exact_verdict(one_ring({{-big, -big}, {big, big}, {0, 0}})), "no_area");
}

TEST(RegionExactness, ThePlaceOfACrossingIsFiniteAndNear) {
  const double big = std::numeric_limits<double>::max();
  const Result<Region> result = Region::create(one_ring({{-big, -big}, {big, big}, {big, -big}, {-big, big}}));
  ASSERT_FALSE(result.ok());
  EXPECT_LT(std::abs(*result.error().evidence.x), 1e-10 * big);
  EXPECT_LT(std::abs(*result.error().evidence.y), 1e-10 * big);
}

}  // namespace
}  // namespace dymsum::test
