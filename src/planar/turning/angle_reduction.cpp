#include "planar/turning/angle_reduction.h"

#include <array>
#include <cmath>
#include <numbers>

#include "exact/big.h"

namespace dymsum::planar {
namespace {

using exact::BigInteger;
using exact::BigRational;

// Angles are integers of steps of 2^-kBits. The largest double is less than 2^1024 quarter turns, and a quarter turn is
// known to one step: a reduced angle is known to 2^-128.
constexpr unsigned kBits = 1152, kGuard = 16;

// atan(1 / n) in steps of 2^-(kBits + kGuard): fewer than 2^9 terms, each cut off by less than two steps.
BigInteger arc_tangent_of_inverse(unsigned n) {
  BigInteger power = (BigInteger(1) << (kBits + kGuard)) / n, sum = power;
  for (unsigned k = 3; power != 0; k += 2) {
    power /= n * n;
    const BigInteger term = power / k;
    if (k % 4 == 3) sum -= term;
    else sum += term;
  }
  return sum;
}

// pi / 2 within a step; Machin: pi / 4 = 4 atan(1 / 5) - atan(1 / 239). 10 * 2^10 steps of the guard are less than 1.
const BigInteger& quarter_turn() {
  static const BigInteger quarter =
      BigInteger(8 * arc_tangent_of_inverse(5) - 2 * arc_tangent_of_inverse(239)) >> kGuard;
  return quarter;
}

// The steps below a positive angle: less than one is lost.
BigInteger steps_of(const BigRational& radians) { return (numerator(radians) << kBits) / denominator(radians); }

// What rounds to -pi is pi.
double rounded(const BigRational& theta) {
  const double nearest = exact::round_to_double(theta);
  return nearest == -std::numbers::pi ? std::numbers::pi : nearest;
}

constexpr std::array<double, 4> kQuarters{0, std::numbers::pi / 2, std::numbers::pi, -std::numbers::pi / 2};

}  // namespace

double reduced_angle(double radians) {
  if (std::abs(radians) <= std::numbers::pi) return radians == -std::numbers::pi ? std::numbers::pi : radians;
  return reduced_angle(exact::exact_value(radians));
}

double reduced_angle(const BigRational& radians) {
  static const BigRational half = exact::exact_value(std::numbers::pi);
  const BigRational magnitude = abs(radians);
  if (magnitude <= half) return rounded(radians);
  const BigInteger &quarter = quarter_turn(), steps = steps_of(magnitude);
  const BigInteger count = (2 * steps + quarter) / (2 * quarter), rest = steps - count * quarter;
  const int turned = static_cast<int>(BigInteger(count % 4)), sign = radians.sign();
  if (abs(rest) <= BigInteger(1) << (kBits - 50)) return kQuarters[static_cast<std::size_t>((4 + sign * turned) % 4)];
  const int quarters = turned == 3 || (turned == 2 && rest > 0) ? turned - 4 : turned;
  const BigInteger theta = sign * (quarters * quarter + rest);
  return rounded(BigRational(theta, BigInteger(1) << kBits));
}

double reduced_degrees(const BigRational& degrees) {
  const BigInteger whole = 360 * denominator(degrees);
  BigInteger rest = numerator(degrees) % whole;  // of the sign of the angle
  if (2 * rest > whole) rest -= whole;
  if (2 * rest <= -whole) rest += whole;
  const BigInteger quarters = 4 * rest;
  if (quarters % whole == 0) return kQuarters[static_cast<std::size_t>((4 + static_cast<int>(quarters / whole)) % 4)];
  return rounded(BigRational(quarters * quarter_turn(), whole << kBits));
}

}  // namespace dymsum::planar
