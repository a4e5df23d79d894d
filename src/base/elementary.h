// Elementary functions that are the same everywhere: computed with a few digits more and rounded once, to the nearest
// double but for ties within 2^-20 of a unit in the last place. Those of C libraries are often a unit off, each its own
// one, and text that is made of them differs in its last digit. Special values are as in C. A tenth of a microsecond
// each.
#pragma once

#include "base/doubles.h"

namespace dymsum::base::elementary {

/// Requires |x| < 2^30, or x infinite or not a number.
double sin(double x);
double cos(double x);
double tan(double x);

double asin(double x);
double acos(double x);
double atan(double x);
double atan2(double y, double x);
double hypot(double x, double y);

/// Quarter turns, modulo 4, and the rest: at most an eighth of a turn.
struct Angle {
  int quarters = 0;
  DoublePair rest;
};
double sin(const Angle& angle);
double cos(const Angle& angle);
double tan(const Angle& angle);

}  // namespace dymsum::base::elementary
