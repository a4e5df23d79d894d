// Elementary functions that round nearly always correctly, as C's functions of the same names of good C libraries do:
// for systems without one. Where the wrong one of two doubles is taken, the right one is nearer by less than 2^-20 of
// their distance. Special values are as in C.
#pragma once

namespace dymsum::base::elementary {

double sin(double x);
double cos(double x);
double tan(double x);
double asin(double x);
double acos(double x);
double atan(double x);
double atan2(double y, double x);
double hypot(double x, double y);

/// An angle of 2^30 and more as quarter turns, modulo 4, and the rest in two doubles; of the C library.
int quarters_of_far(double x, double* rest);

}  // namespace dymsum::base::elementary
