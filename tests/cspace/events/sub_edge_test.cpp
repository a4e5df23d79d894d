// Where two segments cross, in doubles: within the error that is said, down to lines that are parallel but for
// roundings.
#include "cspace/events/exact_position.h"

#include <gtest/gtest.h>

#include <numbers>

#include "oracles/random.h"
#include "planar/motion/operand_pair.h"

namespace dymsum::planar {
namespace {

using exact::BigRational;

Region ring(oracles::Random& random) {
  RegionData data;
  data.parts.emplace_back();
  for (int k = 0; k < 5; ++k) {
    const double angle = 2 * std::numbers::pi * (k + 0.4 * random.signed_unit()) / 5;
    data.parts[0].outer.push_back({std::cos(angle), std::sin(angle)});
  }
  return Region::create(std::move(data)).value();
}

BigRational value(const exact::Polynomial& p, const BigRational& t) {
  BigRational sum = 0;
  for (int k = p.degree(); k >= 0; --k) sum = sum * t + BigRational(p[k].value());
  return sum;
}

TEST(SubEdge, nearly_parallel_lines_cross_within_the_error_that_is_said) {
  oracles::Random random(3);
  int known = 0, unknown = 0;
  for (int k = 0; k < 300; ++k) {
    const auto base = pair_of_regions(ring(random), ring(random), PairOptions{.moved = 1}).value();
    const TurningForms forms(*base);
    for (std::uint32_t e = 0; e < 5; ++e)
      for (std::uint32_t f = 0; f < 5; ++f) {
        const WalkSegment s{0, e, (f + 2) % 5}, other{1, f, (e + 2) % 5};
        const Point d = forms.edge(0, e), g = forms.edge(1, f);
        // Parallel, up to a little of any size.
        double theta = std::atan2(d.y, d.x) - std::atan2(g.y, g.x);
        theta = std::remainder(theta, 2 * std::numbers::pi) + std::ldexp(random.signed_unit(), -44 - random.below(8));
        const double t = std::tan(theta / 2), off = 15 * exact::kRoundoff;
        if (!(std::abs(t) < 1)) continue;
        Heading h = Heading::of(theta);
        const double by = random.chance(50) ? off : -off;
        h = {h.c - h.s * by, h.s + h.c * by};
        const Located at = position_on(forms, s, other, true, h);
        const BigRational x = exact::exact_value(t), cross = value(forms.exact_cross(s, other, 0), x);
        if (!std::isfinite(at.error) || cross == 0) {
          ++unknown;
          continue;
        }
        ++known;
        const BigRational truth = value(forms.exact_side(other, TurningForms::start(s), 0), x) / cross;
        EXPECT_LE(BigRational(abs(truth - exact::exact_value(at.t))), exact::exact_value(at.error));
      }
  }
  EXPECT_GT(known, 200);
  EXPECT_GT(unknown, 200);
}

// An event's angle is known up to an interval, of a tenth of which the position moves by more than all roundings.
TEST(SubEdge, places_are_said_for_every_angle_within_the_turn) {
  oracles::Random random(4);
  int moved = 0;
  for (int k = 0; k < 200; ++k) {
    const auto base = pair_of_regions(ring(random), ring(random), PairOptions{.moved = 1}).value();
    const TurningForms forms(*base);
    const WalkSegment s{0, static_cast<std::uint32_t>(k % 5), 1}, other{1, static_cast<std::uint32_t>(k / 5 % 5), 3};
    const double t = random.signed_unit(), turn = std::ldexp(1.0, -24 - static_cast<int>(random.below(16)));
    const Located at =
        position_on(forms, s, other, true, Heading::of(2 * std::atan(t) + 0.9 * turn * random.signed_unit()), turn);
    const BigRational x = exact::exact_value(t), cross = value(forms.exact_cross(s, other, 0), x);
    if (!std::isfinite(at.error) || cross == 0) continue;
    const BigRational truth = value(forms.exact_side(other, TurningForms::start(s), 0), x) / cross,
                      off = abs(truth - exact::exact_value(at.t));
    EXPECT_LE(off, exact::exact_value(at.error));
    moved += off > exact::exact_value(at.error) / 64;
  }
  EXPECT_GT(moved, 20);
}

}  // namespace
}  // namespace dymsum::planar
