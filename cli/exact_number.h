// Coordinates that may be fractions.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "dymsum/rational.h"

namespace dymsum::cli {

/// A decimal number is the double that it is in files, a fraction 1/3 what it says; nothing for other text.
std::optional<Rational> exact_number(const std::string& text);

/// So many of these, between commas or else between blanks: x,y or x,y,z; nothing for other text.
std::optional<std::vector<Rational>> exact_numbers(const std::string& text, std::size_t count);
/// Two and three of them.
std::optional<RationalPoint> exact_position(const std::string& text);
std::optional<RationalPoint3> exact_position_in_space(const std::string& text);

/// Whether doubles hold it.
bool is_of_doubles(const RationalPoint& position);
bool is_of_doubles(const RationalPoint3& position);

/// The double that a number is: the nearest one to a decimal number, and a fraction that one is, as 1/4. Nothing for
/// other text, and for other fractions, as 1/3.
std::optional<double> double_number(const std::string& text);
/// "; 1/3 is no double" where a word between commas or blanks is a fraction that no double is; else nothing.
std::string no_double_in(const std::string& text);

/// Prints a number as it was given: a double, or a fraction that is no double.
void print_exact(std::ostream& out, const Rational& value);

}  // namespace dymsum::cli
