// Exact numbers as text and of text: fractions, decimals.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "dymsum/result.h"
#include "exact/big.h"

namespace dymsum::exact {

// Exact rationals as decimal numbers of a given length.

/// v with `digits` significant digits, rounded half to even, and an exponent of two digits or more, as "%.16e" prints
/// doubles: "-1.25e+400"; "0" for zero. Requires digits >= 1.
std::string decimal_text(const BigRational& v, int digits);

// Rational numbers as people write them.

inline constexpr unsigned kMaxTextBits = 4096;  ///< of numerators and denominators

/// "3/2", "1.01" or "1e-3", each exactly what it says; `what` names it in messages. Errors: malformed for anything
/// else; `code` for a denominator of zero and for texts much too long.
Result<BigRational> number_in(std::string_view text, std::string_view what, ErrorCode code,
                              std::size_t most_characters = 4 * kMaxTextBits);

}  // namespace dymsum::exact
