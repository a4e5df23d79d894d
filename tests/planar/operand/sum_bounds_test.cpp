// Bounds of sums of vertices against exact values: they hold, and are not many times too large.
#include "planar/operand/lattice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "exact/big.h"
#include "oracles/random.h"
#include "oracles/sanitized.h"
#include "planar/operand/edges.h"

namespace dymsum::planar {
namespace {

using exact::BigRational;

BigRational exactly(double v) { return exact::exact_value(v); }
double fraction(const BigRational& error, double bound) {
  return exact::round_to_double(BigRational(abs(error))) / bound;
}

/// A coordinate up to `most` as a lattice holds it: rounded, or with a factor that is rounded, and the product.
struct Coordinate {
  BigRational exact;
  double value;
  Coordinate(oracles::Random& random, double most, const BigRational* factor) {
    const BigRational v =
        exactly(std::abs(random.signed_unit()) * most) + exactly(random.signed_unit() * most * 0x1p-53);
    value = exact::round_to_double(v);
    exact = v;
    if (factor != nullptr) {
      value *= exact::round_to_double(*factor);
      exact = v * *factor;
    }
  }
};

struct Fractions {
  double point = 0, side = 0, of_position = 0, height = 0, cross = 0, angle = 0, gap = 0, box = 0, touch = 0, step = 0,
         rounded = 0;
  void take(double& most, const BigRational& error, double bound) { most = std::max(most, fraction(error, bound)); }
};

// Roundings are the largest next above powers of two: sizes and factors are there now and then.
Fractions largest_fractions(int rounds) {
  oracles::Random random(21);
  Fractions most;
  for (int k = 0; k < rounds; ++k) {
    const BigRational factor = 1 + BigRational(random.below(1 << 20) + 1, random.chance(50) ? 1 << 30 : 3 << 18);
    const double of_p = random.chance(30) ? 0 : 1 + std::abs(random.signed_unit()) * (random.chance(50) ? 0x1p-20 : 1);
    const double of_q = of_p == 0 || random.chance(50) ? 1 : 0x1p-20;
    const auto q = [&] { return Coordinate(random, of_q, &factor); };
    const auto p = [&] { return Coordinate(random, of_p, nullptr); };
    const double span = of_p + of_q * exact::round_to_double(factor);
    const Coordinate px = p(), py = p(), qx = q(), qy = q(), rx = p(), ry = p(), sx = q(), sy = q(), dx = q(), dy = q();
    const double x = px.value + qx.value, y = py.value + qy.value, u = rx.value + sx.value, v = ry.value + sy.value;
    const BigRational ex = px.exact + qx.exact, ey = py.exact + qy.exact, eu = rx.exact + sx.exact,
                      ev = ry.exact + sy.exact;
    most.take(most.point, exactly(x) - ex, kSumPoint * span);
    const double length = dx.value + dy.value;
    const BigRational side = dx.exact * (ev - ey) - dy.exact * (eu - ex);
    most.take(most.side, exactly(dx.value * (v - y) - dy.value * (u - x)) - side, kSumSide * length * span);
    // As of a position at (u, v), seen from the vertices one by one.
    const double ax = u - px.value, ay = v - py.value;
    const BigRational seen = dx.exact * (exactly(v) - ey) - dy.exact * (exactly(u) - ex);
    most.take(most.of_position, exactly(dx.value * (ay - qy.value) - dy.value * (ax - qx.value)) - seen,
              kSumSide * length * span);
    most.take(most.height, exactly(py.value + qy.value - v) - (ey - exactly(v)), kSumHeight * span);
    const Coordinate fx = q(), fy = q();
    const double left = dx.value * fy.value, right = dy.value * fx.value;
    most.take(most.cross, exactly(left - right) - (dx.exact * fy.exact - dy.exact * fx.exact),
              kScaledEdgeCross * (left + right));
    most.take(most.gap, exactly(dx.value - fx.value) - (dx.exact - fx.exact), kScaledEdgeGap * (dx.value + fx.value));
    // How far a vertex of P lies beside one of Q that a position moves, with a margin taken off.
    const double margin = kSumBox * span;
    most.take(most.box, exactly((u - qx.value) - px.value - margin) - (exactly(u) - ex - exactly(margin)), margin);
    // A vertex that lies on a segment, and a position that is a step away from its start.
    const double wx = dx.value + fx.value, step = std::abs(random.signed_unit());
    const BigRational fraction_of = (eu - ex) / dx.exact;
    if (abs(fraction_of) <= 1)
      most.take(most.touch, exactly((u - x) / dx.value) - fraction_of,
                static_cast<float>(kTouchFractions * kSumPoint * span / dx.value + kFractionRoundings));
    most.take(most.step, exactly(x + step * dx.value) - (ex + exactly(step) * dx.exact),
              2 * kSumPoint * span + kStepLength * dx.value + kStepSum * span);
    const BigRational far = exactly(random.signed_unit() * span) + exactly(random.signed_unit() * 0x1p-60 * wx);
    most.take(most.rounded, exactly(x + exact::round_to_double(far)) - (ex + far), kRoundedPosition * span);
    const BigRational key = 3 + dx.exact / (dx.exact + dy.exact);
    most.take(most.angle, exactly(pseudo_angle(dx.value, -dy.value)) - key, kAngleError / 2);
  }
  return most;
}

TEST(SumBounds, sums_and_signs_err_by_less_and_not_by_much_less) {
  const Fractions most = largest_fractions(oracles::rounds(20000));
  const double fractions[] = {most.point, most.side, most.of_position, most.height, most.cross,  most.angle,
                              most.gap,   most.box,  most.touch,       most.step,   most.rounded};
  for (std::size_t k = 0; k < std::size(fractions); ++k) {
    EXPECT_LE(fractions[k], 1) << k;
    EXPECT_GT(fractions[k], 1.0 / 16) << k;
  }
}

// The mediant of two cuts whose denominators are known badly.
TEST(SumBounds, weights_of_mediants_err_by_less_and_not_by_much_less) {
  oracles::Random random(23);
  double most = 0;
  for (int k = 0; k < oracles::rounds(20000); ++k) {
    const double d0 = 1 + 7 * std::abs(random.signed_unit()), d1 = random.chance(50) ? d0 : 1.0 / d0;
    const double r = std::abs(random.signed_unit()) * (random.chance(50) ? 0x1p-30 : 0.9),
                 s = random.chance(50) ? r : 0;
    const double e0 = d0 * (1 + (random.chance(50) ? r : -r)), e1 = d1 * (1 + (random.chance(50) ? s : -s));
    const BigRational weight = exactly(d1) / (exactly(d0) + exactly(d1));
    most =
        std::max(most, fraction(exactly(e1 / (e0 + e1)) - weight, kMediantFractions * (r + s + exact::kRoundoff * 3)));
  }
  EXPECT_LE(most, 1);
  EXPECT_GT(most, 1.0 / 8);
}

// Next above powers of two every rounding is as large as it can be, and all go one way.
TEST(SumBounds, a_scaled_vertex_takes_nearly_all_that_is_granted) {
  const double u = exact::kRoundoff;
  double most = 0;
  for (int k = 20; k < 33; ++k) {
    const BigRational x = exactly(1 + std::ldexp(1.0, -k)) + exactly(u), s = exactly(1 + std::ldexp(1.0, k - 53)) + u;
    const double rx = exact::round_to_double(x), rs = exact::round_to_double(s), b = u;
    for (const double off : {-0x1p-80, 0x1p-80})
      most = std::max(most, fraction(exactly(rx * rs + b) - (x * s + exactly(b) + exactly(off)), kSumPoint * rx * rs));
  }
  EXPECT_LE(most, 1);
  EXPECT_GT(most, 0.7);
}

// Shares from the worst sides that are possible.
TEST(SumBounds, shares_of_crossings_err_by_less_and_not_by_much_less) {
  oracles::Random random(22);
  double most = 0;
  for (int k = 0; k < oracles::rounds(20000); ++k) {
    const double d = (8 + 100 * std::abs(random.signed_unit())) * 0x1p-40, t = std::abs(random.signed_unit());
    const BigRational n = exactly(t) * exactly(d), m = n - exactly(d);
    const double e = 0x1p-40;
    // Of the right sign, and for half an error at least.
    const double rn = std::max(exact::round_to_double(n) + (random.chance(50) ? e : -e), e / 2),
                 rm = std::min(exact::round_to_double(m) + (random.chance(50) ? e : -e), -e / 2);
    const double cross = d + (random.chance(50) ? e : -e);
    if (!(cross > kCrossingFractions * e)) continue;
    most = std::max(
        most, fraction(exactly(rn / (rn - rm)) - exactly(t), kCrossingFractions * e / cross + kFractionRoundings));
  }
  EXPECT_LE(most, 1);
  EXPECT_GT(most, 1.0 / 8);
}

}  // namespace
}  // namespace dymsum::planar
