#include "io/number_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

#include "base/double_text.h"
#include "io/source.h"

namespace dymsum::io {

namespace {

/// Whether a decimal number whose value is outside the double range is too large, or else too small. The decimal
/// exponent of its first digit that is not zero decides; both limits are far from 10^0.
bool too_large(std::string_view digits) {
  std::int64_t exponent_of_digit = 0;  // of the current digit once the point is behind, counted from the point
  std::int64_t leading = 0;
  bool seen_point = false, seen_digit = false;
  std::size_t i = 0;
  for (; i < digits.size() && (is_digit(digits[i]) || digits[i] == '.' || digits[i] == '-'); ++i) {
    if (digits[i] == '-') continue;
    if (digits[i] == '.') {
      seen_point = true;
      continue;
    }
    if (seen_point) --exponent_of_digit;
    if (seen_digit && !seen_point) ++leading;
    if (!seen_digit && digits[i] != '0') {
      seen_digit = true;
      leading = exponent_of_digit;
    }
  }
  const bool negative = i + 1 < digits.size() && digits[i + 1] == '-';
  i += i + 1 < digits.size() && (digits[i + 1] == '-' || digits[i + 1] == '+') ? 2 : 1;
  const std::uint64_t magnitude = i < digits.size() ? scan_count(digits.substr(i)).value : 0;
  constexpr std::uint64_t kFar = std::uint64_t{1} << 62;
  const auto power = static_cast<std::int64_t>(magnitude < kFar ? magnitude : kFar);
  return (negative ? leading - power : leading + power) > 0;
}

}  // namespace

ScannedNumber scan_number(std::string_view text) {
  const std::size_t plus = text.size() > 1 && text[0] == '+' && (is_digit(text[1]) || text[1] == '.') ? 1 : 0;
  const char* const first = text.data() + plus;
  ScannedNumber number;
  const auto [end, error] = base::read_double(first, text.data() + text.size(), number.value);
  if (error == std::errc::invalid_argument) return {};
  number.length = static_cast<std::size_t>(end - text.data());
  if (error == std::errc::result_out_of_range) {
    const std::string_view used(first, static_cast<std::size_t>(end - first));
    number.value = too_large(used) ? std::numeric_limits<double>::infinity() : 0.0;
    if (used.front() == '-') number.value = -number.value;
  }
  return number;
}

ScannedCount scan_count(std::string_view text) {
  ScannedCount count;
  if (text.empty() || !is_digit(text[0])) return count;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count.value);
  if (error == std::errc::result_out_of_range) count.value = std::numeric_limits<std::uint64_t>::max();
  count.length = static_cast<std::size_t>(end - text.data());
  return count;
}

void append_number(std::string& out, double value) {
  std::array<char, 32> digits;  // the longest shortest double has 24 characters
  const double plain = value == 0 ? 0.0 : value;
  const char* const end = base::shortest_text(digits.data(), digits.data() + digits.size(), plain);
  out.append(digits.data(), static_cast<std::size_t>(end - digits.data()));
}

void append_rounded(std::string& out, double value, int decimals) {
  if (!std::isfinite(value) || std::fabs(value) >= 1e15) {
    append_number(out, std::isfinite(value) ? value : 0.0);
    return;
  }
  std::array<char, 48> digits;
  const char* end = base::fixed_text(digits.data(), digits.data() + digits.size(), value, decimals);
  if (decimals > 0) {
    while (end[-1] == '0') --end;
    if (end[-1] == '.') --end;
  }
  const std::string_view text(digits.data(), static_cast<std::size_t>(end - digits.data()));
  out += text == "-0" ? "0" : text;
}

std::string with_commas(std::uint64_t value) {
  std::string digits = std::to_string(value);
  for (std::size_t i = digits.size(); i > 3;) digits.insert(i -= 3, ",");
  return digits;
}

}  // namespace dymsum::io
