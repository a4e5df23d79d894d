#include "io/region/svg_numbers.h"

#include <algorithm>
#include <cmath>

#include "io/number_text.h"

namespace dymsum::io {

namespace {

std::string_view one_word(std::string_view text) { return text.substr(0, text.find_first_of(" \t\r\n,")); }

/// The offset at which a start tag's attribute value begins, counted from the tag's name; 0 when it is not found.
std::size_t offset_of_value(std::string_view tag, std::string_view name) {
  for (std::size_t i = 0; i < tag.size() && tag[i] != '>';) {
    const std::size_t equals = tag.find('=', i);
    const std::size_t open = equals == std::string_view::npos ? equals : tag.find_first_of("\"'", equals);
    if (open == std::string_view::npos) return 0;
    std::size_t end = equals;
    while (end > i && is_blank(tag[end - 1])) --end;
    const std::string_view before = tag.substr(i, end - i);
    const std::size_t start = before.size() - name.size();
    if (before.ends_with(name) && (start == 0 || is_blank(before[start - 1]))) return open + 1;
    const std::size_t close = tag.find(tag[open], open + 1);
    if (close == std::string_view::npos) return 0;
    i = close + 1;
  }
  return 0;
}

}  // namespace

void SvgNumbers::skip() {
  while (!at_end() && (is_blank(peek()) || peek() == ',')) ++at_;
}

bool SvgNumbers::at_number() {
  skip();
  return !at_end() && (is_digit(peek()) || peek() == '-' || peek() == '+' || peek() == '.');
}

double SvgNumbers::read() {
  skip();
  const ScannedNumber number = scan_number(rest());
  if (number.length == 0) fail("expected a number");
  if (!std::isfinite(number.value)) {
    fail_not_finite("the number " + in_quotes(one_word(rest())) + " is not a finite double");
  }
  at_ += number.length;
  return number.value;
}

bool SvgNumbers::read_flag() {
  skip();
  if (at_end() || (peek() != '0' && peek() != '1')) fail("expected a flag, 0 or 1");
  return text_.value[at_++] == '1';
}

void SvgNumbers::fail(const std::string& message) const {
  source_.fail_on_line(ErrorCode::malformed,
                       at_end() ? message + ", but the attribute ends" : message + " at " + in_quotes(one_word(rest())),
                       line());
}

void SvgNumbers::fail_before(const std::string& message) const {
  source_.fail_on_line(ErrorCode::malformed, message, line());
}

void SvgNumbers::fail_not_finite(const std::string& message) const {
  source_.fail_on_line(ErrorCode::not_finite, message, line());
}

std::int64_t SvgNumbers::line() const {
  const auto end = text_.value.begin() + static_cast<std::ptrdiff_t>(std::min(at_, text_.value.size()));
  const std::size_t start = text_.tag + offset_of_value(source_.text.substr(text_.tag), text_.name);
  return source_.line(start) + std::count(text_.value.begin(), end, '\n');
}

}  // namespace dymsum::io
