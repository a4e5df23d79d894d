// Square roots of exact numbers, rounded once.
#pragma once

#include "exact/big.h"

namespace dymsum::exact {

/// The double nearest to the square root of v, ties to even, also where v itself is no double: as small or as large as
/// it likes. Infinite past the range of doubles. Requires v >= 0.
double root_to_double(const BigRational& v);

}  // namespace dymsum::exact
