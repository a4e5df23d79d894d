// Bounds of a window's doubles against exact values: they hold, and are not many times too large.
#include "planar/motion/operand_pair.h"

#include <gtest/gtest.h>

#include "exact/big.h"
#include "oracles/random.h"
#include "oracles/sanitized.h"
#include "thesis/crossing_range.h"

namespace dymsum::planar {
namespace {

using exact::BigRational;

BigRational exactly(double v) { return exact::exact_value(v); }

/// The largest of many errors as shares of what bounds them.
class ErrorFractions {
 public:
  void add(const BigRational& error, double bound) {
    most_ = std::max(most_, exact::round_to_double(BigRational(abs(error))) / bound);
  }
  /// The bound holds, and `some` of it is reached.
  void expect_bounded(double some) const {
    EXPECT_LE(most_, 1);
    EXPECT_GT(most_, some);
  }

 private:
  double most_ = 0;
};

/// Coordinates that carry the rounding that vertices of a lattice do, and those of a stretched operand besides a
/// rounded factor and the product with it.
struct Rounded {
  BigRational exact;
  double value;
  Rounded(oracles::Random& random, int position)
      : exact(exactly(std::abs(random.signed_unit()) * position) + exactly(random.signed_unit() * 0x1p-52)),
        value(exact::round_to_double(exact)) {}
  void factors(oracles::Random& random) {
    const BigRational factor(500 + random.below(500), 1001);
    exact *= factor;
    value *= exact::round_to_double(factor);
  }
};

TEST(WindowBounds, points_and_sides_err_by_less_and_not_by_much_less) {
  oracles::Random random(7);
  ErrorFractions of_point, of_side, of_search;
  for (int k = 0; k < oracles::rounds(20000); ++k) {
    // All of the span belongs to the fixed operand, to the moving one, or to both.
    const int fixed = random.below(3), moving = fixed == 0 ? 1 : random.below(3);
    const double span = fixed + 2.0 * moving;
    const BigRational scale(random.below(1000) + 1, 1001);  // tau1 = 1
    const double tau = exact::round_to_double(scale);
    Rounded fx(random, fixed), fy(random, fixed), mx(random, moving), my(random, moving), gx(random, fixed),
        gy(random, fixed), nx(random, moving), ny(random, moving), dx(random, 1), dy(random, 1);
    if (k % 2 == 1)
      for (Rounded* stretched : {&fx, &fy, &mx, &my, &gx, &gy, &nx, &ny, &dx, &dy}) stretched->factors(random);
    const double x = fx.value + tau * mx.value, y = fy.value + tau * my.value, u = gx.value + tau * nx.value,
                 v = gy.value + tau * ny.value;
    const BigRational ex = fx.exact + scale * mx.exact, ey = fy.exact + scale * my.exact,
                      eu = gx.exact + scale * nx.exact, ev = gy.exact + scale * ny.exact;
    of_point.add(exactly(x) - ex, kWindowPoint * span);
    const BigRational side = dx.exact * (ev - ey) - dy.exact * (eu - ex);
    const double length = std::abs(dx.value) + std::abs(dy.value), value = dx.value * (v - y) - dy.value * (u - x);
    of_side.add(exactly(value) - side, kWindowSide * length * span);
    of_search.add(exactly(value) - side, kSearchSide * length * span);
  }
  // Of the counted errors random ones reach about a half; the rest is the slack that the constants state.
  of_point.expect_bounded(1.0 / 32);
  of_side.expect_bounded(1.0 / 32);
  of_search.expect_bounded(1.0 / 32);
}

TEST(WindowBounds, cross_products_of_edge_vectors) {
  oracles::Random random(8);
  ErrorFractions fractions;
  for (int k = 0; k < oracles::rounds(20000); ++k) {
    const Rounded ax(random, 1), ay(random, 1), bx(random, 1), by(random, 1);
    const double u = ax.value * by.value, v = ay.value * bx.value;
    fractions.add(exactly(u - v) - (ax.exact * by.exact - ay.exact * bx.exact), kEdgeCross * (u + v));
  }
  fractions.expect_bounded(1.0 / 8);
}

TEST(WindowBounds, cross_products_of_stretched_edge_vectors) {
  oracles::Random random(17);
  ErrorFractions fractions;
  for (int k = 0; k < oracles::rounds(20000); ++k) {
    Rounded ax(random, 1), ay(random, 1), bx(random, 1), by(random, 1);
    for (Rounded* stretched : {&ax, &ay, &bx, &by}) stretched->factors(random);
    const double u = ax.value * by.value, v = ay.value * bx.value;
    fractions.add(exactly(u - v) - (ax.exact * by.exact - ay.exact * bx.exact), kScaledEdgeCross * (u + v));
  }
  fractions.expect_bounded(1.0 / 8);
}

TEST(WindowBounds, fractions_of_crossing_lines) {
  oracles::Random random(9);
  ErrorFractions fractions;
  for (int k = 0; k < oracles::rounds(20000); ++k) {
    const BigRational n = exactly(random.signed_unit()), d = exactly(0.25 + std::abs(random.signed_unit()));
    const double rn = 0x1p-30, rd = 0x1p-3;  // the worst of what is known of both
    const double value_n = exact::round_to_double(BigRational(n + exactly(random.chance(50) ? rn : -rn))),
                 value_d = exact::round_to_double(BigRational(d * exactly(random.chance(50) ? 1 + rd : 1 - rd)));
    if (abs(n) > d * 2) continue;
    const double relative = 2 * rd < kKnownDenominator ? rd / (1 - rd) : 0.2;
    fractions.add(exactly(value_n / value_d) - n / d, fraction_error(rn, value_d, relative, 2));
  }
  fractions.expect_bounded(1.0 / 8);
}

TEST(WindowBounds, signs_are_certain_beyond_the_error_of_a_root) {
  oracles::Random random(10);
  ErrorFractions fractions;
  for (int k = 0; k < oracles::rounds(20000); ++k) {
    const double a = -std::abs(random.signed_unit()), b = 1 + random.signed_unit() / 2,
                 error = random.chance(50) ? 0 : 0x1p-50;
    const double root = -a / b, tau1 = 1;
    const BigRational truth = (-exactly(a) + exactly(error)) / exactly(b) * exactly(1 + 0x1p-53);
    fractions.add(exactly(root) - truth, root_error(root, b, error, tau1));
  }
  fractions.expect_bounded(1.0 / 16);
}

// ErrorFractions that move linearly, evaluated, subtracted, and followed along a line.
TEST(WindowBounds, moving_shares_err_by_less_and_not_by_much_less) {
  oracles::Random random(11);
  ErrorFractions of_fraction, of_gap, followed;
  for (int k = 0; k < oracles::rounds(20000); ++k) {
    const BigRational scale(random.below(1000) + 1, 1001);
    const double tau = exact::round_to_double(scale), b = random.signed_unit(), a = random.chance(50) ? 0 : 1 - b * tau,
                 c = random.signed_unit(), d = random.chance(50) ? 0 : 1 - c * tau;
    const BigRational t = exactly(a) + exactly(b) * scale, u = exactly(d) + exactly(c) * scale;
    of_fraction.add(exactly(a + b * tau) - t, kFraction);
    of_gap.add(exactly((a + b * tau) - (d + c * tau)) - (t - u), kFractionGap);
    const double x = random.signed_unit(), m = random.signed_unit(), dx = random.signed_unit();
    const double from = x + dx * a, slope = m + dx * b;
    const BigRational at = exactly(x) + exactly(m) * scale + exactly(dx) * t;
    followed.add(exactly(from + slope * tau) - at, kFollowed * (std::abs(from) + std::abs(slope)) + kWindowPoint * 3);
  }
  for (const ErrorFractions& fractions : {of_fraction, of_gap, followed}) fractions.expect_bounded(1.0 / 32);
}

// Positions blown up and moved to where they are in the input, with the scale rounded.
TEST(WindowBounds, kept_positions_err_by_less_and_not_by_much_less) {
  oracles::Random random(14);
  ErrorFractions inside, outside;
  for (int k = 0; k < oracles::rounds(20000); ++k) {
    const BigRational s(random.below(1000) + 1, random.below(1000) + 1), tau = 1 / s;
    const double scale = exact::round_to_double(s), t = exact::round_to_double(tau);
    const double a = random.signed_unit(), b = random.signed_unit() * scale, span = 1 + scale * t;
    const double far = random.chance(50) ? 0 : 1000 * random.signed_unit(), other = far == 0 ? 0 : random.signed_unit();
    const double origin = far * scale + other, value = scale * (a + b * t) + origin;
    const BigRational truth = s * (exactly(a) + exactly(b) * tau) + exactly(far) * s + exactly(other);
    const double of_span = scale * kKeptPosition * span,
                 of_offsets = kKeptOffsets * (std::abs(far) * scale + std::abs(other));
    (far == 0 ? inside : outside).add(exactly(value) - truth, of_span + of_offsets);
  }
  inside.expect_bounded(1.0 / 32);
  outside.expect_bounded(1.0 / 32);
}

// Where a vertex lies along an edge, by scalar products.
TEST(WindowBounds, projections_err_by_less_and_not_by_much_less) {
  oracles::Random random(12);
  ErrorFractions of_position, of_gap;
  for (int k = 0; k < 20000; ++k) {
    const BigRational scale(random.below(1000) + 1, 1001);  // tau1 = 1
    const double tau = exact::round_to_double(scale);
    const double size = random.chance(50) ? 1 : 0x1p-10;
    const Rounded ox(random, 1), oy(random, 1), mx(random, 1), my(random, 1);
    const BigRational dx = exactly(random.signed_unit() * size) + exactly(random.signed_unit() * size * 0x1p-53),
                      dy = exactly(random.signed_unit() * size) + exactly(random.signed_unit() * size * 0x1p-53);
    const double ex = exact::round_to_double(dx), ey = exact::round_to_double(dy), square = ex * ex + ey * ey;
    if (square < 0x1p-24) continue;
    const double span = 1 + 2.0, lost = span * (std::abs(ex) + std::abs(ey)) / square;
    // Two places on the line, their coordinates rounded, the second a vector farther on.
    const auto position = [&](const BigRational& t, double farther) {
      const BigRational px = ox.exact + t * dx, py = oy.exact + t * dy;
      const double ax = exact::round_to_double(px) + farther * ex - ox.value,
                   ay = exact::round_to_double(py) + farther * ey - oy.value,
                   bx = exact::round_to_double(BigRational(mx.exact + t * dx)) - mx.value,
                   by = exact::round_to_double(BigRational(my.exact + t * dy)) - my.value;
      return std::pair{(ax * ex + ay * ey) / square + (bx * ex + by * ey) / square * tau,
                       BigRational(t + exactly(farther) + t * scale)};
    };
    const BigRational t = exactly(random.signed_unit() / 4), u = exactly(random.signed_unit() / 4);
    const auto [value, truth] = position(t, 1);
    const auto [other, other_truth] = position(u, 0);
    of_position.add(exactly(value) - truth, kProjectedSums * lost + kProjection);
    of_gap.add(exactly(value - other) - (truth - other_truth), kProjectedGap * lost + kProjectionGap);
  }
  of_position.expect_bounded(1.0 / 64);
  of_gap.expect_bounded(1.0 / 128);
}

TEST(WindowBounds, weights_and_coefficients) {
  oracles::Random random(13);
  ErrorFractions of_length, of_cross, coefficient;
  for (int k = 0; k < oracles::rounds(20000); ++k) {
    Rounded ax(random, 1), ay(random, 1), bx(random, 1), by(random, 1);
    const Rounded vx(random, 1), vy(random, 1), wx(random, 1), wy(random, 1);
    const double side = ax.value * (wy.value - vy.value) - ay.value * (wx.value - vx.value);
    coefficient.add(exactly(side) - (ax.exact * (wy.exact - vy.exact) - ay.exact * (wx.exact - vx.exact)),
                    kSideCoefficient * (ax.value + ay.value));
    if (k % 2 == 1)
      for (Rounded* stretched : {&ax, &ay, &bx, &by}) stretched->factors(random);
    of_length.add(exactly(ax.value) - ax.exact, kLengthWeight * ax.value);
    // A cross product and the three factors that it is multiplied with.
    const BigRational f = 1 + BigRational(random.below(1000), 1001), g = 1 + BigRational(random.below(1000), 1003);
    const double u = ax.value * by.value, v = ay.value * bx.value,
                 weight = std::abs(u - v) * exact::round_to_double(f) * exact::round_to_double(g);
    const BigRational exactly_weight = abs(BigRational(ax.exact * by.exact - ay.exact * bx.exact)) * f * g;
    of_cross.add(exactly(weight) - exactly_weight, kCrossWeight * (u + v) * exact::round_to_double(BigRational(f * g)));
  }
  for (const ErrorFractions& fractions : {of_length, of_cross, coefficient}) fractions.expect_bounded(1.0 / 32);
}

}  // namespace
}  // namespace dymsum::planar
