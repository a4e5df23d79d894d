// The functions of elementary.h under the names of C, which go before those of emscripten's C library.
#include "base/elementary.h"

namespace elementary = dymsum::base::elementary;

extern "C" {

/// The C library's own: x less a multiple of a quarter turn, in two doubles, and that multiple.
int __rem_pio2(double x, double* rest);

double sin(double x) { return elementary::sin(x); }
double cos(double x) { return elementary::cos(x); }
double tan(double x) { return elementary::tan(x); }
double asin(double x) { return elementary::asin(x); }
double acos(double x) { return elementary::acos(x); }
double atan(double x) { return elementary::atan(x); }
double atan2(double y, double x) { return elementary::atan2(y, x); }
double hypot(double x, double y) { return elementary::hypot(x, y); }
}

int elementary::quarters_of_far(double x, double* rest) { return __rem_pio2(x, rest) & 3; }
