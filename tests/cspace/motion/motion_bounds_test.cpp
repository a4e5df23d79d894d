// What doubles decide about poses and slices where the truth is on the border: certain answers are right, and most
// answers near the border are proved.
#include <gtest/gtest.h>

#include <cmath>

#include "cspace/motion/motion_sweep.h"
#include "cspace/motion/slice_map.h"
#include "dymsum/shapes.h"
#include "oracles/random.h"
#include "oracles/sanitized.h"

namespace dymsum::planar {
namespace {

using exact::BigRational;
using oracles::Random;

BigRational exactly(double v) { return exact::exact_value(v); }
SlicePoint point(BigRational x, BigRational y) { return SlicePoint(Position{std::move(x), std::move(y)}); }

// Points on a line, moved off it by less or a little more than doubles of their positions tell.
TEST(MotionBounds, sides_next_to_a_line_are_the_exact_ones) {
  Random random(31);
  for (int k = 0; k < oracles::rounds(5000); ++k) {
    const double reach = k % 2 == 0 ? 1 : 0x1p-20;  // both coordinates large, or only one
    const auto at = [&](double most) { return exactly(random.signed_unit() * most) / 3; };
    const Position a{1 + at(0x1p-10), at(1)}, d{at(reach), at(1)};
    const BigRational fraction = at(1), off = exactly(random.signed_unit() * 0x1p-52 * reach);
    const SlicePoint p = point(a.x, a.y), q = point(a.x + d.x, a.y + d.y),
                     r = point(a.x + fraction * d.x - off * d.y, a.y + fraction * d.y + off * d.x);
    const auto truth = [](const SlicePoint& u, const SlicePoint& v, const SlicePoint& w) {
      const Position &x = u.exact(), &y = v.exact(), &z = w.exact();
      return sign((y.x - x.x) * (z.y - x.y) - (y.y - x.y) * (z.x - x.x));
    };
    ASSERT_EQ(side(p, q, r), truth(p, q, r)) << k;
    ASSERT_EQ(side(r, p, q), truth(r, p, q)) << k;
    const SlicePoint beside = point(a.x + exactly(random.signed_unit() * 0x1p-52), a.y);
    ASSERT_EQ(compare_x(p, beside), sign(a.x - beside.exact().x)) << k;
  }
}

// A robot that turns by (3/5, 4/5) and stands on a floor with one corner, its position rounded.
TEST(MotionBounds, a_touching_pose_is_neither_apart_nor_overlapping) {
  Random random(32);
  const double c = 0.6, s = 0.8;
  const Region floor = shapes::rectangle(-8, -1, 8, 0);
  int proved = 0;
  for (int k = 0; k < 4000; ++k) {
    const Point low{random.signed_unit(), -1 - std::abs(random.signed_unit())};
    RegionData data;
    // Turned, the first corner is the lowest one.
    data.parts.push_back({{low, {low.x + 3, low.y}, {low.x + 3, low.y + 1}}, {}});
    const Region robot = Region::create(std::move(data)).value();
    const BigRational height = BigRational(4, 5) * exactly(low.x) + BigRational(3, 5) * exactly(low.y);
    const double y = exact::round_to_double(BigRational(-height)), slack = std::abs(y) * 0x1p-53;
    const double x = random.signed_unit();
    Pose pose(robot, floor);
    EXPECT_EQ(pose.overlap(x, y, c, s, slack), Pose::Overlap::unsure) << k;
    EXPECT_EQ(pose.gap(x, y, c, s, slack).at_least, 0) << k;
    // A hundred roundings away doubles do decide, except where a bound is far too large.
    const double away = 400 * 0x1p-53 * 16;
    proved += pose.overlap(x, y + away, c, s, slack) == Pose::Overlap::no;
    proved += pose.overlap(x, y - away, c, s, slack) == Pose::Overlap::yes;
    const double gap = pose.gap(x, y + away, c, s, slack).at_least;
    EXPECT_LE(gap, away + slack + 4 * 0x1p-53);
    EXPECT_GT(gap, 0);
  }
  EXPECT_EQ(proved, 2 * 4000);
}

}  // namespace
}  // namespace dymsum::planar
