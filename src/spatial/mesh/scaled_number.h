// A double and a power of two: measures that may lie outside the range of doubles.
#pragma once

#include <cmath>
#include <cstdlib>
#include <string>

#include "exact/big.h"
#include "exact/rational_text.h"

namespace dymsum::spatial {

struct ScaledNumber {
  double value = 0;
  int exponent = 0;

  /// The nearest double, where the value is not subnormal.
  double nearest() const { return std::ldexp(value, exponent); }
  /// 17 digits.
  std::string text() const {
    const exact::BigInteger power = exact::BigInteger(1) << static_cast<unsigned>(std::abs(exponent));
    const exact::BigRational v = exact::exact_value(value);
    return exact::decimal_text(exponent < 0 ? exact::BigRational(v / power) : exact::BigRational(v * power), 17);
  }
};

}  // namespace dymsum::spatial
