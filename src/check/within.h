// What distances with bounds come to against a tolerance.
#pragma once

#include <cmath>

#include "dymsum/set_check.h"

namespace dymsum::check {

/// Whether the distance is at most that: of an excess in the plane or in space.
template <class Excess>
CheckVerdict within(const Excess& excess, const Rational& tolerance) {
  if (tolerance.sign() < 0 || std::isinf(excess.distance) || excess.squared > tolerance * tolerance)
    return CheckVerdict::wrong;
  if (excess.exact) return CheckVerdict::right;
  const bool near = std::isfinite(excess.at_most) && *Rational::of(excess.at_most) <= tolerance;
  return near ? CheckVerdict::right : CheckVerdict::undecided;
}

/// Right where both are, wrong where one is.
inline CheckVerdict both(CheckVerdict a, CheckVerdict b) {
  if (a == CheckVerdict::wrong || b == CheckVerdict::wrong) return CheckVerdict::wrong;
  return a == CheckVerdict::right && b == CheckVerdict::right ? CheckVerdict::right : CheckVerdict::undecided;
}

}  // namespace dymsum::check
