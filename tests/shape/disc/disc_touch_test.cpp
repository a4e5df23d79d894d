// Openings and closings at radii at which corner discs touch each other exactly.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dymsum/growing_disc.h"
#include "shape/disc/disc_oracle.h"

namespace dymsum {
namespace {

/// Teeth from above and below with tips at (0, 1) and (0, -1), every 64 along x, and slopes p / q of a right triangle
/// with sides p, q and s. The discs of radius q / (s - p) left and right of a pair of tips touch both of its teeth and,
/// at the midpoint between the tips, each other: those of radius r have their centres (s r - q) / p from there.
struct Teeth {
  int pairs = 1;
  double p = 3, q = 4, s = 5;
  bool left_wall = false, right_wall = false;

  Rational radius() const { return Rational(int(q)) / Rational(int(s - p)); }
  double right() const { return 64.0 * pairs - 32; }

  /// From the left end to the right one, tips at y = 1.
  Ring outline() const {
    Ring ring;
    const double x = q * std::floor(28 / q), y = 1 + x / q * p;  // exactly
    for (int i = 0; i < pairs; ++i) {
      if (i > 0) ring.push_back({64.0 * i - 32, 40});
      ring.insert(ring.end(), {{64 * i - x, y}, {64.0 * i, 1}, {64 * i + x, y}});
    }
    return ring;
  }
};

/// The teeth with what they hang on, as outer rings: one if there is a wall, else two; the second one is a hole if both
/// are there.
RegionData toothed(const Teeth& t) {
  Ring above = t.outline(), below;
  for (auto i = above.rbegin(); i != above.rend(); ++i) below.push_back({i->x, -i->y});
  const double left = -32, right = t.right(), top = 80, far = 64;
  const Ring roof{{right, top}, {left, top}}, floor{{left, -top}, {right, -top}};
  const auto joined = [](std::initializer_list<Ring> rings) {
    Ring made;
    for (const Ring& ring : rings) made.insert(made.end(), ring.begin(), ring.end());
    return made;
  };
  if (!t.left_wall && !t.right_wall) return {{{joined({above, roof}), {}}, {joined({below, floor}), {}}}, {}, {}};
  if (t.left_wall && t.right_wall) {
    Ring hole = joined({above, {{right, 60}, {right, -60}}, below, {{left, -60}, {left, 60}}});
    std::vector<Point> box{{left - far, -top}, {right + far, -top}, {right + far, top}, {left - far, top}};
    return {{{box, {Ring(hole)}}}, {}, {}};
  }
  return {{{joined({above,
                    {{right, top}, {left - far, top}, {left - far, -top}, {right, -top}},
                    below,
                    {{left, -60}, {left, 60}}}),
            {}}},
          {},
          {}};
}

Region region_of(const RegionData& data) { return repair(data).value().region; }

/// The same with what is inside and outside exchanged, within a large box.
Region complement(const Region& region) {
  std::vector<Part> parts{{{{-1000, -1000}, {1000, -1000}, {1000, 1000}, {-1000, 1000}}, {}}};
  const auto turned = [](const Ring& ring) { return Ring(ring.rbegin(), ring.rend()); };
  for (const Part& part : region.parts()) {
    parts[0].holes.push_back(turned(part.outer));
    for (const Ring& hole : part.holes) parts.push_back({turned(hole), {}});
  }
  return Region::create({parts, {}, {}}).value();
}

/// No ring passes a place twice.
void expect_simple(const DiscSet& set) {
  const auto look = [](const DiscRing& ring) {
    for (std::size_t i = 0; i < ring.pieces.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_GT(std::hypot(ring.pieces[i].from.at.x - ring.pieces[j].from.at.x,
                             ring.pieces[i].from.at.y - ring.pieces[j].from.at.y),
                  1e-9);
  };
  for (const DiscPart& part : set.parts) {
    look(part.outer);
    for (const DiscRing& hole : part.holes) look(hole);
  }
}

std::vector<Teeth> all_teeth() {
  std::vector<Teeth> all;
  for (const auto& [p, q, s] : std::vector<std::array<double, 3>>{{3, 4, 5}, {5, 12, 13}, {4, 3, 5}, {8, 15, 17}})
    for (int pairs = 1; pairs <= 4; ++pairs)
      for (const int walls : {0, 1, 3}) all.push_back({pairs, p, q, s, walls >= 1, walls >= 3});
  return all;
}

struct Counts {
  std::size_t parts, holes;
  friend bool operator==(const Counts&, const Counts&) = default;
};
Counts counts(const DiscSet& set) { return {set.parts.size(), set.hole_count()}; }

TEST(DiscTouch, ClosingsComeApartAtATouchAndHaveSimpleRings) {
  for (const Teeth& t : all_teeth()) {
    const GrowingDisc disc(region_of(toothed(t)));
    const std::size_t k = std::size_t(t.pairs);
    SCOPED_TRACE(std::to_string(t.pairs) + " pairs, slope " + std::to_string(t.p / t.q) + ", walls " +
                 std::to_string(t.left_wall + t.right_wall));
    const bool closed = t.left_wall && t.right_wall, open = !t.left_wall;
    const Counts pinched = open ? Counts{2, 0} : Counts{1, closed ? k + 1 : k};
    for (const Semantics semantics : {Semantics::closed, Semantics::open, Semantics::regular}) {
      const DiscSet set = disc.closed_at(t.radius(), semantics).value();
      oracles::check_form(set);
      expect_simple(set);
      EXPECT_EQ(counts(set), pinched) << counts(set).parts << " parts, " << counts(set).holes << " holes";
    }
    // Wider discs do not meet, and leave passages of the set between them.
    const DiscSet wider = disc.closed_at(t.radius() * Rational::parse("1.001").value()).value();
    const Counts kept{1, closed ? k + 1 : open ? k - 1 : k};
    EXPECT_EQ(counts(wider), kept);
    // Narrower ones overlap: cavities are connected.
    const DiscSet narrower = disc.closed_at(t.radius() * Rational::parse("0.999").value()).value();
    const Counts apart = open ? Counts{2, 0} : Counts{1, closed ? 1u : 0u};
    EXPECT_EQ(counts(narrower), apart);
  }
}

TEST(DiscTouch, OpeningsAreTheComplements) {
  for (const Teeth& t : all_teeth()) {
    const Region region = region_of(toothed(t));
    const GrowingDisc disc(region), other(complement(region));
    SCOPED_TRACE(std::to_string(t.pairs) + " pairs, slope " + std::to_string(t.p / t.q) + ", walls " +
                 std::to_string(t.left_wall + t.right_wall));
    const DiscSet closing = disc.closed_at(t.radius()).value(), opening = other.opened_at(t.radius()).value();
    oracles::check_form(opening);
    expect_simple(opening);
    const double r = t.radius().to_double();
    const Measured in = area(opening), out = area(closing);
    EXPECT_NEAR(in.value + out.value, 4e6 - (4 - std::numbers::pi) * r * r, in.error + out.error + 1e-6);
    // Discs that touch do not connect what they belong to.
    const bool closed = t.left_wall && t.right_wall;
    const std::size_t k = std::size_t(t.pairs), cavities = closed ? k + 1 : t.left_wall ? k : k - 1;
    EXPECT_EQ(opening.parts.size(), 1 + cavities);
  }
}

TEST(DiscTouch, PointsBesideATouchAreAsDefined) {
  for (const Teeth& t : all_teeth()) {
    const Region region = region_of(toothed(t));
    const double r = t.radius().to_double();
    const DiscSet set = GrowingDisc(region).closed_at(t.radius()).value();
    for (int i = 0; i < t.pairs; ++i)
      for (const double dx : {-0.5, -0.125, 0.0, 0.125, 0.5})
        for (const double dy : {-0.25, -0.0625, 0.0625, 0.25}) {
          // Both discs, about (64 i - r, 0) and (64 i + r, 0), keep clear; near the touch no others reach.
          const double near = std::hypot(std::abs(dx) - r, dy);
          if (std::abs(near - r) < 1e-9) continue;
          EXPECT_EQ(oracles::winding(set, {64 * i + dx, dy}), near > r ? 1 : 0) << i << " " << dx << " " << dy;
        }
  }
}

TEST(DiscTouch, ATouchThatAnotherDiscCoversIsNone) {
  // Four teeth with tips at distance 4 point to the origin. Discs of radius 3 in the gaps touch each other at (3, 0),
  // ..., and those about places near the origin cover that.
  std::vector<Part> teeth;
  Ring tooth{{4, 0}, {24, -15}, {34, -15}, {34, 15}, {24, 15}};
  for (int i = 0; i < 4; ++i) {
    teeth.push_back({tooth, {}});
    for (Point& p : tooth) p = {-p.y, p.x};
  }
  const GrowingDisc disc(Region::create({teeth, {}, {}}).value());
  double before = 0;
  for (const char* r : {"2.999999", "3", "3.000001"}) {
    const DiscSet set = disc.closed_at(Rational::parse(r).value()).value();
    oracles::check_form(set);
    expect_simple(set);
    const Counts four{4, 0};
    EXPECT_EQ(counts(set), four) << r;
    EXPECT_EQ(set.piece_count(), 36u) << r;
    EXPECT_GT(area(set).value, before);
    before = area(set).value;
  }
}

}  // namespace
}  // namespace dymsum
