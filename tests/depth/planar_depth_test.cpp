// Depth and distance of planar regions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <span>

#include "dymsum/penetration_depth.h"
#include "dymsum/region_io.h"
#include "dymsum/sum_locator.h"
#include "oracles/random.h"
#include "oracles/sanitized.h"
#include "oracles/tiny_regions.h"

namespace dymsum::test {
namespace {

Region region(std::vector<Part> parts) { return Region::create({std::move(parts), {}, {}}).value(); }

Region square(double half) { return region({{{{-half, -half}, {half, -half}, {half, half}, {-half, half}}, {}}}); }

/// A square of half size 3 with a hole of half size 1.
Region frame() { return region({{{{-3, -3}, {3, -3}, {3, 3}, {-3, 3}}, {{{-1, -1}, {-1, 1}, {1, 1}, {1, -1}}}}}); }

TEST(PlanarDepth, of_squares_and_a_frame) {
  const PlanarDepth squares = PlanarDepth::create(square(1), square(1)).value();
  EXPECT_EQ(squares.at({1.5, 0}).distance, 0.5);
  EXPECT_EQ(squares.at({1.5, 0}).ways.at(0).direction, (Point{1, 0}));
  EXPECT_EQ(squares.at({0, 0}).ways.size(), 4U);
  EXPECT_EQ(squares.at({2, 1}).meeting, Meeting::touching);
  EXPECT_EQ(squares.at({5, 6}).distance, 5);
  EXPECT_EQ(squares.at({5, 6}).meeting, Meeting::apart);
  const PlanarDepth loose = PlanarDepth::create(frame(), square(0.5)).value();
  EXPECT_EQ(loose.at({0, 0}).meeting, Meeting::apart);
  EXPECT_EQ(loose.at({0, 0}).distance, 0.5);
  EXPECT_EQ(loose.at({0.75, 0.25}).distance, 0.25);
  const PlanarDepth tight = PlanarDepth::create(frame(), square(1)).value();
  EXPECT_EQ(tight.at({0, 0}).meeting, Meeting::touching);
  EXPECT_EQ(tight.at({0.25, 0.25}).squared.to_string(), "1/8") << "back into a hole that fits exactly";
  EXPECT_FALSE(tight.at({0.25, 0.25}).ways.at(0).contacts.empty());
}

TEST(PlanarDepth, the_way_out_separates_and_no_shorter_one_does) {
  const Region p = frame(), q = region({{{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, {}}});
  const PlanarDepth depth = PlanarDepth::create(p, q).value();
  std::mt19937_64 random(5);
  std::uniform_int_distribution<int> eighth(-40, 40);
  int overlapping = 0;
  for (int k = 0; k < 60; ++k) {
    const Point at{eighth(random) / 8.0, eighth(random) / 8.0};
    const PlanarDistance d = depth.at(at);
    if (d.meeting != Meeting::overlapping) continue;
    ++overlapping;
    for (const PlanarWay& way : d.ways) {
      const Point to{at.x + way.move.x.to_double(), at.y + way.move.y.to_double()};
      EXPECT_FALSE(contains(p, negated(q), to, Semantics::open)) << k;  // multiples of an eighth
    }
    for (int a = 0; a < 32; ++a) {
      const double r = 0.999 * d.distance;
      const Point to{at.x + r * std::cos(a * 0.2), at.y + r * std::sin(a * 0.2)};
      EXPECT_TRUE(contains(p, negated(q), to, Semantics::open)) << k;
    }
  }
  EXPECT_GT(overlapping, 10);
}

// Squares of lengths below 2^-537 underflow, above 2^512 they overflow: both once chose edges that are not the nearest.
TEST(PlanarDepth, shapes_of_any_size_have_the_same_depth_but_for_their_size) {
  for (const int k : {-1070, -1000, -830, -700, -545, -540, -537, -500, 0, 500, 510, 900, 990}) {
    const double s = std::ldexp(1.0, k);
    const auto scaled = [&](Ring ring) {
      for (Point& at : ring) at = {s * at.x, s * at.y};
      return region({{ring, {}}});
    };
    const Region slot = scaled({{0, 0}, {4, 0}, {4, 4}, {3, 4}, {3, 1}, {1, 1}, {1, 4}, {0, 4}});
    const Region peg = scaled({{0, 0}, {2, 0}, {2, 1}, {0, 1}});
    const PlanarDistance d = PlanarDepth::create(slot, peg).value().at({0, 0});
    const Rational unit = Rational::of(s).value();
    EXPECT_EQ(d.squared, unit * unit) << "2^" << k;
    EXPECT_EQ(d.distance, s) << "2^" << k;
    ASSERT_EQ(d.ways.size(), 1U) << "2^" << k;
    EXPECT_EQ(d.ways[0].direction, (Point{0, -1}));
  }
}

TEST(PlanarDepth, what_has_no_area_is_refused) {
  EXPECT_EQ(PlanarDepth::create(square(1), Region()).error().code, ErrorCode::no_area);
  const Region wire = Region::create({{}, {{{0, 0}, {1, 1}}}, {}}).value();
  EXPECT_EQ(PlanarDepth::create(wire, wire).error().code, ErrorCode::unsupported_operand);
  EXPECT_EQ(PlanarDepth::create(wire, Region()).error().code, ErrorCode::no_area);
  EXPECT_THROW(PlanarDepth::create(square(1), square(1)).value().at({std::numeric_limits<double>::infinity(), 0}),
               std::invalid_argument);
}

using PlanarPair = std::pair<PlanarFeature, PlanarFeature>;

/// Every vertex and edge of P against every one of Q moved, in rationals.
std::map<PlanarPair, int> touching_features(const Region& p, const Region& q, const RationalPoint& moved) {
  using Kind = PlanarFeature::Kind;
  struct Feature {
    PlanarFeature name;
    RationalPoint a, b;
  };
  const auto features = [](const Region& region, const RationalPoint& by) {
    std::vector<Feature> all;
    std::uint32_t index = 0;
    const auto at = [&](const Point& v) {
      return RationalPoint{Rational::of(v.x).value() + by.x, Rational::of(v.y).value() + by.y};
    };
    const auto add = [&](const std::vector<Point>& chain, std::size_t edges) {
      for (std::size_t k = 0; k < chain.size(); ++k, ++index) {
        all.push_back({{Kind::vertex, index}, at(chain[k]), at(chain[k])});
        if (k < edges) all.push_back({{Kind::edge, index}, at(chain[k]), at(chain[(k + 1) % chain.size()])});
      }
    };
    for (const Part& part : region.parts()) {
      add(part.outer, part.outer.size());
      for (const Ring& hole : part.holes) add(hole, hole.size());
    }
    for (const Polyline& line : region.polylines()) add(line, line.size() - 1);
    add(region.points(), 0);
    return all;
  };
  const auto minus = [](const RationalPoint& a, const RationalPoint& b) { return RationalPoint{a.x - b.x, a.y - b.y}; };
  const auto cross = [](const RationalPoint& a, const RationalPoint& b) { return a.x * b.y - a.y * b.x; };
  const auto dot = [](const RationalPoint& a, const RationalPoint& b) { return a.x * b.x + a.y * b.y; };
  const auto dimension = [&](const Feature& f, const Feature& g) {
    const RationalPoint d = minus(f.b, f.a), e = minus(g.b, g.a), to = minus(g.a, f.a);
    if (f.name.kind == Kind::vertex && g.name.kind == Kind::vertex) return f.a == g.a ? 0 : -1;
    if (f.name.kind == Kind::vertex || g.name.kind == Kind::vertex) {
      const RationalPoint& along = f.name.kind == Kind::vertex ? e : d;
      const RationalPoint x = f.name.kind == Kind::vertex ? minus(f.a, g.a) : to;
      const Rational s = dot(along, x);
      return cross(along, x).sign() == 0 && s.sign() > 0 && s < dot(along, along) ? 0 : -1;
    }
    if (cross(d, e).sign() == 0) {
      const Rational s = dot(d, to), t = dot(d, minus(g.b, f.a));
      return cross(d, to).sign() == 0 && std::min(s, t) < dot(d, d) && std::max(s, t).sign() > 0 ? 1 : -1;
    }
    const Rational s = cross(to, e) / cross(d, e), t = cross(to, d) / cross(d, e);
    return s.sign() > 0 && s < Rational(1) && t.sign() > 0 && t < Rational(1) ? 0 : -1;
  };
  std::map<PlanarPair, int> all;
  const std::vector<Feature> of_q = features(q, moved);
  for (const Feature& f : features(p, {}))
    for (const Feature& g : of_q)
      if (const int d = dimension(f, g); d >= 0) all[{f.name, g.name}] = d;
  return all;
}

TEST(PlanarDepth, contacts_are_all_pairs_of_features_that_touch) {
  oracles::Random random(17);
  std::mt19937_64 positions(18);
  int flush = 0;
  const int rounds = oracles::rounds(120);
  for (int round = 0; round < rounds; ++round) {
    // On the grid, in decimals, in single precision, turned, and off by noise.
    const double c = std::cos(0.5), s = std::sin(0.5);
    const auto mapped = [&](RegionData data) {
      if (round % 5 == 1) data = oracles::mapped(data, 0.1, 0, 0, 0.1);
      if (round % 5 == 3) data = oracles::mapped(data, c, -s, s, c);
      const auto change = [&](Point& v) {
        if (round % 5 == 2) v = {static_cast<float>(0.1 * v.x), static_cast<float>(0.1 * v.y)};
        if (round % 5 == 4)
          v.x += 1e-9 * static_cast<double>(positions() % 7), v.y += 1e-9 * static_cast<double>(positions() % 5);
      };
      for (Part& part : data.parts) {
        std::for_each(part.outer.begin(), part.outer.end(), change);
        for (Ring& hole : part.holes) std::for_each(hole.begin(), hole.end(), change);
      }
      return Region::create(std::move(data));
    };
    const Result<Region> p = mapped(oracles::random_parts(random, 6)), q = mapped(oracles::random_parts(random, 4));
    if (!p || !q) continue;
    const Result<PlanarDepth> depth = PlanarDepth::create(*p, *q);
    if (!depth) continue;
    const double unit = round % 5 == 1 || round % 5 == 2 ? 0.05 : 0.5;
    const auto along = [&] { return unit * (static_cast<double>(positions() % 25) - 12); };
    const Point at{along(), along()};
    const PlanarDistance d = depth->at(at);
    for (const PlanarWay& way : d.ways) {
      const RationalPoint moved{way.move.x + Rational::of(at.x).value(), way.move.y + Rational::of(at.y).value()};
      std::map<PlanarPair, int> found;
      for (const PlanarTouch& t : way.contacts) found[{t.p, t.q}] = t.dimension, flush += t.dimension;
      EXPECT_EQ(found, touching_features(*p, *q, moved)) << "round " << round;
      EXPECT_EQ(found.size(), way.contacts.size());
      EXPECT_FALSE(found.empty());
    }
    if (HasFailure()) FAIL() << "round " << round;
  }
  EXPECT_GT(flush, rounds / 24);
}

Region thin(std::vector<Polyline> lines, std::vector<Point> points) {
  return Region::create({{}, std::move(lines), std::move(points)}).value();
}

TEST(PlanarDepth, points_and_polylines_overlap_what_has_area_in_its_interior) {
  const Region point = thin({}, {{0, 0}});
  const PlanarDepth inside = PlanarDepth::create(frame(), point).value();
  EXPECT_EQ(inside.at({0, 0}).meeting, Meeting::apart) << "in the hole";
  EXPECT_EQ(inside.at({1, 0.5}).meeting, Meeting::touching);
  EXPECT_EQ(inside.at({1.25, 0}).meeting, Meeting::overlapping);
  EXPECT_EQ(inside.at({1.25, 0}).distance, 0.25);
  // A segment as long as the hole is wide touches both sides, and sinks into one of them.
  const PlanarDepth across = PlanarDepth::create(frame(), thin({{{-1, 0}, {1, 0}}}, {})).value();
  EXPECT_EQ(across.at({0, 0}).meeting, Meeting::touching);
  const PlanarDistance sunk = across.at({0.25, 0});
  EXPECT_EQ(sunk.meeting, Meeting::overlapping);
  EXPECT_EQ(sunk.squared.to_string(), "1/16");
  ASSERT_EQ(sunk.ways.size(), 1U);
  EXPECT_EQ(sunk.ways[0].contacts.size(), 2U) << "both ends on the sides of the hole";
  // Either operand may be the thin one, and it may have area besides.
  EXPECT_EQ(PlanarDepth::create(point, frame()).value().at({-1.25, 0}).distance, 0.25);
  const Region mixed = Region::create({{{{{-9, -9}, {-8, -9}, {-8, -8}}, {}}}, {{{-1, 0}, {1, 0}}}, {{7, 7}}}).value();
  const PlanarDistance d = PlanarDepth::create(frame(), mixed).value().at({0.25, 0});
  EXPECT_EQ(d.squared.to_string(), "1/16");
  EXPECT_EQ(d.ways[0].contacts[0].q, (PlanarFeature{PlanarFeature::Kind::vertex, 3}));
}

TEST(PlanarDepth, thin_parts_separate_and_nothing_shorter_does) {
  std::mt19937 random(23);
  oracles::Random shapes_of(29);
  int overlapping = 0, queried = 0;
  const int rounds = oracles::rounds(60);
  for (int round = 0; round < rounds; ++round) {
    const auto coordinate = [&] { return static_cast<double>(random() % 13) - 6; };
    Polyline line;
    for (int k = 0; k < 2 + round % 3; ++k) line.push_back({coordinate(), coordinate()});
    RegionData data;
    if (round % 4 != 0) data.polylines = {line};
    if (round % 4 == 0 || round % 3 == 0) data.points = {{coordinate(), coordinate()}};
    double c = 1, s = 0, unit = 0.5;
    if (round % 5 == 1) c = 0.1, unit = 0.05;
    if (round % 5 == 2) c = std::cos(0.5), s = std::sin(0.5);
    const Result<Region> wire = Region::create(oracles::mapped(data, c, -s, s, c)),
                         solid = Region::create(oracles::mapped(oracles::random_parts(shapes_of, 6), c, -s, s, c));
    if (!wire || !solid || solid->parts().empty() || wire->empty()) continue;
    const bool swapped = round % 2 == 1;
    const Region &p = swapped ? *wire : *solid, &q = swapped ? *solid : *wire;
    SCOPED_TRACE(format_region(p, RegionFormat::wkt) + format_region(q, RegionFormat::wkt));
    const Result<PlanarDepth> depth = PlanarDepth::create(p, q);
    ASSERT_TRUE(depth) << depth.error().to_string();
    const Region back = negated(q);
    for (int k = 0; k < 12; ++k) {
      const Point at{unit * coordinate(), unit * coordinate()};
      const PlanarDistance d = depth->at(at);
      ++queried;
      EXPECT_EQ(d.meeting == Meeting::overlapping, contains(p, back, at, Semantics::open)) << round;
      EXPECT_EQ(d.meeting != Meeting::apart, contains(p, back, at, Semantics::closed)) << round;
      overlapping += d.meeting == Meeting::overlapping;
      for (const PlanarWay& way : d.ways) {
        const RationalPoint moved{way.move.x + Rational::of(at.x).value(), way.move.y + Rational::of(at.y).value()};
        const std::vector<RationalPoint> positions{moved};
        EXPECT_EQ(contains_each(p, back, std::span<const RationalPoint>(positions), Semantics::open).value()[0], 0)
            << round;
        EXPECT_EQ(contains_each(p, back, std::span<const RationalPoint>(positions), Semantics::closed).value()[0], 1)
            << round;
        std::map<PlanarPair, int> found;
        for (const PlanarTouch& t : way.contacts) found[{t.p, t.q}] = t.dimension;
        EXPECT_EQ(found, touching_features(p, q, moved)) << round;
      }
      constexpr double kRounded = 1e-9;  // nearer places are no doubles
      for (int a = 0; a < 16 && d.distance > kRounded; ++a) {
        const double r = 0.999 * d.distance;
        const Point to{at.x + r * std::cos(a * 0.4), at.y + r * std::sin(a * 0.4)};
        EXPECT_EQ(contains(p, back, to, Semantics::open), d.meeting == Meeting::overlapping)
            << at.x << ", " << at.y << ": " << d.distance << " " << a;
      }
    }
    if (HasFailure()) FAIL() << "round " << round;
  }
  EXPECT_GT(overlapping, queried / 20);
}

TEST(PlanarDepth, flush_squares_touch_in_edge_and_edge) {
  const PlanarDistance d = PlanarDepth::create(square(1), square(1)).value().at({1.5, 0});
  const std::vector<PlanarTouch>& all = d.ways.at(0).contacts;
  ASSERT_EQ(all.size(), 3U);  // and their corners
  EXPECT_EQ(all[0].dimension, 1);
  EXPECT_EQ(all[0].p, (PlanarFeature{PlanarFeature::Kind::edge, 1}));
  EXPECT_EQ(all[0].q, (PlanarFeature{PlanarFeature::Kind::edge, 3}));
  EXPECT_EQ(all[0].at, (RationalPoint{Rational(1), Rational(0)}));
  EXPECT_EQ(all[2].patch, 0U);
}

}  // namespace
}  // namespace dymsum::test
