// Scales as the exact layer wants them.
#pragma once

#include "dymsum/scale.h"
#include "exact/big.h"

namespace dymsum::planar {

/// num / den in lowest terms, both positive.
struct ScaleValue {
  exact::BigInteger num = 1, den = 1;
  double approx = 1;
  friend bool operator==(const ScaleValue& a, const ScaleValue& b) { return a.num == b.num && a.den == b.den; }
};

ScaleValue scale_value(const Scale& scale);
/// The same for any rational; the limits of Scale are not checked. Requires value > 0.
ScaleValue scale_value(const exact::BigRational& value);
inline exact::BigRational rational(const ScaleValue& s) { return exact::BigRational(s.num, s.den); }

/// A rational strictly between a < b with a small denominator: the dyadic of fewest bits.
exact::BigRational simple_between(const exact::BigRational& a, const exact::BigRational& b);

}  // namespace dymsum::planar
