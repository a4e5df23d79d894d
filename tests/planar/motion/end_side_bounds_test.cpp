// Bounds of the ends of segments and of exact angles in doubles: they hold, and are not many times too large.
#include <gtest/gtest.h>

#include <numbers>

#include "oracles/digits.h"
#include "oracles/random.h"
#include "oracles/random_pentagon.h"
#include "planar/motion/operand_pair.h"
#include "planar/motion/orientation.h"
#include "planar/motion/turning_forms.h"

namespace dymsum::planar {
namespace {

using exact::BigRational;

// The side of a segment's end as that of its start and what its direction adds.
TEST(EndSideBounds, sides_of_ends_err_by_less_and_not_by_much_less) {
  oracles::Random random(21);
  double most = 0;
  for (int k = 0; k < 40; ++k) {
    const double sizes[] = {1, 0x1p-3, 0x1p-9};
    const auto base =
        pair_of_regions(oracles::random_pentagon(random, 1.3, 1.1, sizes[random.below(3)]),
                        oracles::random_pentagon(random, 0.7, 0.2, sizes[random.below(3)]), PairOptions{.moved = 1})
            .value();
    const TurningForms forms(*base);
    BigRational unit = exact::exact_value(std::ldexp(1.0, base->lattice->grid_exponent));
    unit /= exact::exact_value(base->lattice->unit);
    for (int i = 0; i < 60; ++i) {
      const double t = random.signed_unit(), d = 1 + t * t;
      const auto wrong = [&] { return (random.chance(50) ? 15 : -15) * exact::kRoundoff; };
      const Heading h{(1 - t * t) / d + wrong(), 2 * t / d + wrong()};
      const auto any = [&] {
        return WalkSegment{static_cast<std::uint32_t>(random.below(2)), static_cast<std::uint32_t>(random.below(5)),
                           static_cast<std::uint32_t>(random.below(5))};
      };
      const WalkSegment a = any(), b = any();
      const Point from = forms.position(TurningForms::start(a), h), to = forms.position(TurningForms::start(b), h),
                  e = forms.direction(a, h), g = forms.direction(b, h);
      const double side = e.x * (to.y - from.y) - e.y * (to.x - from.x) + (e.x * g.y - e.y * g.x);
      const exact::Polynomial p = forms.exact_side(a, forms.end(b), 0);
      const BigRational x = exact::exact_value(t);
      BigRational truth = 0;
      for (int n = p.degree(); n >= 0; --n) truth = truth * x + BigRational(p[n].value());
      truth *= unit * unit / (1 + x * x);
      const BigRational off = abs(BigRational(exact::exact_value(side) - truth));
      most = std::max(most, exact::round_to_double(off) / (kTurnedEndSide * forms.length1(a) * forms.span()));
    }
  }
  EXPECT_LE(most, 1);
  EXPECT_GT(most, 1.0 / 32);
}

// Against angles of fifty digits.
TEST(EndSideBounds, event_angles_err_by_less_and_not_by_much_less) {
  using oracles::Digits;
  oracles::Random random(22);
  double near_zero = 0, turned = 0;
  for (int k = 0; k < 4000; ++k) {
    // Doubles, which are their own intervals, in either chart.
    const double t = random.signed_unit() * std::ldexp(1.0, -random.below(20));
    const ExactAngle angle{k % 2, exact::AlgebraicRoot::of(t)};
    const EventAngle at = event_angle(angle);
    const Digits half_turn = Digits::pi(), rest = 2 * atan(Digits(t)),
                 truth = angle.chart == 0 ? rest : Digits(t > 0 ? rest - half_turn : rest + half_turn);
    ASSERT_LE(Digits(at.low), truth) << k;
    ASSERT_GE(Digits(at.high), truth) << k;
    if (angle.t.low() != angle.t.high()) continue;
    const Digits width = Digits(at.high) - Digits(at.low);
    double& most = angle.chart == 0 ? near_zero : turned;
    most = std::max(most, static_cast<double>(Digits(abs(Digits(2 * truth - at.low - at.high)) / width)));
  }
  EXPECT_GT(near_zero, 1.0 / 8);
  EXPECT_GT(turned, 1.0 / 16);
}

}  // namespace
}  // namespace dymsum::planar
