// Tight features at exact fit and a hair either side, in families rather than single cases.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>

#include "dymsum/shapes.h"
#include "oracles/exact_shape.h"
#include "oracles/snapped_shapes.h"
#include "oracles/verdict.h"

namespace dymsum::oracles {
namespace {

constexpr Engine kEngines[] = {Engine::fast, Engine::brute, Engine::winding};

SumOptions with(Engine engine, Semantics semantics = Semantics::closed) {
  SumOptions out;
  out.engine = engine;
  out.semantics = semantics;
  return out;
}

Ring box(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }
Ring hole(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x0, y1}, {x1, y1}, {x1, y0}}; }

Region made(std::vector<Part> parts) {
  RegionData data;
  data.parts = std::move(parts);
  return Region::create(std::move(data)).value();
}

/// The only tight point is the origin, exactly.
void expect_tight_origin(const PlanarSum& sum) {
  const ExactShape<Big> shape = exact_shape<Big>(sum);
  ASSERT_EQ(shape.tight_points.size(), 1u);
  EXPECT_TRUE(shape.tight_points[0] == (Pt<Big>{Big(0), Big(0)}));
}

struct Features {
  std::size_t holes, segments, points;
  friend bool operator==(const Features&, const Features&) = default;
  friend std::ostream& operator<<(std::ostream& out, const Features& f) {
    return out << f.holes << " holes, " << f.segments << " tight segments, " << f.points << " tight points";
  }
};

Features features(const Region& p, const Region& q, Engine engine) {
  const PlanarSum sum = minkowski_sum(p, q, with(engine)).value();
  return {sum.hole_count(), sum.tight_segments.size(), sum.tight_points.size()};
}

/// A closed cavity 2 wide and 2 + gap high around a square of side 2.
TEST(Tight, square_in_a_cavity_at_every_gap) {
  for (const Engine engine : kEngines)
    for (const double start : {0.0, 1.0, 1000.0, -123456.75})
      for (const int power : {0, -10, -30, -35}) {
        const double gap = std::ldexp(1.0, power);
        const Region square = made({{box(-2, -2, 0, 0), {}}});
        const auto cavity = [&](double height) {
          return made(
              {{box(start - 1, start - 1, start + 5, start + 5), {hole(start, start, start + 2, start + height)}}});
        };
        SCOPED_TRACE("engine " + std::to_string(static_cast<int>(engine)) + ", gap 2^" + std::to_string(power));
        EXPECT_EQ(features(cavity(2), square, engine), (Features{0, 0, 1}));
        EXPECT_EQ(features(cavity(2 + gap), square, engine), (Features{0, 1, 0}));
        EXPECT_EQ(features(cavity(2 - gap), square, engine), (Features{0, 0, 0}));
      }
}

/// Slots of several widths in a row; only the one of the peg's width is tight, wider ones have area.
TEST(Tight, peg_over_a_row_of_slots) {
  const double hair = 0x1p-40;
  const std::vector<double> widths = {1 - hair, 1, 1 + hair, 2};
  std::vector<Ring> holes;
  for (std::size_t i = 0; i < widths.size(); ++i) {
    const double left = 1 + 3 * static_cast<double>(i);
    holes.push_back(hole(left, 1, left + widths[i], 4));
  }
  const Region plate = made({{box(0, 0, 13, 5), holes}}), peg = made({{box(-1, -1, 0, 0), {}}});
  for (const Engine engine : kEngines) {
    const PlanarSum sum = minkowski_sum(plate, peg, with(engine)).value();
    EXPECT_EQ(sum.hole_count(), 2u);
    EXPECT_TRUE(sum.tight_points.empty());
    ASSERT_EQ(sum.tight_segments.size(), 1u);
    const Seg<Big> s = exact_shape<Big>(sum).tight_segments[0];
    EXPECT_TRUE(s == (Seg<Big>{{Big(4), Big(1)}, {Big(4), Big(3)}}));
  }
}

/// Cutting a convex disc out of a plate and putting it back.
TEST(Tight, disc_in_its_own_hole) {
  for (const int corners : {3, 5, 8, 13, 32}) {
    const Region disc = snapped_shapes::disc(corners, 7);
    Ring lid = disc.parts()[0].outer;
    std::reverse(lid.begin(), lid.end());
    const Region plate = made({{box(-10, -10, 10, 10), {lid}}});
    for (const Engine engine : kEngines) {
      const PlanarSum sum = minkowski_sum(plate, negated(disc), with(engine)).value();
      SCOPED_TRACE(corners);
      expect_tight_origin(sum);
      EXPECT_TRUE(sum.tight_segments.empty());
      EXPECT_EQ(sum.hole_count(), 0u);
    }
  }
}

TEST(Tight, non_convex_lids_fit_back_in_exactly_one_way) {
  int lids = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Random random(seed);
    Ring lid = random_polygon(random, 6, 3 + random.below(5));
    const Region part = made({{lid, {}}});
    std::reverse(lid.begin(), lid.end());
    const Region plate = made({{box(-1, -1, 7, 7), {lid}}});
    for (const Engine engine : kEngines) {
      const PlanarSum sum = minkowski_sum(plate, negated(part), with(engine)).value();
      SCOPED_TRACE("seed " + std::to_string(seed));
      expect_tight_origin(sum);
    }
    ++lids;
  }
  EXPECT_EQ(lids, 40);
}

TEST(Tight, regular_semantics_drops_what_open_and_closed_report) {
  const Region slot = made({{{{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, {}}});
  const Region peg = made({{box(-1, -1, 0, 0), {}}});
  for (const Engine engine : kEngines) {
    EXPECT_EQ(minkowski_sum(slot, peg, with(engine, Semantics::open))->tight_segments.size(), 1u);
    EXPECT_EQ(minkowski_sum(slot, peg, with(engine, Semantics::closed))->tight_segments.size(), 1u);
    EXPECT_EQ(minkowski_sum(slot, peg, with(engine, Semantics::regular))->tight_segments.size(), 0u);
  }
  EXPECT_TRUE(contains(slot, peg, {1, 1.5}, Semantics::closed));
  EXPECT_FALSE(contains(slot, peg, {1, 1.5}, Semantics::open));
}

TEST(Tight, eroding_a_shape_by_itself_leaves_one_position) {
  for (const int corners : {3, 4, 7, 32}) {
    const Region disc = snapped_shapes::disc(corners, 5);
    for (const Engine engine : kEngines) {
      const PlanarSum inner = erode(disc, disc, with(engine)).value();
      EXPECT_TRUE(inner.parts.empty());
      EXPECT_TRUE(inner.segments.empty());
      EXPECT_EQ(inner.points.size(), 1u);
      expect_tight_origin(inner);
    }
  }
}

TEST(Tight, eroding_a_doubled_convex_shape_gives_it_back) {
  for (const int corners : {3, 4, 7, 32}) {
    const Region disc = snapped_shapes::disc(corners, 5), twice = scaled(disc, 2, 2).value();
    RegionData origin;
    origin.points.push_back({0, 0});
    for (const Engine engine : kEngines) {
      const PlanarSum inner = erode(twice, disc, with(engine)).value();
      const PlanarSum want = minkowski_sum(disc, Region::create(origin).value(), with(engine)).value();
      EXPECT_TRUE(canonical(exact_shape<Big>(inner)) == canonical(exact_shape<Big>(want))) << corners;
    }
  }
}

TEST(Tight, erosion_refuses_containers_without_area_and_empty_parts) {
  const Region square = made({{box(0, 0, 1, 1), {}}});
  RegionData mixed = square.data();
  mixed.points.push_back({5, 5});
  EXPECT_EQ(erode(Region::create(mixed).value(), square).error().code, ErrorCode::unsupported_operand);
  EXPECT_EQ(erode(square, Region()).error().code, ErrorCode::unsupported_operand);
  const PlanarSum nothing = erode(Region(), square).value();
  EXPECT_TRUE(nothing.parts.empty() && nothing.segments.empty() && nothing.points.empty());
}

/// Moving an operand by 1e9 + 1/3 rounds its coordinates to multiples of 2^-23; holes of 1e-7 freedom and more stay.
TEST(Tight, translation_by_a_billion_and_a_third_keeps_every_hole) {
  const double far = 1e9 + 1.0 / 3;
  const Region lost = made({{box(0, 0, 10, 10), {hole(4, 4, 6 + 1e-7, 6 + 1e-7)}}}),
               square = made({{box(-1, -1, 1, 1), {}}});
  const Region moved_square = translated(square, far, far).value();
  for (const Engine engine : kEngines) {
    EXPECT_EQ(features(lost, square, engine), (Features{1, 0, 0}));
    EXPECT_EQ(features(lost, moved_square, engine), (Features{1, 0, 0}));
  }
  const Region plate = snapped_shapes::pockets(20, 40);
  const Region probe = shapes::rectangle(0, 0, 0.125, 0.125);
  const std::size_t holes = minkowski_sum(plate, probe)->hole_count();
  EXPECT_GE(holes, 20u);
  EXPECT_EQ(minkowski_sum(plate, translated(probe, far, -far).value())->hole_count(), holes);
}

/// The whole verdict, with provenance and membership, for the families above in small.
TEST(Tight, families_pass_the_verdict) {
  const double hair = 0x1p-40;
  for (const double width : {1 - hair, 1.0, 1 + hair})
    for (const double height : {1 - hair, 1.0, 1 + hair}) {
      RegionData plate, peg;
      plate.parts.push_back({box(0, 0, 3, 3), {hole(1, 1, 1 + width, 1 + height)}});
      peg.parts.push_back({box(-1, -1, 0, 0), {}});
      EXPECT_EQ(verdict(plate, peg), "") << width << " " << height;
    }
}

}  // namespace
}  // namespace dymsum::oracles
