// Exact rationals as decimal numbers of a given length.
#pragma once

#include <string>

#include "exact/big.h"

namespace dymsum::exact {

/// v with `digits` significant digits, rounded half to even, and an exponent of two digits or more, as "%.16e" prints
/// doubles: "-1.25e+400"; "0" for zero. Requires digits >= 1.
std::string decimal_text(const BigRational& v, int digits);

}  // namespace dymsum::exact
