#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include <gtest/gtest.h>

#include "dymsum/region_io.h"
#include "dymsum/shapes.h"
#include "oracles/random.h"
#include "oracles/sanitized.h"
#include "oracles/snapped_shapes.h"
#include "oracles/tiny_regions.h"
#include "shape/disc/disc_oracle.h"

namespace dymsum {
namespace {

constexpr double kTurn = std::numbers::pi;

Rational rational(const char* text) { return *Rational::parse(text); }
Region region_of(const char* wkt) {
  return *Region::create((*parse_shapes(wkt, RegionFormat::wkt, "test")).front().data);
}

void expect_area(const DiscSet& set, double expected) {
  const Measured measured = area(set);
  EXPECT_NEAR(measured.value, expected, measured.error + 1e-13 * expected);
  EXPECT_LT(measured.error, 1e-9 * (1 + expected));
}

double length_of(const Region& region) { return perimeter(*GrowingDisc(region).sum_at(Rational(0))).value; }

TEST(DiscLaws, SteinersFormulaHoldsForConvexRegions) {
  for (const Region& region :
       {shapes::rectangle(0, 0, 3, 2), snapped_shapes::disc(7, 2), region_of("POLYGON((0 0,9 1,2 1,0 0))")})
    for (const char* r : {"1/1000", "1/3", "5", "1000"}) {
      const double radius = rational(r).to_double();
      const DiscSet set = *GrowingDisc(region).sum_at(rational(r));
      expect_area(set, area(region) + length_of(region) * radius + kTurn * radius * radius);
      const Measured around = perimeter(set);
      EXPECT_NEAR(around.value, length_of(region) + 2 * kTurn * radius, around.error + 1e-12 * radius);
    }
}

TEST(DiscLaws, BeforeTheFirstEventReflexVerticesTakeTheirShare) {
  const Region region = shapes::letter_l(5, 4, 1);
  const DiscSet set = *GrowingDisc(region).sum_at(rational("1/2"));
  expect_area(set, area(region) + length_of(region) / 2 + 0.25 * (5 * kTurn / 4 - 1));
}

TEST(DiscLaws, RadiusZeroIsTheRegion) {
  const Region region = region_of(
      "GEOMETRYCOLLECTION(POLYGON((0 0,4 0,4 4,0 4,0 0),(1 1,1 2,2 2,1 1)),LINESTRING(6 0,7 1,8 0),POINT(9 9))");
  const DiscSet set = *GrowingDisc(region).sum_at(Rational(0));
  EXPECT_EQ(to_region(set, 1)->region, Region::create(to_region(set, 1)->region.data()).value());
  EXPECT_EQ(set.parts.size(), 1u);
  EXPECT_EQ(set.hole_count(), 1u);
  EXPECT_EQ(set.segments.size(), 2u);
  EXPECT_EQ(set.points.size(), 1u);
  EXPECT_EQ(area(set).value, area(region));
}

TEST(DiscLaws, PointsAndLinesGrowToCirclesAndStadiums) {
  const DiscSet circle = *GrowingDisc(region_of("POINT(3 4)")).sum_at(Rational(2));
  ASSERT_EQ(circle.piece_count(), 1u);
  EXPECT_EQ(circle.parts[0].outer.pieces[0].from.kind, DiscCorner::Kind::none);
  expect_area(circle, 4 * kTurn);
  EXPECT_EQ(bounds(circle), (std::array<double, 4>{1, 2, 5, 6}));
  const DiscSet stadium = *GrowingDisc(region_of("LINESTRING(0 0,3 0)")).sum_at(Rational(1));
  EXPECT_EQ(stadium.piece_count(), 4u);
  expect_area(stadium, 6 + kTurn);
}

TEST(DiscLaws, DiscsThatTouchExactlyStayTwoParts) {
  const GrowingDisc disc(region_of("MULTIPOINT((0 0),(6 0))"));
  const DiscSet apart = *disc.sum_at(rational("2.999999999999999999999999"));
  EXPECT_EQ(apart.parts.size(), 2u);
  for (const DiscRadius& r : {DiscRadius(Rational(3)), DiscRadius::at_event(0)}) {
    const DiscSet touching = *disc.sum_at(r);
    EXPECT_EQ(touching.parts.size(), 2u);
    expect_area(touching, 18 * kTurn);
  }
  const DiscSet joined = *disc.sum_at(rational("3.000000000000000000000001"));
  EXPECT_EQ(joined.parts.size(), 1u);
  EXPECT_EQ(joined.piece_count(), 2u);
}

TEST(DiscLaws, AChannelAsWideAsTheDiscIsTight) {
  const GrowingDisc disc(region_of("POLYGON((0 0,10 0,10 6,6 6,6 2,4 2,4 6,0 6,0 0),(1 1,1 3,3 3,3 1,1 1))"));
  const DiscSet open = *disc.sum_at(Rational(1), Semantics::open);
  ASSERT_EQ(open.tight_segments.size(), 1u);
  EXPECT_EQ(std::min(open.tight_segments[0].from.at.y, open.tight_segments[0].to.at.y), 3);
  EXPECT_EQ(std::max(open.tight_segments[0].from.at.y, open.tight_segments[0].to.at.y), 6);
  ASSERT_EQ(open.tight_points.size(), 1u);
  EXPECT_EQ(open.tight_points[0].at, (Point{2, 2}));
  for (const Semantics semantics : {Semantics::closed, Semantics::regular})
    EXPECT_TRUE(disc.sum_at(Rational(1), semantics)->tight_points.empty());
  EXPECT_EQ(disc.sum_at(Rational(1))->hole_count(), 0u);
  EXPECT_EQ(disc.sum_at(rational("0.99999999999999999999"))->hole_count(), 1u);
  EXPECT_TRUE(disc.sum_at(rational("0.99999999999999999999"), Semantics::open)->tight_points.empty());
}

TEST(DiscLaws, AnErosionKeepsWhatFitsExactly) {
  const GrowingDisc disc(shapes::rectangle(0, 0, 7, 2));
  const DiscSet closed = *disc.eroded_at(Rational(1)), regular = *disc.eroded_at(Rational(1), Semantics::regular),
                open = *disc.eroded_at(Rational(1), Semantics::open);
  EXPECT_TRUE(closed.parts.empty());
  ASSERT_EQ(closed.segments.size(), 1u);
  EXPECT_EQ(closed.tight_segments.size(), 1u);
  EXPECT_TRUE(regular.segments.empty() && regular.tight_segments.empty());
  EXPECT_TRUE(open.segments.empty());
  EXPECT_EQ(open.tight_segments.size(), 1u);
  const DiscSet stadium = *disc.opened_at(Rational(1));
  expect_area(stadium, 10 + kTurn);
  EXPECT_TRUE(disc.opened_at(Rational(1), Semantics::regular)->parts.empty());
  EXPECT_TRUE(disc.opened_at(rational("1.0000000000000000000001"))->parts.empty());
}

TEST(DiscLaws, ASquareOpenedByItsIncircleIsThatCircle) {
  const DiscSet set = *GrowingDisc(shapes::rectangle(0, 0, 2, 2)).opened_at(DiscRadius::at_event(0));
  expect_area(set, kTurn);
  EXPECT_EQ(set.piece_count(), 4u);
}

TEST(DiscLaws, PolygonalDiscsBoundTheSumFromBothSides) {
  for (const Region& region :
       {snapped_shapes::star(5, 2, 5), shapes::grate(3, 2, 1, 4), shapes::random_polygon(24, 1, 3)})
    for (const double r : {0.1, 0.4, 1.3}) {
      const GrowingDisc disc(region);
      constexpr int kSides = 64;
      const Region inner = snapped_shapes::disc(kSides, r * (1 - 1e-12)),
                   outer = snapped_shapes::disc(kSides, r / std::cos(kTurn / kSides) * (1 + 1e-12));
      const DiscSet sum = *disc.sum_at(*Rational::of(r)), eroded = *disc.eroded_at(*Rational::of(r));
      const double a = area(sum).value, e = area(eroded).value;
      EXPECT_LT(minkowski_sum(region, inner)->area(), a);
      EXPECT_GT(minkowski_sum(region, outer)->area(), a);
      EXPECT_LE(erode(region, outer)->area(), e);
      EXPECT_GE(erode(region, inner)->area(), e);
    }
}

TEST(DiscLaws, PolygonsOfASetKeepTheirSideAndTheirError) {
  const Region region = snapped_shapes::star(7, 2, 5);
  const GrowingDisc disc(region);
  for (const auto& made : {disc.sum_at(rational("1/2")), disc.eroded_at(rational("1/2")),
                           disc.opened_at(rational("0.7")), disc.closed_at(rational("0.7"))}) {
    const DiscSet& set = *made;
    double before = std::numeric_limits<double>::infinity();
    for (const double error : {0.1, 0.01, 0.0001}) {
      const auto inside = to_region(set, error, DiscBound::inside), outside = to_region(set, error, DiscBound::outside);
      ASSERT_TRUE(inside.ok() && outside.ok()) << inside.error().to_string();
      const double a = area(set).value, length = perimeter(set).value;
      EXPECT_LE(area(inside->region), a * (1 + 1e-12));
      EXPECT_GE(area(outside->region), a * (1 - 1e-12));
      const double gap = area(outside->region) - area(inside->region);
      EXPECT_LE(gap, 2 * error * length);
      EXPECT_LT(gap, before);
      before = gap;
      EXPECT_LE(inside->rounded, inside->error);
    }
  }
}

TEST(DiscLaws, SetsAreMonotoneAndOpeningsLieInsideClosings) {
  const Region region = shapes::random_polygon(30, 2, 11);
  const GrowingDisc disc(region);
  double sum = area(region), eroded = area(region), opened = area(region), closed = area(region);
  for (int i = 1; i <= 20; ++i) {
    const Rational r = *Rational::of(i, 20);
    const double s = area(*disc.sum_at(r)).value, e = area(*disc.eroded_at(r)).value,
                 o = area(*disc.opened_at(r)).value, c = area(*disc.closed_at(r)).value;
    EXPECT_GT(s, sum);
    EXPECT_LE(e, eroded);
    EXPECT_LE(o, opened + 1e-9);
    EXPECT_GE(c, closed - 1e-9);
    EXPECT_LE(e, o);
    EXPECT_LE(c, s);
    sum = s, eroded = e, opened = o, closed = c;
  }
}

TEST(DiscLaws, AreasAreContinuousAtEvents) {
  const Region region = shapes::random_polygon(20, 1, 5);
  const GrowingDisc disc(region);
  const auto events = *disc.events(DiscSide::outside);
  ASSERT_GT(events.size(), 10u);
  for (std::uint32_t i = 0; i < events.size(); i += 3) {
    const double at = area(*disc.sum_at(DiscRadius::at_event(i))).value;
    for (const double beside : {-1e-9, 1e-9}) {
      const double r = events[i].radius + beside;
      EXPECT_NEAR(area(*disc.sum_at(*Rational::of(r))).value, at, 1e-6 * (1 + at));
    }
  }
}

/// The part whose outer ring has a piece of an edge, and its holes' edges.
std::vector<std::uint32_t> hole_edges_of_part_with(const DiscSet& set, std::uint32_t edge) {
  std::vector<std::uint32_t> edges;
  const auto has = [](const DiscRing& ring, std::uint32_t index) {
    return std::any_of(ring.pieces.begin(), ring.pieces.end(),
                       [&](const DiscPiece& piece) { return piece.of == DiscPiece::Of::edge && piece.index == index; });
  };
  for (const DiscPart& part : set.parts)
    if (has(part.outer, edge))
      for (const DiscRing& hole : part.holes)
        for (const DiscPiece& piece : hole.pieces)
          if (piece.of == DiscPiece::Of::edge) edges.push_back(piece.index);
  std::sort(edges.begin(), edges.end());
  return edges;
}

TEST(DiscLaws, HolesOfAClosingLieInTheirPartsFarFromTheOrigin) {
  // Positions of discs are some units off there.
  const double far = 0x1p46;
  const Region near = region_of(
      "MULTIPOLYGON(((0 0,12 0,12 12,0 12,0 0),(2 2,2 10,10 10,10 2,2 2)),"
      "((4 4,8 4,8 8,4 8,4 4)),((13 -9,30 -9,30 8,13 8,13 -9),(16 -6,16 5,27 5,27 -6,16 -6)))");
  const Region region = *translated(near, far, -far);
  for (const char* r : {"1/4", "1/3", "0.45"}) {
    const DiscSet set = *GrowingDisc(region).closed_at(rational(r));
    ASSERT_EQ(set.parts.size(), 3u);
    EXPECT_EQ(hole_edges_of_part_with(set, 0), (std::vector<std::uint32_t>{4, 5, 6, 7}));
    EXPECT_EQ(hole_edges_of_part_with(set, 8), std::vector<std::uint32_t>());
    EXPECT_EQ(hole_edges_of_part_with(set, 12), (std::vector<std::uint32_t>{16, 17, 18, 19}));
  }
}

TEST(DiscLaws, AHoleLiesInThePartThatOnlyASlitLeadsTo) {
  // The frame in the cavity touches no disc outside, and discs overlap in front of the slit.
  const Region region = region_of(
      "MULTIPOLYGON(((0.125 1,10 14,10 30,-10 30,-10 14,-0.125 1,-0.125 14,-6 14,-6 26,6 26,6 14,0.125 14,0.125 1)),"
      "((-5.5 14.5,5.5 14.5,5.5 25.5,-5.5 25.5,-5.5 14.5),(-5 15,-5 25,5 25,5 15,-5 15)),"
      "((0.125 -1,-0.125 -1,-10 -14,10 -14,0.125 -1)))");
  const GrowingDisc disc(region);
  for (const Semantics semantics : {Semantics::closed, Semantics::open, Semantics::regular}) {
    const DiscSet set = *disc.closed_at(rational("3/2"), semantics);
    ASSERT_EQ(set.parts.size(), 2u);
    ASSERT_EQ(set.hole_count(), 1u);
    for (const DiscPart& part : set.parts)
      EXPECT_EQ(part.holes.size(), bounds({{part}, {}, {}, {}, {}, set.radius, "", 0})[3] > 20 ? 1u : 0u);
  }
}

TEST(DiscLaws, ProgressStopsACallAndLeavesNothingBehind) {
  const GrowingDisc disc(shapes::letter_u(4, 4, 1));
  std::vector<std::string> stages;
  const auto stop_at = [&](const std::string& stage, double fraction) {
    return [&, stage, fraction](std::string_view s, double f) {
      stages.push_back(std::string(s) + (f == 0 ? " 0" : " 1"));
      return stage != s || fraction != f;
    };
  };
  EXPECT_EQ(disc.sum_at(Rational(1), Semantics::closed, stop_at("complex", 0)).error().code, ErrorCode::cancelled);
  EXPECT_EQ(disc.events(DiscSide::outside, stop_at("complex", 0)).error().code, ErrorCode::cancelled);
  EXPECT_EQ(stages, (std::vector<std::string>{"complex 0", "complex 0"}));
  EXPECT_EQ(disc.sum_at(Rational(1), Semantics::closed, stop_at("complex", 1)).error().code, ErrorCode::cancelled);
  stages.clear();
  for (const double fraction : {0, 1})
    for (const auto member : {&GrowingDisc::sum_at, &GrowingDisc::closed_at})
      EXPECT_EQ((disc.*member)(Rational(1), Semantics::closed, stop_at("set", fraction)).error().code,
                ErrorCode::cancelled);
  for (const auto member : {&GrowingDisc::eroded_at, &GrowingDisc::opened_at})
    EXPECT_EQ((disc.*member)(Rational(1), Semantics::closed, stop_at("set", 0)).error().code, ErrorCode::cancelled);
  // The outer complex stood already.
  EXPECT_EQ(std::count(stages.begin(), stages.end(), "complex 0"), 1);
  EXPECT_EQ(area(*disc.sum_at(Rational(1))).value, area(*GrowingDisc(disc.region()).sum_at(Rational(1))).value);
}

/// Pieces and corners by name alone.
std::string names(const DiscSet& set) {
  auto json = nlohmann::json::parse(disc_set_to_json(set));
  std::string text;
  const auto ring = [&](const nlohmann::json& r) {
    for (const auto& piece : r.at("pieces")) {
      auto from = piece.at("from");
      from.erase("at");
      text += piece.at("of").dump() + from.dump() + "\n";
    }
    text += "-\n";
  };
  for (const auto& part : json.at("parts")) {
    ring(part.at("outer"));
    for (const auto& hole : part.at("holes")) ring(hole);
  }
  return text;
}

TEST(DiscLaws, NamesDoNotChangeWithPlaceAndScale) {
  const Region region = snapped_shapes::star(9, 2, 5);
  const Region scaled = *dymsum::scaled(region, 0x1p40, 0x1p40);
  for (const char* r : {"1/5", "1", "2"}) {
    const std::string here = names(*GrowingDisc(region).sum_at(rational(r)));
    EXPECT_EQ(here, names(*GrowingDisc(scaled).sum_at(rational(r) * *Rational::of(0x1p40))));
  }
  const Region comb = shapes::comb(4, 2, 1, 3), moved = *translated(comb, 0x1p45, -0x1p45);
  const DiscSet a = *GrowingDisc(comb).sum_at(rational("1/2"), Semantics::open),
                b = *GrowingDisc(moved).sum_at(rational("1/2"), Semantics::open);
  EXPECT_EQ(names(a), names(b));
  EXPECT_EQ(a.tight_segments.size(), b.tight_segments.size());
  EXPECT_GT(a.tight_segments.size(), 0u);
}

TEST(DiscLaws, PicturesHaveTrueArcs) {
  const Region region = shapes::rectangle(0, 0, 3, 2);
  const std::string svg = draw_disc_set(region, *GrowingDisc(region).sum_at(Rational(1)));
  std::size_t arcs = 0;
  for (std::size_t at = svg.find("A152 152 0 0 0 "); at != std::string::npos; at = svg.find("A152 152", at + 1)) ++arcs;
  EXPECT_EQ(arcs, 4u) << svg;
}

TEST(DiscLaws, ThinShapesHaveClosingsThatKeepThemAndNothingIsOpened) {
  const auto closed = [](const char* wkt, const Rational& r) { return *GrowingDisc(region_of(wkt)).closed_at(r); };
  const DiscSet straight = closed("LINESTRING(0 0,4 3)", 1);
  EXPECT_TRUE(straight.parts.empty());
  ASSERT_EQ(straight.segments.size(), 1u);
  EXPECT_EQ(straight.segments[0].from.at, (Point{0, 0}));
  EXPECT_EQ(straight.segments[0].to.at, (Point{4, 3}));
  EXPECT_EQ(closed("POINT(5 6)", 1).points.size(), 1u);
  // A right angle is rounded: the corner beyond the arc of a quarter disc, and what is left of both legs.
  const DiscSet bent = closed("LINESTRING(3 0,0 0,0 3)", 1);
  ASSERT_EQ(bent.parts.size(), 1u);
  EXPECT_EQ(bent.parts[0].outer.pieces.size(), 3u);
  EXPECT_NEAR(area(bent).value, 1 - std::numbers::pi / 4, 1e-9);
  ASSERT_EQ(bent.segments.size(), 2u);
  for (const DiscSegment& s : bent.segments)
    EXPECT_NEAR(std::hypot(s.to.at.x - s.from.at.x, s.to.at.y - s.from.at.y), 2, 1e-9);
  // Discs pass between two points, however near; parallel lines are joined by a band with hollow ends.
  EXPECT_EQ(closed("MULTIPOINT((0 0),(1 0))", 1).points.size(), 2u);
  const DiscSet band = closed("MULTILINESTRING((0 0,9 0),(0 1,9 1))", 2);
  ASSERT_EQ(band.parts.size(), 1u);
  EXPECT_TRUE(band.segments.empty());
  // An opening is of what has area.
  const GrowingDisc mixed(
      region_of("GEOMETRYCOLLECTION(POLYGON((0 0,4 0,4 4,0 4,0 0)),LINESTRING(6 0,9 0),POINT(7 7))"));
  EXPECT_EQ(mixed.opened_at(Rational(1))->parts.size(), 1u);
  EXPECT_TRUE(mixed.opened_at(Rational(1))->segments.empty());
  EXPECT_TRUE(GrowingDisc(region_of("LINESTRING(0 0,1 1)")).eroded_at(Rational(1))->parts.empty());
}

/// The corners of the convex hull, counter-clockwise.
Ring hull_of(std::vector<Point> points) {
  const auto before = [](Point a, Point b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
  std::sort(points.begin(), points.end(), before);
  Ring hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t start = hull.size();
    for (const Point& p : points) {
      while (hull.size() >= start + 2) {
        const Point &a = hull[hull.size() - 2], &b = hull.back();
        if ((b.x - a.x) * (p.y - a.y) > (b.y - a.y) * (p.x - a.x)) break;
        hull.pop_back();
      }
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

/// Polygons on either side are there, and their boxes lie as they say.
void expect_between(const DiscSet& set, double error) {
  const Result<DiscPolygons> in = to_region(set, error, DiscBound::inside),
                             out = to_region(set, error, DiscBound::outside);
  ASSERT_TRUE(in) << in.error().to_string();
  ASSERT_TRUE(out) << out.error().to_string();
  const std::array<double, 4> around = bounds(out->region), inner = bounds(in->region), wanted = bounds(set);
  for (std::size_t i = 0; i < 4; ++i) {
    const double sense = i < 2 ? -1 : 1;
    EXPECT_GE(sense * around[i] + out->rounded + set.at_error, sense * wanted[i]) << i;
    EXPECT_NEAR(around[i], wanted[i], out->error + set.at_error) << i;
    if (!in->region.empty()) {
      EXPECT_LE(sense * inner[i] - in->rounded - set.at_error, sense * wanted[i]) << i;
    }
  }
  for (std::size_t i = 0; i < 4 && in->collapsed == 0 && !in->region.empty(); ++i) {
    EXPECT_NEAR(inner[i], wanted[i], in->error + set.at_error) << i;
  }
  if (in->collapsed == 0) return;
  // One within the other.
  const Region origin = Region::create({{}, {}, {{0, 0}}}).value();
  for (const Part& part : in->region.parts())
    for (const Point& v : part.outer) EXPECT_TRUE(contains(out->region, origin, v)) << v.x << " " << v.y;
}

TEST(DiscLaws, NoErosionOfAConvexShapeIsTooSmallForPolygons) {
  oracles::Random random(77);
  std::size_t collapsed = 0, sets = 0;
  for (int round = 0; round < oracles::rounds(60); ++round) {
    std::vector<Point> points;
    for (int k = 0; k < 3 + round % 4; ++k) points.push_back({double(random.below(9)), double(random.below(9))});
    Ring ring = hull_of(points);
    // On the grid, in decimals, turned, and far from the origin.
    const double c = std::cos(0.5), s = std::sin(0.5);
    for (Point& p : ring) {
      if (round % 4 == 1) p = {0.1 * p.x, 0.1 * p.y};
      if (round % 4 == 2) p = {c * p.x - s * p.y, s * p.x + c * p.y};
      if (round % 4 == 3) p = {p.x + 1e6, p.y - 1e6 / 3};
    }
    const Result<Region> region = Region::create({{{ring, {}}}, {}, {}});
    if (!region) continue;
    const GrowingDisc disc(*region);
    const std::vector<DiscEvent> events = *disc.events(DiscSide::inside);
    for (std::uint32_t k = 0; k < events.size(); ++k)
      for (const double fraction : {0.0, 0x1p-53, 1e-15, 1e-14, 1e-12, -1e-15}) {
        const DiscRadius r = fraction == 0 ? DiscRadius::at_event(k) : *Rational::of(events[k].radius * (1 - fraction));
        const DiscSet set = *disc.eroded_at(r);
        const double error = std::max(set.radius / 1000, 8 * set.at_error);
        const Result<DiscPolygons> made = to_region(set, error, DiscBound::nearest);
        ASSERT_TRUE(made) << made.error().to_string() << " round " << round << ", event " << k << ", " << fraction;
        EXPECT_GE(made->region.parts().size() + made->collapsed, set.parts.size());
        // What is left stays where it was.
        const std::array<double, 4> box = bounds(made->region), wanted = bounds(set);
        for (std::size_t i = 0; i < 4 && !made->region.empty(); ++i) EXPECT_NEAR(box[i], wanted[i], made->error);
        expect_between(set, error);
        collapsed += made->collapsed, ++sets;
      }
  }
  EXPECT_GT(sets, static_cast<std::size_t>(oracles::rounds(200)));
  EXPECT_GT(collapsed, static_cast<std::size_t>(oracles::rounds(20)));
}

TEST(DiscLaws, PolygonsNearestToASetAreThereHoweverNarrowItIs) {
  oracles::Random random(77);
  std::size_t collapsed = 0, sets = 0;
  for (int round = 0; round < oracles::rounds(60); ++round) {
    const RegionData data = oracles::random_parts(random, 5);
    const double unit = round % 3 == 1 ? 0.1 : 1, far = round % 3 == 2 ? 1e6 : 0;
    RegionData moved = oracles::mapped(data, unit, 0, 0, unit);
    const auto move = [&](Ring& ring) {
      for (Point& p : ring) p = {p.x + far, p.y - far / 3};
    };
    for (Part& part : moved.parts) {
      move(part.outer);
      std::for_each(part.holes.begin(), part.holes.end(), move);
    }
    const Result<Region> region = Region::create(moved);
    if (!region || region->parts().empty() || !region->touching_points().empty()) continue;
    const GrowingDisc disc(*region);
    for (const DiscSide side : {DiscSide::inside, DiscSide::outside}) {
      const std::vector<DiscEvent> events = *disc.events(side);
      for (std::uint32_t k = 0; k < events.size(); ++k)
        for (const double fraction : {0.0, 0x1p-53, 1e-14, -1e-15}) {
          const DiscRadius r =
              fraction == 0 ? DiscRadius::at_event(k) : *Rational::of(events[k].radius * (1 - fraction));
          for (const bool thick : {false, true}) {
            const DiscSet set = side == DiscSide::inside ? (thick ? *disc.opened_at(r) : *disc.eroded_at(r))
                                                         : (thick ? *disc.closed_at(r) : *disc.sum_at(r));
            const double error = std::max(set.radius / 1000, 8 * set.at_error);
            const Result<DiscPolygons> made = to_region(set, error, DiscBound::nearest);
            ASSERT_TRUE(made) << made.error().to_string() << " round " << round << ", event " << k << ", " << fraction;
            const Measured wanted = area(set), around = perimeter(set);
            EXPECT_NEAR(area(made->region), wanted.value, wanted.error + 2 * around.value * made->error)
                << "round " << round << ", event " << k << ", " << fraction;
            collapsed += made->collapsed > 0, ++sets;
          }
        }
    }
  }
  EXPECT_GT(sets, 500u);
  EXPECT_GT(collapsed, 20u);
}

TEST(DiscErrors, AreToldWithWhatIsWrong) {
  const GrowingDisc disc(shapes::letter_l(5, 4, 1));
  EXPECT_EQ(disc.sum_at(Rational(-1)).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(disc.sum_at(DiscRadius::at_event(1000)).error().code, ErrorCode::out_of_range);
  const GrowingDisc crossing(region_of("MULTILINESTRING((0 0,1 1),(0 1,1 0))"));
  EXPECT_EQ(crossing.closed_at(Rational(1)).error().code, ErrorCode::unsupported_operand);
  const DiscSet set = *disc.sum_at(Rational(1));
  for (const double error : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), 1e-30})
    EXPECT_EQ(to_region(set, error).error().code, ErrorCode::out_of_range);
  const DiscSet empty = *GrowingDisc(Region()).sum_at(Rational(1));
  EXPECT_TRUE(empty.parts.empty());
  EXPECT_TRUE(to_region(empty, 1)->region.empty());
}

}  // namespace
}  // namespace dymsum
