// Poses that touch exactly, in doubles that are as wrong as their bounds allow: certain answers are never wrong, and a
// little farther away answers are proved. A bound that is made 32 times smaller fails here.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "cspace/motion/motion_sweep.h"
#include "cspace/motion/pivot.h"
#include "cspace/motion/slice_map.h"
#include "dymsum/motion.h"
#include "oracles/random.h"

namespace dymsum::planar {
namespace {

using exact::BigRational;

constexpr double kUnit = 0x1p-53;

Region one_ring(std::vector<Point> ring) {
  RegionData data;
  data.parts.push_back({std::move(ring), {}});
  return Region::create(std::move(data)).value();
}

/// A double that is off the exact cosine or sine by nearly one unit, upwards or downwards.
double as_granted(const BigRational& v, int sign) {
  for (const double fraction : {1.0, 0.75, 0.5}) {
    const double near = exact::round_to_double(BigRational(v + exact::exact_value(sign * fraction * kUnit)));
    if (abs(BigRational(exact::exact_value(near) - v)) <= exact::exact_value(kUnit)) return near;
  }
  return exact::round_to_double(v);
}

/// A triangle that stands on one corner on a floor of height 0 when its origin is at (0, 0) and it is turned by
/// 2 atan(m / n): that corner then is at (far, 0) exactly. Right of it the floor soon ends, so that the bounds of its
/// side are small.
struct Standing {
  BigRational c, s;
  double far = 0;
  int m = 0, n = 1;
  Region robot, floor;

  explicit Standing(oracles::Random& random) {
    m = random.below(41) - 20;
    n = 1 + random.below(20);
    const int square = n * n + m * m;
    c = BigRational(n * n - m * m, square);
    s = BigRational(2 * n * m, square);
    const double w = std::ldexp(1 + std::abs(std::ldexp(std::floor(random.signed_unit() * 0x1p40), -40)),
                                -std::ilogb(static_cast<double>(square)));
    const Point low{w * (n * n - m * m), -w * (2 * n * m)};
    far = w * square;
    const double rc = exact::round_to_double(c), rs = exact::round_to_double(s);
    const auto above = [&](double x) {  // when turned
      return Point{low.x + (rc * x + rs * 0.125), low.y + (0.125 * rc - rs * x)};
    };
    robot = one_ring({low, above(0.0625), above(-0.0625)});
    const double right = far + 0x1p-10;
    floor = one_ring({{right, 0}, {-8, 0}, {-8, -1}, {right, -1}});
  }
};

TEST(PoseBounds, a_corner_on_a_floor_is_unsure_and_certain_a_little_above_and_below) {
  oracles::Random random(41);
  for (int k = 0; k < 4000; ++k) {
    const Standing it(random);
    // Both move the corner the same way.
    const int sign = random.chance(50) ? 1 : -1;
    const double c = as_granted(it.c, it.s > 0 ? -sign : sign), s = as_granted(it.s, it.c > 0 ? sign : -sign);
    Pose pose(it.robot, it.floor);
    ASSERT_EQ(pose.overlap(0, 0, c, s, 0), Pose::Overlap::unsure) << k;
    ASSERT_EQ(pose.gap(0, 0, c, s, 0).at_least, 0) << k;
    const double away = 16 * 16 * kUnit * pose.reach();
    ASSERT_EQ(pose.overlap(0, away, c, s, 0), Pose::Overlap::no) << k;
    ASSERT_EQ(pose.overlap(0, -away, c, s, 0), Pose::Overlap::yes) << k;
    ASSERT_GT(pose.gap(0, 0x1p-41, c, s, 0).at_least, 0) << k;
  }
}

// A tiny robot in the middle of a long edge, where the cross product and the foot of the perpendicular are all that
// errs.
TEST(PoseBounds, a_corner_on_a_long_edge_is_unsure_and_has_no_gap) {
  oracles::Random random(42);
  const double t = 0x1p-30;
  const Region robot = one_ring({{0, 0}, {t, t}, {-t, t}});
  for (int k = 0; k < 20000; ++k) {
    const auto bits = [&] { return std::ldexp(std::floor(random.signed_unit() * 0x1p49), -49); };
    const Point d{1 + std::abs(bits()), bits() / 2};
    const double m = 1 + random.below(7), n = 1 + random.below(2);
    const Point right{m * d.x, m * d.y}, left{-n * d.x, -n * d.y};
    const Region below = one_ring({right, left, {left.x, left.y - 1}, {right.x, right.y - 1}});
    Pose pose(robot, below);
    ASSERT_EQ(pose.overlap(0, 0, 1, 0, 0), Pose::Overlap::unsure) << k;
    ASSERT_EQ(pose.gap(0, 0, 1, 0, 0).at_least, 0) << k;
    ASSERT_EQ(pose.overlap(0, 0x1p-42, 1, 0, 0), Pose::Overlap::no) << k;
    ASSERT_EQ(pose.overlap(0, -0x1p-42, 1, 0, 0), Pose::Overlap::yes) << k;
    ASSERT_GT(pose.gap(0, 0x1p-42, 1, 0, 0).at_least, 0) << k;
  }
}

// Along an edge towards the origin, where places of poses are the rounded difference of two long ways.
TEST(PoseBounds, sliding_along_an_edge_is_undecided) {
  oracles::Random random(43);
  for (int k = 0; k < 150; ++k) {
    const auto bits = [&] { return std::ldexp(std::floor(random.signed_unit() * 0x1p52), -52); };
    const Point d{0.5 + std::abs(bits()) / 16, 0.5 + std::abs(bits()) / 16};
    const auto on = [&](double fraction) { return Point{fraction * d.x, fraction * d.y}; };
    const Point right = on(0x1p-10), left = on(-0x1p-6);
    const Region below = one_ring({right, left, {left.x, left.y - 0.125}, {right.x, right.y - 0.125}});
    const auto above = [&](double x) { return Point{0x1p-12 * (x * d.x - d.y), 0x1p-12 * (x * d.y + d.x)}; };
    const Region robot = one_ring({{0, 0}, above(0.5), above(-0.5)});
    const Point to = on(-0x1p-8);
    const MotionCheck slide = check_motion(robot, below, {d.x, d.y, 0}, {to.x, to.y, 0}).value();
    ASSERT_EQ(slide.outcome, MotionCheck::Outcome::undecided) << k;
    const MotionCheck cut = check_motion(robot, below, {d.x, d.y - 0x1p-44, 0}, {to.x, to.y - 0x1p-44, 0}).value();
    ASSERT_EQ(cut.outcome, MotionCheck::Outcome::blocked) << k;
  }
}

// A position so little above or below the floor that only exact signs tell. Doubles of angles near half a turn err by 2
// or 3 units, a position is granted 16 besides: no pose shows what is granted for the angle alone.
TEST(PoseBounds, a_pivot_knows_an_overlap_from_a_touch) {
  oracles::Random random(44);
  for (int k = 0; k < 150; ++k) {
    const Standing it(random);
    Pivot pivot(it.robot, it.floor);
    const Orientation theta = Orientation::of(exact::to_rational(BigRational(it.m, it.n))).value();
    for (const int sign : {-1, 0, 1}) {
      pivot.stand({BigRational(0), exact::exact_value(sign * 0x1p-70)});
      ASSERT_EQ(pivot.overlaps(theta), sign < 0) << k;
    }
  }
}

// Doubles without errors of their own: the cross product is all that errs, to a good part of what is granted.
TEST(PoseBounds, sides_of_doubles_next_to_a_line) {
  oracles::Random random(45);
  int misled = 0;
  double most = 0;
  for (int k = 0; k < 5000; ++k) {
    // So small that differences from it are rounded.
    const double size = std::ldexp(1.0, -random.below(30));
    const Point a{size * random.signed_unit(), size * random.signed_unit()},
        b{random.signed_unit(), random.signed_unit()};
    const double fraction = random.signed_unit();
    const Point c{a.x + fraction * (b.x - a.x), a.y + fraction * (b.y - a.y)};
    const auto of = [](double v) { return exact::exact_value(v); };
    const BigRational truth = (of(b.x) - of(a.x)) * (of(c.y) - of(a.y)) - (of(b.y) - of(a.y)) * (of(c.x) - of(a.x));
    ASSERT_EQ(side(SlicePoint(a), SlicePoint(b), SlicePoint(c)), truth.sign()) << k;
    const double u = (b.x - a.x) * (c.y - a.y), v = (b.y - a.y) * (c.x - a.x), det = u - v;
    if ((det > 0) - (det < 0) == truth.sign()) continue;
    ++misled;
    most = std::max(most, std::abs(det) / (8 * kUnit * (std::abs(u) + std::abs(v))));
  }
  EXPECT_GT(misled, 100);
  EXPECT_GT(most, 1.0 / 16);
}

}  // namespace
}  // namespace dymsum::planar
