#include "base/double_text.h"

#include <cstdio>
#include <version>

#ifndef __cpp_lib_to_chars
#include <fast_float/fast_float.h>
#define FMT_HEADER_ONLY
#include <fmt/compile.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>
#include <system_error>
#endif

namespace dymsum::base {

std::string general_text(double value, int digits) {
  char text[64];  // a sign, a point, an exponent of 5 characters, and the digits
  return std::string(text, static_cast<std::size_t>(std::snprintf(text, sizeof text, "%.*g", digits, value)));
}

#ifdef __cpp_lib_to_chars

char* shortest_text(char* first, char* last, double value) { return std::to_chars(first, last, value).ptr; }

char* fixed_text(char* first, char* last, double value, int decimals) {
  return std::to_chars(first, last, value, std::chars_format::fixed, decimals).ptr;
}

std::from_chars_result read_double(const char* first, const char* last, double& value) {
  return std::from_chars(first, last, value);
}

#else
namespace {

/// The shortest decimal d1 d2 ... dn 10^exponent, d1 not zero but for zero itself.
struct Decimal {
  std::string digits;
  int exponent = 0;
};

/// {fmt} finds the digits, and writes them in its own way: "0.001", "1e-05", "1.5e+20".
Decimal shortest_decimal(double magnitude) {
  char text[32];
  const char* const end = fmt::format_to(text, FMT_COMPILE("{}"), magnitude);
  const char* const e = std::find(static_cast<const char*>(text), end, 'e');
  const char* const point = std::find(static_cast<const char*>(text), e, '.');
  Decimal decimal;
  decimal.digits.assign(static_cast<const char*>(text), point);
  if (point != e) decimal.digits.append(point + 1, e);
  if (e != end) std::from_chars(e + (e[1] == '+' ? 2 : 1), end, decimal.exponent);
  if (point != e) decimal.exponent -= static_cast<int>(e - point) - 1;
  decimal.digits.erase(0, std::min(decimal.digits.find_first_not_of('0'), decimal.digits.size() - 1));
  while (decimal.digits.size() > 1 && decimal.digits.back() == '0') {
    decimal.digits.pop_back();
    ++decimal.exponent;
  }
  if (decimal.digits == "0") decimal.exponent = 0;
  return decimal;
}

std::string scientific(const Decimal& decimal) {
  std::string text = decimal.digits.substr(0, 1);
  if (decimal.digits.size() > 1) text += '.' + decimal.digits.substr(1);
  const int exponent = decimal.exponent + static_cast<int>(decimal.digits.size()) - 1;
  text += exponent < 0 ? "e-" : "e+";
  if (std::abs(exponent) < 10) text += '0';
  return text + std::to_string(std::abs(exponent));
}

/// Whole numbers with all their digits, as they are: zeros behind the shortest ones would name another number.
std::string plain(const Decimal& decimal, double magnitude) {
  const int n = static_cast<int>(decimal.digits.size()), before = n + decimal.exponent;
  if (decimal.exponent >= 0) {
    char text[320];
    return std::string(text, static_cast<std::size_t>(std::snprintf(text, sizeof text, "%.0f", magnitude)));
  }
  if (before <= 0) return "0." + std::string(static_cast<std::size_t>(-before), '0') + decimal.digits;
  return decimal.digits.substr(0, static_cast<std::size_t>(before)) + '.' +
         decimal.digits.substr(static_cast<std::size_t>(before));
}

std::string shortest_text(double value) {
  const std::string sign = std::signbit(value) ? "-" : "";
  const double magnitude = std::fabs(value);
  if (!std::isfinite(value)) return sign + (std::isnan(value) ? "nan" : "inf");
  const Decimal decimal = shortest_decimal(magnitude);
  const int n = static_cast<int>(decimal.digits.size());
  const int plain_size = decimal.exponent >= 0      ? n + decimal.exponent
                         : n + decimal.exponent > 0 ? n + 1
                                                    : 2 - decimal.exponent;
  const std::string with_exponent = scientific(decimal);
  return sign + (plain_size <= static_cast<int>(with_exponent.size()) ? plain(decimal, magnitude) : with_exponent);
}

}  // namespace

char* shortest_text(char* first, char*, double value) {
  const std::string text = shortest_text(value);
  return std::copy(text.begin(), text.end(), first);
}

char* fixed_text(char* first, char* last, double value, int decimals) {
  return first + std::snprintf(first, static_cast<std::size_t>(last - first), "%.*f", decimals, value);
}

std::from_chars_result read_double(const char* first, const char* last, double& value) {
  double read = 0;
  const fast_float::from_chars_result result = fast_float::from_chars(first, last, read);
  if (result.ec != std::errc()) return {result.ptr, result.ec};
  // Out of range: this version of fast_float gives infinity, and zero, instead of an error.
  const std::string_view used(first, static_cast<std::size_t>(result.ptr - first));
  const std::string_view number = used.substr(0, std::min(used.find_first_of("eE"), used.size()));
  const bool has_digit = number.find_first_of("123456789") != std::string_view::npos;
  const bool is_number = number.find_first_of("0123456789") != std::string_view::npos;
  if ((std::isinf(read) && is_number) || (read == 0 && has_digit)) return {result.ptr, std::errc::result_out_of_range};
  value = read;
  return {result.ptr, std::errc()};
}

#endif

}  // namespace dymsum::base
