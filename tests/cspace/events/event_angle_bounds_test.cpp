// Angles of events against those of fifty digits: they lie between the doubles that are said, and are not much nearer.
#include "cspace/events/rotation_events.h"

#include <gtest/gtest.h>

#include "oracles/digits.h"
#include "oracles/random.h"

namespace dymsum::planar {
namespace {

using exact::BigRational;

TEST(EventAngleBounds, angles_err_by_less_and_not_by_much_less) {
  using oracles::Digits;
  oracles::Random random(51);
  double most = 0;
  for (int k = 0; k < 2000; ++k) {
    const RotationRange range{k % 2, -1, 1};
    // Doubles are roots without a width of their own; of others the interval is wider.
    const BigRational t = exact::exact_value(random.signed_unit()) / (k % 3 == 0 ? 3 : 1);
    RotationEvent event;
    event.root = exact::AlgebraicRoot::rational(t);
    set_angles(event, range);
    const Digits truth = 2 * atan(Digits(t)) + (range.chart == 1 ? Digits::pi() : Digits(0));
    ASSERT_LE(Digits(event.low), truth) << k;
    ASSERT_GE(Digits(event.high), truth) << k;
    if (event.root->low() != event.root->high()) continue;
    const Digits midpoint = (Digits(event.low) + Digits(event.high)) / 2;
    most = std::max(most, static_cast<double>(Digits(abs(Digits(truth - midpoint)))) / kEventAngle);
  }
  EXPECT_GT(most, 1.0 / 16);
}

}  // namespace
}  // namespace dymsum::planar
