// In WebAssembly the functions of elementary.h have the names of C, and go before those of emscripten's C library: what
// the library computes with doubles is as in native builds, whose C library rounds nearly always correctly.
#include <cmath>

#include "base/elementary.h"

namespace elementary = dymsum::base::elementary;

/// The C library's own: x less a multiple of a quarter turn, in two doubles, and that multiple.
extern "C" int __rem_pio2(double x, double* rest);

namespace {

bool is_far(double x) { return std::isfinite(x) && std::fabs(x) >= 0x1p30; }
elementary::Angle far_angle(double x) {
  double rest[2];
  const int quarters = __rem_pio2(x, rest) & 3;
  return {quarters, dymsum::base::exact_sum(rest[0], rest[1])};
}

}  // namespace

extern "C" {

double sin(double x) { return is_far(x) ? elementary::sin(far_angle(x)) : elementary::sin(x); }
double cos(double x) { return is_far(x) ? elementary::cos(far_angle(x)) : elementary::cos(x); }
double tan(double x) { return is_far(x) ? elementary::tan(far_angle(x)) : elementary::tan(x); }
double asin(double x) { return elementary::asin(x); }
double acos(double x) { return elementary::acos(x); }
double atan(double x) { return elementary::atan(x); }
double atan2(double y, double x) { return elementary::atan2(y, x); }
double hypot(double x, double y) { return elementary::hypot(x, y); }
}
