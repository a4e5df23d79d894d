// Bounds of what an obstacle is made with, against exact values: places on segments, the order of angles that doubles
// hardly distinguish, and tight placements far from the origin.
#include <gtest/gtest.h>

#include <numbers>

#include "cspace/obstacle/event_plan.h"
#include "cspace/obstacle/slice_reader.h"
#include "dymsum/cspace_obstacle.h"
#include "oracles/digits.h"
#include "oracles/random.h"
#include "oracles/random_pentagon.h"
#include "planar/motion/operand_pair.h"

namespace dymsum::planar {
namespace {

using exact::BigRational;
using ExactPair = std::array<BigRational, 2>;

BigRational rational_of(double v) { return exact::exact_value(v); }

struct RationalTurn {
  BigRational c, s;
  explicit RationalTurn(const BigRational& t) : c((1 - t * t) / (1 + t * t)), s(2 * t / (1 + t * t)) {}
  ExactPair operator()(const BigRational& x, const BigRational& y) const {
    return {BigRational(c * x - s * y), BigRational(s * x + c * y)};
  }
};

// Of cosine, sine, place, direction and share: all as wrong as each of them may be.
TEST(ObstacleBounds, places_on_segments_err_by_less_and_not_by_much_less) {
  oracles::Random random(61);
  double most = 0;
  for (int k = 0; k < 40; ++k) {
    const double sizes[] = {1, 0x1p-3, 0x1p-9};
    const auto base =
        pair_of_regions(oracles::random_pentagon(random, 1.3, 1.1, sizes[random.below(3)]),
                        oracles::random_pentagon(random, 0.7, 0.2, sizes[random.below(3)]), PairOptions{.moved = 1})
            .value();
    const TurningForms forms(*base);
    const BigRational unit =
        rational_of(std::ldexp(1.0, base->lattice->grid_exponent)) / rational_of(base->lattice->unit);
    const auto vertex = [&](std::uint32_t op, std::uint32_t v) -> ExactPair {
      const TurningForms::Vec& g = forms.grid_point(op, v);
      const ExactPair at{BigRational(BigRational(g.x) * unit), BigRational(BigRational(g.y) * unit)};
      if (op == 0) return at;
      return {BigRational(at[0] - rational_of(forms.centre().x)), BigRational(at[1] - rational_of(forms.centre().y))};
    };
    for (int i = 0; i < 60; ++i) {
      const double t = random.signed_unit(), fraction = std::abs(random.signed_unit()), d = 1 + t * t;
      const auto wrong = [&] { return (random.chance(50) ? 15 : -15) * exact::kRoundoff; };
      const Heading h{(1 - t * t) / d + wrong(), 2 * t / d + wrong()};
      const RationalTurn turned(rational_of(t));
      const auto any = [&] { return static_cast<std::uint32_t>(random.below(5)); };
      const WalkSegment s{static_cast<std::uint32_t>(random.below(2)), any(), any()};
      const Pair start = TurningForms::start(s), end = forms.end(s);
      const auto truly = [&](Pair v) -> ExactPair {
        const ExactPair q = vertex(0, v.p), p = vertex(1, v.q), r = turned(p[0], p[1]);
        return {BigRational(q[0] + r[0]), BigRational(q[1] + r[1])};
      };
      const ExactPair from = truly(start), to = truly(end);
      const Point at = forms.position(start, h), e = forms.direction(s, h);
      const BigRational x = from[0] + rational_of(fraction) * (to[0] - from[0]),
                        off = abs(BigRational(rational_of(at.x + fraction * e.x) - x));
      most = std::max(most, exact::round_to_double(off) / (kPositionError * forms.span()));
    }
  }
  EXPECT_LE(most, 1);
  EXPECT_GT(most, 1.0 / 32);
}

// An obstacle that is the robot turned and rounded: its edges are aligned at angles that differ by roundings.
TEST(ObstacleBounds, alignments_that_doubles_hardly_tell_apart_are_in_their_order) {
  oracles::Random random(62);
  int close = 0;
  for (int k = 0; k < 200; ++k) {
    const Region robot = oracles::random_pentagon(random, 0, 0, 1);
    // Half a turn as well, where angles begin and end.
    const double by = k % 3 == 0 ? std::numbers::pi : random.signed_unit() * 3, c = std::cos(by), s = std::sin(by);
    RegionData data;
    data.parts.emplace_back();
    for (const Point v : robot.parts()[0].outer) data.parts[0].outer.push_back({c * v.x - s * v.y, s * v.x + c * v.y});
    const CspaceObstacle obstacle = CspaceObstacle::create(robot, Region::create(std::move(data)).value()).value();
    // tan(theta / 4) grows with the angle: by charts of half a turn, those about pi at both ends.
    using oracles::Digits;
    std::vector<Digits> exactly;
    for (std::uint32_t a = 0; a < obstacle.angles().size(); ++a) {
      const CspaceObstacle::HalfTangent t = obstacle.half_tangent(a);
      const Digits half = atan(Digits(t.high) + Digits(t.low)), pi = Digits::pi();
      exactly.push_back(!t.opposite ? Digits(2 * half) : half > 0 ? Digits(2 * half - pi) : Digits(2 * half + pi));
    }
    ASSERT_TRUE(std::is_sorted(exactly.begin(), exactly.end())) << k;
    for (std::size_t a = 1; a < exactly.size(); ++a) close += exactly[a] - exactly[a - 1] < 0x1p-50;
  }
  EXPECT_GT(close, 200);
}

// A square that fits into its room exactly, both far from the origin: the position errs by what turns the square's
// offset.
TEST(ObstacleBounds, tight_placements_far_from_the_origin_err_by_less_and_not_by_much_less) {
  oracles::Random random(63);
  double most = 0;
  for (int k = 0; k < 24; ++k) {
    const auto whole = [&] { return static_cast<double>(1 + random.below(1 << 30)); };
    const double x = whole(), y = whole(), u = random.below(8), v = random.below(8);
    const auto part_of = [](std::vector<Point> outer, std::vector<Ring> holes) {
      RegionData data;
      data.parts.push_back({std::move(outer), std::move(holes)});
      return Region::create(std::move(data)).value();
    };
    // Turned by (4/5, 3/5) its sides (5, 0) and (0, 5) are (4, 3) and (-3, 4).
    const Region square = part_of({{x, y}, {x + 5, y}, {x + 5, y + 5}, {x, y + 5}}, {});
    const Region room = part_of({{u - 9, v - 9}, {u + 9, v - 9}, {u + 9, v + 9}, {u - 9, v + 9}},
                                {{{u, v}, {u - 3, v + 4}, {u + 1, v + 7}, {u + 4, v + 3}}});
    const CspaceObstacle obstacle = CspaceObstacle::create(square, room).value();
    int found = 0;
    for (const TightFeature& f : obstacle.tight()) {
      if (std::abs(obstacle.angles()[f.angle].theta - std::atan2(3, 4)) > 1e-9) continue;
      ++found;
      const BigRational px = rational_of(u) - (4 * rational_of(x) - 3 * rational_of(y)) / 5,
                        py = rational_of(v) - (3 * rational_of(x) + 4 * rational_of(y)) / 5;
      for (const BigRational& off : {BigRational(rational_of(f.from.x) - px), BigRational(rational_of(f.from.y) - py)})
        most = std::max(most, exact::round_to_double(BigRational(abs(off))) / f.error);
    }
    EXPECT_EQ(found, 1) << k;
  }
  EXPECT_LE(most, 1);
  EXPECT_GT(most, 1.0 / 64);
}

// Free doubles on one side and an operand far from the origin on the other: the sum of what they are moved by is
// rounded.
TEST(ObstacleBounds, boundaries_far_from_the_origin_have_free_sides) {
  oracles::Random random(64);
  int loops = 0;
  for (int k = 0; k < 60; ++k) {
    const auto whole = [&] { return 0x1p40 + random.below(1 << 30); };
    const Region robot = oracles::random_pentagon(random, random.signed_unit(), random.signed_unit(), 1),
                 near = oracles::random_pentagon(random, 0, 0, 2);
    RegionData data;
    data.parts.emplace_back();
    const double x = whole(), y = whole();
    for (const Point v : near.parts()[0].outer) data.parts[0].outer.push_back({x + v.x, y + v.y});
    const auto base =
        pair_of_regions(Region::create(std::move(data)).value(), robot, PairOptions{.moved = 1, .reflect_q = true})
            .value();
    const TurningForms forms(*base);
    const SliceReader reader(forms, base);
    const SegmentIndex index(forms.size(0), forms.size(1));
    for (int i = 0; i < 4; ++i) {
      const Orientation at = Orientation::nearest(3 * random.signed_unit()).value();
      for (const SliceLoop& loop : reader.loops(at)) {
        std::vector<WalkSegment> segments;
        for (const std::uint32_t s : loop.segments) segments.push_back(index.segment(s));
        EXPECT_TRUE(reader.is_free(segments, at)) << k;
        ++loops;
      }
    }
  }
  EXPECT_EQ(loops, 4 * 60);
}

}  // namespace
}  // namespace dymsum::planar
