// Outer rings and holes are distinguished however little or much a boundary turns.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "dymsum/growing_disc.h"
#include "dymsum/region_io.h"
#include "oracles/random.h"
#include "oracles/sanitized.h"
#include "shape/disc/disc_oracle.h"

namespace dymsum {
namespace {

std::vector<DiscSet> all_sets(const Region& region, const DiscRadius& r) {
  const GrowingDisc disc(region);
  std::vector<DiscSet> sets;
  for (const Semantics semantics : {Semantics::closed, Semantics::open, Semantics::regular}) {
    sets.push_back(disc.sum_at(r, semantics).value());
    sets.push_back(disc.eroded_at(r, semantics).value());
    sets.push_back(disc.opened_at(r, semantics).value());
    sets.push_back(disc.closed_at(r, semantics).value());
  }
  return sets;
}

TEST(DiscOrientation, AnEdgeThatTurnsByAnUlpDownwardsIsNoDefect) {
  std::ifstream in(std::string(DYMSUM_CORPUS_DIR) + "/disc/edge_turns_by_an_ulp_downwards.wkt");
  const std::string wkt{std::istreambuf_iterator<char>(in), {}};
  const Region region = *Region::create((*parse_shapes(wkt, RegionFormat::wkt, "test")).front().data);
  for (const char* radius : {"0.01", "0.1", "0.2", "5"})
    for (const DiscSet& set : all_sets(region, Rational::parse(radius).value())) oracles::check_form(set);
}

/// A rectangle in decimals with vertices along its sides, moved across them by a few units in the last place. (Of 0
/// that would be the least double, and discs about such notches larger than doubles reach.)
Region notched_rectangle(oracles::Random& random) {
  const auto integer = [&](int low, int high) { return low + random.below(high - low + 1); };
  const auto decimal = [&](int low, int high) { return integer(low, high) / 10.0; };
  const double x = decimal(1, 30), y = decimal(1, 30), w = decimal(1, 30), h = decimal(1, 30);
  const Ring corners{{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}};
  for (;;) {
    Ring ring;
    for (std::size_t i = 0; i < 4; ++i) {
      const Point a = corners[i], b = corners[(i + 1) % 4];
      ring.push_back(a);
      const int parts = integer(1, 3);
      for (int k = 1; k < parts; ++k) {
        const double fraction = static_cast<double>(k) / parts;
        Point p{a.x + (b.x - a.x) * fraction, a.y + (b.y - a.y) * fraction};
        double& across = a.x == b.x ? p.x : p.y;
        for (int ulps = integer(-2, 2); ulps != 0; ulps += ulps < 0 ? 1 : -1)
          across = std::nextafter(across, ulps < 0 ? -1e9 : 1e9);
        ring.push_back(p);
      }
    }
    if (auto region = Region::create({{{ring, {}}}, {}, {}})) return *region;
  }
}

TEST(DiscOrientation, SidesOfRectanglesThatTurnByUlps) {
  oracles::Random random(37);
  for (int round = 0; round < oracles::rounds(40) && !testing::Test::HasFailure(); ++round) {
    const Region region = notched_rectangle(random);
    for (const char* radius : {"1/1000", "1/7", "3/7"})
      for (const DiscSet& set : all_sets(region, Rational::parse(radius).value())) oracles::check_form(set);
  }
}

TEST(DiscOrientation, PiecesOfRegionsAsSmallAsDoublesLieOnTheDisc) {
  const double u = 0x1p-1074;
  const Region region = Region::create({{{{{0, 0}, {u, -u}, {3 * u, 2 * u}, {u, 4 * u}}, {}}}, {}, {}}).value();
  const DiscSet set = GrowingDisc(region).sum_at(*Rational::of(1, 2)).value();
  ASSERT_EQ(set.parts.size(), 1u);
  for (const DiscPiece& piece : set.parts[0].outer.pieces)
    EXPECT_NEAR(std::hypot(piece.from.at.x, piece.from.at.y), 0.5, 2 * set.at_error);
}

TEST(DiscOrientation, ACircleThatMeetsItselfNowhereOrAtOnePlace) {
  const Region points = Region::create({{}, {}, {{0, 0}, {4, 0}, {2, 3}}}).value();
  for (const char* radius : {"1", "2", "17/8", "9/4", "3"})
    oracles::check_form(GrowingDisc(points).sum_at(Rational::parse(radius).value()).value());
}

}  // namespace
}  // namespace dymsum
