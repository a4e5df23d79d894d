// Doubles as text and back: std::to_chars and std::from_chars, or what stands in for them where the standard library
// has these for integers only. The text is the same.
#pragma once

#include <charconv>
#include <string>

namespace dymsum::base {

/// The function std::to_chars(first, last, value), which returns the end of the text: the fewest digits that read back,
/// plain or with an exponent, whichever is shorter. Requires 32 characters of room.
char* shortest_text(char* first, char* last, double value);

/// The function std::to_chars with std::chars_format::fixed. Requires room for it.
char* fixed_text(char* first, char* last, double value, int decimals);

/// The text of printf's %.*g and of streams of that precision, which are a tenth of a page's module where one is used.
std::string general_text(double value, int digits);

/// The function std::from_chars.
std::from_chars_result read_double(const char* first, const char* last, double& value);

}  // namespace dymsum::base
