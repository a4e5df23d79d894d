// Regions on tiny integer grids, where most discs are degenerate: all sets of all events and between them.
#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

#include "dymsum/region_io.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/random.h"
#include "oracles/sanitized.h"
#include "oracles/tiny_regions.h"
#include "shape/disc/disc_oracle.h"

namespace dymsum {
namespace {

enum class Kind { sum, erosion, opening, closing };

Result<DiscSet> make(const GrowingDisc& disc, Kind kind, const DiscRadius& r, Semantics semantics) {
  switch (kind) {
    case Kind::sum:
      return disc.sum_at(r, semantics);
    case Kind::erosion:
      return disc.eroded_at(r, semantics);
    case Kind::opening:
      return disc.opened_at(r, semantics);
    default:
      return disc.closed_at(r, semantics);
  }
}

/// Whether z is in the set by definition; nothing where it is too close to call.
std::optional<bool> member(const Region& region, Kind kind, double r, Point z) {
  const double margin = 1e-7 * (1 + r);
  if (kind == Kind::sum || kind == Kind::erosion) {
    const double d = kind == Kind::sum ? oracles::distance(region, z) : oracles::depth(region, z);
    if (std::abs(d - r) < margin) return std::nullopt;
    return kind == Kind::sum ? d < r : d > r;
  }
  const auto reached = kind == Kind::opening
                           ? oracles::reached([&](Point c) { return oracles::depth(region, c); }, z, r, 12)
                           : oracles::reached([&](Point c) { return oracles::distance(region, c); }, z, r, 12);
  if (!reached) return std::nullopt;
  return (kind == Kind::opening) == *reached;
}

void expect_set(const Region& region, const GrowingDisc& disc, Kind kind, const DiscRadius& r, Semantics semantics,
                oracles::Random& random, int points) {
  SCOPED_TRACE("kind " + std::to_string(int(kind)) + " semantics " + std::to_string(int(semantics)) + " radius " +
               (r.event ? "event:" + std::to_string(*r.event) : r.value.to_string()));
  std::optional<Result<DiscSet>> made;
  ASSERT_NO_THROW(made = make(disc, kind, r, semantics));
  const Result<DiscSet>& set = *made;
  ASSERT_TRUE(set.ok()) << set.error().to_string();
  oracles::check_form(*set);
  const auto box = bounds(region);
  for (int i = 0; i < points; ++i) {
    const double margin = kind == Kind::sum ? set->radius : 0.5;
    const Point z{(box[0] + box[2]) / 2 + random.signed_unit() * ((box[2] - box[0]) / 2 + margin),
                  (box[1] + box[3]) / 2 + random.signed_unit() * ((box[3] - box[1]) / 2 + margin)};
    if (const auto in = member(region, kind, set->radius, z)) {
      EXPECT_EQ(oracles::winding(*set, z), *in ? 1 : 0) << z.x << " " << z.y;
    }
  }
}

std::vector<DiscRadius> radii_of(const std::vector<DiscEvent>& events, oracles::Random& random) {
  std::vector<DiscRadius> radii;
  if (events.empty()) return {*Rational::of(3, 4)};
  const auto i = std::uint32_t(random.below(int(events.size())));
  radii.push_back(DiscRadius::at_event(i));
  const double next = i + 1 < events.size() ? events[i + 1].radius : 2 * events[i].radius;
  radii.push_back(*Rational::of((events[i].radius + next) / 2));
  radii.push_back(*Rational::of(1 + random.below(16), 8));
  return radii;
}

/// Parts, and beside them a polyline and points that touch nothing.
RegionData mixed(oracles::Random& random, int grid) {
  RegionData data = oracles::random_parts(random, grid);
  const Region parts = *Region::create(data);
  const double x = bounds(parts)[2] + 1, y = random.below(grid);
  data.polylines.push_back({{x, y}, {x + 1 + random.below(2), y}, {x + 1 + random.below(3), y + 1 + random.below(2)}});
  for (int i = 0; i < 4; ++i) {
    const Point p{double(random.below(grid + 2)) - 1, double(random.below(grid + 2)) - 1};
    const bool is_new = std::find(data.points.begin(), data.points.end(), p) == data.points.end();
    if (is_new && oracles::squared_distance(*Region::create(data), p).sign() > 0) data.points.push_back(p);
  }
  return data;
}

int rounds_of_fuzz() {
  const char* text = std::getenv("DYMSUM_FUZZ_PAIRS");
  return oracles::rounds(text != nullptr ? std::atoi(text) : 120);
}

TEST(DiscFuzz, SetsOfTinyRegionsAreThoseOfTheDefinition) {
  const int rounds = rounds_of_fuzz();
  const char* first = std::getenv("DYMSUM_FIRST_SEED");
  int skipped = 0;
  for (int round = first != nullptr ? std::atoi(first) : 0; round < rounds; ++round) {
    oracles::Random random(4000 + std::uint64_t(round));
    const bool parts = round % 3 != 0;
    const int grid = 4 + round % 4;
    const auto region = Region::create(parts ? oracles::random_parts(random, grid) : mixed(random, grid));
    ASSERT_TRUE(region.ok());
    SCOPED_TRACE("round " + std::to_string(round) + " " + format_region(*region, RegionFormat::wkt));
    const GrowingDisc disc(*region);
    Result<std::vector<DiscEvent>> outside = Error{};
    ASSERT_NO_THROW(outside = disc.events(DiscSide::outside));
    if (!outside.ok()) {
      EXPECT_EQ(outside.error().code, ErrorCode::unsupported_operand) << outside.error().to_string();
      ++skipped;
      continue;
    }
    for (const DiscRadius& r : radii_of(*outside, random)) {
      expect_set(*region, disc, Kind::sum, r, Semantics::closed, random, 25);
      expect_set(*region, disc, Kind::closing, r, round % 2 == 0 ? Semantics::closed : Semantics::open, random, 5);
    }
    if (region->parts().empty()) continue;
    Result<std::vector<DiscEvent>> inside = Error{};
    ASSERT_NO_THROW(inside = disc.events(DiscSide::inside));
    for (const DiscRadius& r : radii_of(*inside, random)) {
      expect_set(*region, disc, Kind::erosion, r, Semantics::closed, random, 25);
      expect_set(*region, disc, Kind::opening, r, round % 2 == 0 ? Semantics::closed : Semantics::regular, random, 5);
    }
    if (::testing::Test::HasFailure()) return;
  }
  EXPECT_LT(skipped, rounds / 4);
}

TEST(DiscFuzz, SetsOfCoordinatesOfEveryKindAreThoseOfTheDefinition) {
  std::mt19937_64 noise(7317);
  for (const CoordinateKind kind : kCoordinateKinds) {
    int valid = 0;
    for (int round = 0; round < oracles::rounds(8); ++round) {
      oracles::Random random(7317 + std::uint64_t(round));
      const auto region = Region::create(of_kind(oracles::random_parts(random, 4 + round % 4), kind, noise));
      if (!region.ok()) continue;
      ++valid;
      SCOPED_TRACE(name_of(kind) + ", round " + std::to_string(round) + " " +
                   format_region(*region, RegionFormat::wkt));
      const GrowingDisc disc(*region);
      const auto outside = disc.events(DiscSide::outside), inside = disc.events(DiscSide::inside);
      ASSERT_TRUE(outside.ok() && inside.ok());
      // The oracle computes in doubles. Nearly straight corners have events at radii of 1e16.
      const auto small = [](std::vector<DiscEvent> events) {
        std::erase_if(events, [](const DiscEvent& e) { return e.radius > 100; });
        return events;
      };
      for (const DiscRadius& r : radii_of(small(*outside), random)) {
        expect_set(*region, disc, Kind::sum, r, Semantics::closed, random, 12);
        expect_set(*region, disc, Kind::closing, r, Semantics::closed, random, 3);
      }
      for (const DiscRadius& r : radii_of(small(*inside), random)) {
        expect_set(*region, disc, Kind::erosion, r, Semantics::closed, random, 12);
        expect_set(*region, disc, Kind::opening, r, Semantics::closed, random, 3);
      }
      if (::testing::Test::HasFailure()) return;
    }
    EXPECT_GT(valid, 0) << name_of(kind);
  }
}

}  // namespace
}  // namespace dymsum
