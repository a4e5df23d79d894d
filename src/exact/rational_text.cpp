#include "exact/rational_text.h"

#include <algorithm>
#include <cctype>
#include <optional>

namespace dymsum::exact {
namespace {

bool is_integer(std::string_view text) {
  if (text.starts_with('-')) text.remove_prefix(1);
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

// Boost reads a leading 0 as octal.
BigInteger integer(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative) text.remove_prefix(1);
  text.remove_prefix(std::min(text.find_first_not_of('0'), text.size() - 1));
  const BigInteger magnitude{std::string(text)};
  return negative ? BigInteger(-magnitude) : magnitude;
}

Result<BigRational> quotient(std::string_view num, std::string_view den, const std::string& name, ErrorCode code) {
  const std::string text = (std::string(num) + "/" + std::string(den)).substr(0, 60);
  if (!is_integer(num) || !is_integer(den))
    return Error{ErrorCode::malformed, "a " + name + " has to be a quotient of integers: " + text, {}};
  const BigInteger d = integer(den);
  if (d == 0) return Error{code, "a " + name + " with denominator zero: " + text, {}};
  return ratio(Big(integer(num)), Big(d));
}

/// digits[.digits][e[sign]digits] as a rational.
std::optional<BigRational> decimal(std::string_view text) {
  BigInteger mantissa = 0;
  long exponent = 0;
  bool negative = false, any = false, point = false;
  std::size_t i = 0;
  if (i < text.size() && (text[i] == '-' || text[i] == '+')) negative = text[i++] == '-';
  for (; i < text.size(); ++i) {
    if (text[i] == '.' && !point) {
      point = true;
    } else if (std::isdigit(static_cast<unsigned char>(text[i]))) {
      mantissa = mantissa * 10 + (text[i] - '0');
      exponent -= point;
      any = true;
    } else {
      break;
    }
  }
  if (!any) return std::nullopt;
  if (i < text.size()) {
    if (text[i] != 'e' && text[i] != 'E') return std::nullopt;
    const std::string digits(text.substr(i + 1 + (i + 1 < text.size() && text[i + 1] == '+')));
    if (!is_integer(digits) || digits.size() > 6) return std::nullopt;
    exponent += std::stol(digits);
  }
  if (std::abs(exponent) > 5000) return std::nullopt;
  const BigInteger power = boost::multiprecision::pow(BigInteger(10), static_cast<unsigned>(std::abs(exponent)));
  BigRational value = exponent >= 0 ? BigRational(BigInteger(mantissa * power)) : BigRational(mantissa, power);
  if (negative) value = -value;
  return value;
}

}  // namespace

Result<BigRational> number_in(std::string_view text, std::string_view what, ErrorCode code,
                              std::size_t most_characters) {
  const std::string name(what);
  if (text.size() > most_characters)
    return Error{code, "numerator and denominator of a " + name + " may have at most 4096 bits", {}};
  if (const std::size_t slash = text.find('/'); slash != std::string_view::npos)
    return quotient(text.substr(0, slash), text.substr(slash + 1), name, code);
  const std::optional<BigRational> value = decimal(text);
  if (!value) return Error{ErrorCode::malformed, "not a " + name + ": \"" + std::string(text.substr(0, 60)) + "\"", {}};
  return *value;
}

}  // namespace dymsum::exact
