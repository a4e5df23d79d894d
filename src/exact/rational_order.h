// The order of rationals by one product each. Boost's own compares their continued fractions, which for equal or nearly
// equal ones go on to the end.
#pragma once

#include "exact/big.h"

namespace dymsum::exact {

/// The sign of a - b.
inline int compare(const BigRational& a, const BigRational& b) {
  const BigInteger &n = numerator(a), &m = numerator(b), &d = denominator(a), &e = denominator(b);
  return d == e ? n.compare(m) : BigInteger(n * e).compare(BigInteger(m * d));
}

}  // namespace dymsum::exact
