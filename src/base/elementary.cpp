#include "base/elementary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace dymsum::base::elementary {
namespace {

// Half of pi as three doubles without common digits: those below are the next 160 bits.
constexpr double kHalfPi = 0x1.921fb54442d18p+0, kHalfPi2 = 0x1.1a62633145c07p-54, kHalfPi3 = -0x1.f1976b7ed8fbcp-110;

// What sine, tangent and their inverses of smaller ones add is below a fifth of the last place.
constexpr double kTiny = 0x1p-27;

struct SinCos {
  DoublePair sin, cos;
};

// Taylor's coefficients of sin(r) / r and cos(r) as polynomials of r^2, from that of r^2 on. With r^2 < 0.617 the terms
// that doubles hold are below 2^-27 of the sum, and so are off by less than 2^-79 of it; what is left out is below
// 2^-82.
constexpr std::array<DoublePair, 4> kSin{{{-0x1.5555555555555p-3, -0x1.5555555555555p-57},
                                          {0x1.1111111111111p-7, 0x1.1111111111111p-63},
                                          {-0x1.a01a01a01a01ap-13, -0x1.a01a01a01a01ap-73},
                                          {0x1.71de3a556c734p-19, -0x1.c154f8ddc6c00p-73}}};
constexpr std::array<double, 6> kSinEnd{-0x1.ae64567f544e4p-26, 0x1.6124613a86d09p-33,  -0x1.ae7f3e733b81fp-41,
                                        0x1.952c77030ad4ap-49,  -0x1.2f49b46814157p-57, 0x1.71b8ef6dcf572p-66};
constexpr std::array<DoublePair, 4> kCos{{{-0x1.0000000000000p-1, 0},
                                          {0x1.5555555555555p-5, 0x1.5555555555555p-59},
                                          {-0x1.6c16c16c16c17p-10, 0x1.f49f49f49f49fp-65},
                                          {0x1.a01a01a01a01ap-16, 0x1.a01a01a01a01ap-76}}};
constexpr std::array<double, 6> kCosEnd{-0x1.27e4fb7789f5cp-22, 0x1.1eed8eff8d898p-29,  -0x1.93974a8c07c9dp-37,
                                        0x1.ae7f3e733b81fp-45,  -0x1.6827863b97d97p-53, 0x1.e542ba4020225p-62};

/// 1 + square (first[0] + square (first[1] + ...)), the last ones in doubles.
DoublePair series(DoublePair square, const std::array<DoublePair, 4>& first, const std::array<double, 6>& end) {
  double tail = 0;
  for (auto c = end.rbegin(); c != end.rend(); ++c) tail = tail * square.high + *c;
  DoublePair sum{tail, 0};
  for (auto c = first.rbegin(); c != first.rend(); ++c) sum = *c + sum * square;
  return DoublePair{1, 0} + sum * square;
}

/// The sine and cosine of |r| <= pi / 4.
SinCos near_zero(DoublePair r) {
  const DoublePair square = r * r;
  return {series(square, kSin, kSinEnd) * r, series(square, kCos, kCosEnd)};
}

// Requires |x| < 2^30.
Angle angle(double x) {
  const double k = std::nearbyint(x / kHalfPi);  // 31 bits
  const DoublePair near = DoublePair{x, 0} - exact_product(k, kHalfPi);
  return {static_cast<int>(static_cast<std::int64_t>(k) & 3),
          near - exact_product(k, kHalfPi2) - DoublePair{k * kHalfPi3, 0}};
}

SinCos sin_cos(const Angle& angle) {
  const SinCos of_r = near_zero(angle.rest);
  switch (angle.quarters) {
    case 0:
      return of_r;
    case 1:
      return {of_r.cos, -of_r.sin};
    case 2:
      return {-of_r.sin, -of_r.cos};
    default:
      return {-of_r.cos, of_r.sin};
  }
}

// The angle whose sine and cosine have the ratio y : x, from one that is off by about 2^-22.
double refined(double angle, DoublePair y, DoublePair x) {
  const SinCos s = sin_cos(elementary::angle(angle));
  const DoublePair tan = (y * s.cos - x * s.sin) / (x * s.cos + y * s.sin);
  const double t = tan.high, t3 = t * t * t;
  const DoublePair sum = DoublePair{angle, 0} + tan + DoublePair{-t3 / 3 + t3 * t * t / 5, 0};
  return sum.high;
}

double angle_of(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return x + y;
  const double half = std::signbit(y) ? -kHalfPi : kHalfPi;
  if (std::isinf(x) && std::isinf(y)) return x > 0 ? half / 2 : half + half / 2;
  if (y == 0 || std::isinf(x)) return std::signbit(x) ? 2 * half : std::copysign(0.0, y);
  if (x == 0 || std::isinf(y)) return half;
  const int size = std::ilogb(std::max(std::fabs(x), std::fabs(y)));
  const double sx = std::scalbn(x, -size), sy = std::scalbn(y, -size);
  if (x > 0 && std::fabs(sy) < 0x1p-60) return y / x;
  return refined(static_cast<double>(std::atan2(static_cast<float>(sy), static_cast<float>(sx))), {sy, 0}, {sx, 0});
}

// 1 - v^2 without loss near 1.
DoublePair cosine_of_sine(double v) { return square_root(exact_sum(1, -v) * exact_sum(1, v)); }

}  // namespace

double sin(const Angle& angle) { return sin_cos(angle).sin.high; }
double cos(const Angle& angle) { return sin_cos(angle).cos.high; }
double tan(const Angle& angle) {
  const SinCos s = sin_cos(angle);
  return (s.sin / s.cos).high;
}

double sin(double x) {
  if (!std::isfinite(x)) return x - x;
  return std::fabs(x) < kTiny ? x : sin(angle(x));
}
double cos(double x) { return std::isfinite(x) ? cos(angle(x)) : x - x; }
double tan(double x) {
  if (!std::isfinite(x)) return x - x;
  return std::fabs(x) < kTiny ? x : tan(angle(x));
}
double atan2(double y, double x) { return angle_of(y, x); }
double atan(double x) { return angle_of(x, 1); }
double asin(double x) {
  if (!(std::fabs(x) <= 1)) return std::numeric_limits<double>::quiet_NaN();
  if (std::fabs(x) == 1) return std::copysign(kHalfPi, x);
  if (std::fabs(x) < kTiny) return x;
  return refined(static_cast<double>(std::asin(static_cast<float>(x))), {x, 0}, cosine_of_sine(x));
}
double acos(double x) {
  if (!(std::fabs(x) <= 1)) return std::numeric_limits<double>::quiet_NaN();
  if (x == 1) return 0;
  if (x == -1) return 2 * kHalfPi;
  return refined(static_cast<double>(std::acos(static_cast<float>(x))), cosine_of_sine(x), {x, 0});
}
double hypot(double x, double y) {
  if (std::isinf(x) || std::isinf(y)) return std::numeric_limits<double>::infinity();
  const double most = std::fmax(std::fabs(x), std::fabs(y));
  if (most == 0 || std::isnan(x) || std::isnan(y)) return std::fabs(x) + std::fabs(y);
  const int size = std::ilogb(most);
  const double sx = std::scalbn(x, -size), sy = std::scalbn(y, -size);
  return std::scalbn(square_root(exact_product(sx, sx) + exact_product(sy, sy)).high, size);
}
}  // namespace dymsum::base::elementary
