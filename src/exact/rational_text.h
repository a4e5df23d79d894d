// Rational numbers as people write them.
#pragma once

#include <string>
#include <string_view>

#include "dymsum/result.h"
#include "exact/big.h"

namespace dymsum::exact {

inline constexpr unsigned kMaxTextBits = 4096;  ///< of numerators and denominators

/// The number; `what` names it in messages. Errors: malformed when num or den are no integers; `code` for a denominator
/// of zero and for numbers much too long.
Result<BigRational> rational_of(const Rational& value, std::string_view what, Code code);
/// "3/2", "1.01" or "1e-3", each exactly what it says. Errors as above.
Result<BigRational> number_in(std::string_view text, std::string_view what, Code code);

}  // namespace dymsum::exact
