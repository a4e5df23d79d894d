// How far doubles say that vertices and their sums move in a window, against exact positions: never less than they do,
// and not by many times more.
#include <gtest/gtest.h>

#include <numbers>

#include "oracles/digits.h"
#include "oracles/random.h"
#include "oracles/random_pentagon.h"
#include "planar/motion/operand_pair.h"
#include "planar/window/rotation_mask.h"

namespace dymsum::planar {
namespace {

using exact::BigRational;
using ExactPlane = std::array<BigRational, 2>;

ExactPlane turned_by(const BigRational& t, const ExactPlane& p) {
  const BigRational c = (1 - t * t) / (1 + t * t), s = 2 * t / (1 + t * t);
  return {BigRational(c * p[0] - s * p[1]), BigRational(s * p[0] + c * p[1])};
}

// At the end of a window so narrow that roundings are a good part of what moves.
TEST(SweptBounds, places_move_by_less_and_not_by_much_less) {
  using oracles::Digits;
  oracles::Random random(23);
  double of_position = 0, of_rim = 0;
  for (int k = 0; k < 20; ++k) {
    const double sizes[] = {1, 0x1p-3};
    const auto base =
        pair_of_regions(oracles::random_pentagon(random, 1.3, 1.1, sizes[random.below(2)]),
                        oracles::random_pentagon(random, 0.7, 0.2, sizes[random.below(2)]), PairOptions{.moved = 1})
            .value();
    const TurningForms forms(*base);
    BigRational unit = exact::exact_value(std::ldexp(1.0, base->lattice->grid_exponent));
    unit /= exact::exact_value(base->lattice->unit);
    for (int i = 0; i < 60; ++i) {
      const double t = random.signed_unit(), end = t + 0x1p-50 * random.signed_unit(), d = 1 + t * t;
      const double half =
          static_cast<double>(Digits(abs(Digits(2 * atan(Digits(end)) - 2 * atan(Digits(t)))))) * (1 + 0x1p-50);
      const auto wrong = [&] { return (random.chance(50) ? 15 : -15) * exact::kRoundoff; };
      const Heading h{(1 - t * t) / d + wrong(), 2 * t / d + wrong()};
      const Pair v{static_cast<std::uint32_t>(random.below(5)), static_cast<std::uint32_t>(random.below(5))};
      const TurningForms::Vec &q = forms.grid_point(0, v.p), &p = forms.grid_point(1, v.q);
      const ExactPlane moved = turned_by(exact::exact_value(end),
                                         {BigRational(BigRational(p.x) * unit - exact::exact_value(forms.centre().x)),
                                          BigRational(BigRational(p.y) * unit - exact::exact_value(forms.centre().y))});
      const Point own = forms.points(1)[v.q], fixed = forms.points(0)[v.p],
                  turned{h.c * own.x - h.s * own.y, h.s * own.x + h.c * own.y}, by = moved_by(turned, half);
      const auto excess = [](double value, const BigRational& truth, double granted) {
        return exact::round_to_double(
            BigRational(abs(BigRational(exact::exact_value(value) - truth)) - exact::exact_value(granted)));
      };
      of_rim = std::max({of_rim, excess(turned.x, moved[0], by.x) / (kSweptRim * forms.span()),
                         excess(turned.y, moved[1], by.y) / (kSweptRim * forms.span())});
      of_position = std::max({of_position,
                              excess(fixed.x + turned.x, BigRational(BigRational(q.x) * unit + moved[0]), by.x) /
                                  (kSweptPosition * forms.span()),
                              excess(fixed.y + turned.y, BigRational(BigRational(q.y) * unit + moved[1]), by.y) /
                                  (kSweptPosition * forms.span())});
    }
  }
  EXPECT_LE(of_rim, 1);
  EXPECT_GT(of_rim, 1.0 / 16);
  EXPECT_LE(of_position, 1);
  EXPECT_GT(of_position, 1.0 / 64);
}

}  // namespace
}  // namespace dymsum::planar
