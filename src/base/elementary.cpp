// sin, cos, tan, atan, atan2, asin, acos and hypot in place of those of emscripten's C library, which are often one
// unit in the last place off: text would differ in its last digit from that of native builds, whose C library rounds
// nearly always correctly. Here they are computed with twice as many digits and rounded once.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/double_pair.h"

/// The C library's own: x less a multiple of a quarter turn, in two doubles, and that multiple.
extern "C" int __rem_pio2(double x, double* rest);

namespace dymsum::base {
namespace {

// Half of pi as three doubles without common digits: those below are the next 160 bits.
constexpr double kHalfPi = 0x1.921fb54442d18p+0, kHalfPi2 = 0x1.1a62633145c07p-54, kHalfPi3 = -0x1.f1976b7ed8fbcp-110;

struct SinCos {
  DoublePair sin, cos;
};

// Taylor's series of |r| <= pi / 4, up to r^27 / 27!: what is left out is below 2^-100 of the sum.
SinCos series(DoublePair r) {
  const DoublePair square = r * r;
  DoublePair sin{1, 0}, cos{1, 0};
  for (int n = 26; n >= 2; n -= 2) {
    const double d = n;
    sin = DoublePair{1, 0} - sin * square / DoublePair{d * (d + 1), 0};
    cos = DoublePair{1, 0} - cos * square / DoublePair{d * (d - 1), 0};
  }
  return {sin * r, cos};
}

// An angle in quarter turns and the rest.
struct Quarters {
  int count = 0;  // modulo 4
  DoublePair rest;
};
Quarters quarters(double x) {
  if (std::fabs(x) < 0x1p30) {
    const double k = std::nearbyint(x / kHalfPi);  // 31 bits
    const DoublePair near = DoublePair{x, 0} - exact_product(k, kHalfPi);
    return {static_cast<int>(static_cast<std::int64_t>(k) & 3),
            near - exact_product(k, kHalfPi2) - DoublePair{k * kHalfPi3, 0}};
  }
  std::array<double, 2> rest{};
  const int k = __rem_pio2(x, rest.data());
  return {k & 3, exact_sum(rest[0], rest[1])};
}

SinCos sin_cos(double x) {
  const Quarters angle = quarters(x);
  const SinCos of_r = series(angle.rest);
  switch (angle.count) {
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
  const SinCos s = sin_cos(angle);
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
}  // namespace dymsum::base

extern "C" {

double sin(double x) {
  if (!std::isfinite(x)) return x - x;
  return std::fabs(x) < 0x1p-27 ? x - x * x * x / 6 : dymsum::base::sin_cos(x).sin.high;
}
double cos(double x) {
  if (!std::isfinite(x)) return x - x;
  return dymsum::base::sin_cos(x).cos.high;
}
double tan(double x) {
  if (!std::isfinite(x)) return x - x;
  if (std::fabs(x) < 0x1p-27) return x + x * x * x / 3;
  const auto s = dymsum::base::sin_cos(x);
  return (s.sin / s.cos).high;
}
double atan2(double y, double x) { return dymsum::base::angle_of(y, x); }
double atan(double x) { return dymsum::base::angle_of(x, 1); }
double asin(double x) {
  if (!(std::fabs(x) <= 1)) return std::numeric_limits<double>::quiet_NaN();
  if (std::fabs(x) == 1) return std::copysign(dymsum::base::kHalfPi, x);
  if (std::fabs(x) < 0x1p-27) return x + x * x * x / 6;
  return dymsum::base::refined(static_cast<double>(std::asin(static_cast<float>(x))), {x, 0},
                               dymsum::base::cosine_of_sine(x));
}
double acos(double x) {
  if (!(std::fabs(x) <= 1)) return std::numeric_limits<double>::quiet_NaN();
  if (x == 1) return 0;
  if (x == -1) return 2 * dymsum::base::kHalfPi;
  return dymsum::base::refined(static_cast<double>(std::acos(static_cast<float>(x))), dymsum::base::cosine_of_sine(x),
                               {x, 0});
}
double hypot(double x, double y) {
  if (std::isinf(x) || std::isinf(y)) return std::numeric_limits<double>::infinity();
  const double most = std::fmax(std::fabs(x), std::fabs(y));
  if (most == 0 || std::isnan(x) || std::isnan(y)) return std::fabs(x) + std::fabs(y);
  const int size = std::ilogb(most);
  const double sx = std::scalbn(x, -size), sy = std::scalbn(y, -size);
  return std::scalbn(square_root(dymsum::base::exact_product(sx, sx) + dymsum::base::exact_product(sy, sy)).high, size);
}
}
