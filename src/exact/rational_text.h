// Rational numbers as people write them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "dymsum/result.h"
#include "exact/big.h"

namespace dymsum::exact {

inline constexpr unsigned kMaxTextBits = 4096;  ///< of numerators and denominators

/// "3/2", "1.01" or "1e-3", each exactly what it says; `what` names it in messages. Errors: malformed for anything
/// else; `code` for a denominator of zero and for texts much too long.
Result<BigRational> number_in(std::string_view text, std::string_view what, ErrorCode code,
                              std::size_t most_characters = 4 * kMaxTextBits);

}  // namespace dymsum::exact
