// Numbers as text: read correctly rounded, written with the fewest digits that read back; independent of the locale.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace dymsum::io {

struct ScannedNumber {
  double value = 0;        ///< nearest double; infinite past the double range, infinite or NaN where the text says so
  std::size_t length = 0;  ///< characters used; 0 where no number starts
};

/// The longest decimal number (or inf, infinity, nan) at the start of a text; one leading '+' is allowed.
ScannedNumber scan_number(std::string_view text);

struct ScannedCount {
  std::uint64_t value = 0;  ///< the largest 64-bit value where the digits say more
  std::size_t length = 0;
};

/// The digits at the start of a text.
ScannedCount scan_count(std::string_view text);

/// Appends the shortest text that reads back to the same double (0 for both zeros). Requires: finite.
void append_number(std::string& out, double value);

/// Appends a value rounded to at most `decimals` decimals, without trailing zeros: for pictures.
void append_rounded(std::string& out, double value, int decimals);

/// 1234567 as "1,234,567".
std::string with_commas(std::uint64_t value);

}  // namespace dymsum::io
