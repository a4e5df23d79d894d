// Coordinates that may be fractions.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>

#include "dymsum/rational.h"

namespace dymsum::cli {

/// A decimal number is the double that it is in files, a fraction 1/3 what it says; nothing for other text.
std::optional<Rational> exact_number(const std::string& text);

/// As it was asked: a double, or the fraction that no double is.
void print_exact(std::ostream& out, const Rational& value);

}  // namespace dymsum::cli
