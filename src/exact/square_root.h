// Square roots of exact numbers, rounded once.
#pragma once

#include "exact/big.h"

namespace dymsum::exact {

/// The double nearest to the square root of v, ties to even, also where v itself is no double: as small or as large as
/// it likes. Infinite past the range of doubles. Requires v >= 0.
double root_to_double(const BigRational& v);

/// The largest r with r^2 <= n, and rest = n - r^2. Requires n >= 0. A few divisions of n's length.
BigInteger floor_root(const BigInteger& n, BigInteger& rest);

}  // namespace dymsum::exact
