// Distances of points from segments err by less than they say, and not by much less.
#include "cspace/queries/clearance_search.h"

#include <gtest/gtest.h>

#include "exact/big.h"
#include "oracles/random.h"

namespace dymsum {
namespace {

using exact::BigRational;

BigRational exactly(double v) { return exact::exact_value(v); }

BigRational square_distance(Point from, Point a, Point b) {
  const BigRational dx = exactly(b.x) - exactly(a.x), dy = exactly(b.y) - exactly(a.y),
                    px = exactly(from.x) - exactly(a.x), py = exactly(from.y) - exactly(a.y), l = dx * dx + dy * dy;
  BigRational t = l == 0 ? BigRational(0) : BigRational((dx * px + dy * py) / l);
  if (t < 0) t = 0;
  if (t > 1) t = 1;
  const BigRational x = px - t * dx, y = py - t * dy;
  return x * x + y * y;
}

TEST(SegmentDistance, errs_by_less_than_it_says_and_not_by_much_less) {
  oracles::Random random(33);
  double most = 0;
  for (int k = 0; k < 20000; ++k) {
    const auto at = [&](double far) { return Point{far + random.signed_unit(), random.signed_unit()}; };
    const double far = k % 3 == 0 ? 0 : 10;
    const Point a = at(far), d = at(0), b{a.x + d.x, a.y + d.y};
    // Next to the segment, where the foot tells the most.
    const double t = random.signed_unit(), off = k % 2 == 0 ? 1 : 0x1p-40;
    const Point from{a.x + t * d.x - off * d.y, a.y + t * d.y + off * d.x};
    cspace::NearestPosition nearest;
    nearest.add_segment(from, a, b, 0);
    const BigRational truth = square_distance(from, a, b), low = exactly(nearest.distance - nearest.error),
                      high = exactly(nearest.distance + nearest.error);
    ASSERT_LE(truth, high * high) << k;
    if (low > 0) {
      ASSERT_GE(truth, low * low) << k;
    }
    const BigRational distance = exactly(nearest.distance);
    const double sum = exact::round_to_double(BigRational(abs(distance * distance - truth)));
    most = std::max(most, sum / (2 * nearest.distance + nearest.error) / nearest.error);
  }
  EXPECT_GT(most, 1.0 / 256);
}

}  // namespace
}  // namespace dymsum
