#include "io/source.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>
#include <utility>

#include "base/double_text.h"

namespace dymsum::io {

std::int64_t Source::line(std::size_t offset) const {
  std::size_t last = text.size();
  while (last > 0 && is_blank(text[last - 1])) --last;
  const std::size_t end = std::min(offset, last > 0 ? last - 1 : 0);
  return 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end), '\n');
}

void Source::fail(ErrorCode code, std::string message, std::size_t offset, Evidence evidence) const {
  fail_on_line(code, std::move(message), line(offset), std::move(evidence));
}

void Source::fail_in_bytes(ErrorCode code, std::string message) const {
  Evidence evidence;
  evidence.file = file;
  throw ReadFailure{Error{code, std::move(message), std::move(evidence)}};
}

void Source::fail_on_line(ErrorCode code, std::string message, std::int64_t line, Evidence evidence) const {
  evidence.file = file;
  evidence.line = line;
  throw ReadFailure{Error{code, std::move(message), std::move(evidence)}};
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 24;
  std::string out = "'";
  for (const char c : text.substr(0, kLongest)) out += c >= ' ' && c <= '~' ? c : '?';
  if (text.size() > kLongest) out += "...";
  return out + "'";
}

void Words::skip_blanks(bool stay_on_line) {
  const std::string_view text = source_.text;
  for (; at_ < text.size(); ++at_) {
    const char c = text[at_];
    if (comments_ && c == '#') {
      at_ = std::min(text.find('\n', at_), text.size());
      if (at_ == text.size()) return;
    }
    if (const std::size_t joint = joint_at(at_)) {
      at_ += joint - 1;
      continue;
    }
    if (!is_blank(text[at_]) || (stay_on_line && text[at_] == '\n')) return;
  }
}

std::size_t Words::joint_at(std::size_t offset) const {
  if (!continued_ || source_.text[offset] != '\\') return 0;
  const std::string_view rest = source_.text.substr(offset + 1, 2);
  return rest.starts_with('\n') ? 2 : rest == "\r\n" ? 3 : 0;
}

bool Words::at_end() {
  skip_blanks(false);
  return at_ >= source_.text.size();
}

bool Words::at_line_end() {
  skip_blanks(true);
  return at_ >= source_.text.size() || source_.text[at_] == '\n';
}

void Words::skip_line() {
  while (!at_line_end()) {
    const std::string_view word = peek();
    at_ += word.size();
  }
  at_ = std::min(at_ + 1, source_.text.size());
}

std::string_view Words::peek() {
  if (at_end()) return {};
  std::size_t end = at_;
  const std::string_view text = source_.text;
  while (end < text.size() && !is_blank(text[end]) && !(comments_ && text[end] == '#') && joint_at(end) == 0) ++end;
  return text.substr(at_, end - at_);
}

std::string_view Words::take(const std::string& what) {
  const std::string_view word = peek();
  if (word.empty()) fail(ErrorCode::truncated, "the file ends before " + what);
  at_ += word.size();
  return word;
}

void Words::expect(std::string_view keyword) {
  const std::string_view word = take("'" + std::string(keyword) + "'");
  if (same_word(word, keyword)) return;
  at_ -= word.size();
  fail(ErrorCode::malformed, "expected '" + std::string(keyword) + "' instead of " + in_quotes(word));
}

double Words::number(const std::string& what, const Evidence& evidence) {
  if (at_end()) fail(ErrorCode::truncated, "the file ends before " + what, evidence);
  const std::string_view word = peek();
  const ScannedNumber scanned = scan_number(word);
  if (scanned.length == 0 || scanned.length != word.size()) {
    fail(ErrorCode::malformed, "expected " + what + " instead of " + in_quotes(word), evidence);
  }
  at_ += word.size();
  return scanned.value;
}

double Words::coordinate(const Evidence& evidence) {
  const double value = number("a coordinate", evidence);
  if (std::isfinite(value)) return value;
  fail_at(at_ - 1, ErrorCode::not_finite, "a coordinate is not a finite double", evidence);
}

std::uint64_t Words::count(const std::string& what, const Evidence& evidence) {
  if (at_end()) fail(ErrorCode::truncated, "the file ends before " + what, evidence);
  const std::string_view word = peek();
  const ScannedCount scanned = scan_count(word);
  if (scanned.length == 0 || scanned.length != word.size()) {
    fail(ErrorCode::malformed, "expected " + what + " instead of " + in_quotes(word), evidence);
  }
  at_ += word.size();
  return scanned.value;
}

std::uint32_t Words::index(std::uint64_t vertices, Evidence evidence) {
  const std::string_view word = peek();
  const std::uint64_t value = count("the index of a vertex", evidence);
  if (value < std::min<std::uint64_t>(vertices, UINT32_MAX)) return static_cast<std::uint32_t>(value);
  if (value <= std::uint64_t{std::numeric_limits<std::int64_t>::max()})
    evidence.vertex = static_cast<std::int64_t>(value);
  fail_at(at_ - 1, ErrorCode::bad_index, "a face names a vertex that does not exist: " + in_quotes(word),
          std::move(evidence));
}

void Words::fail(ErrorCode code, std::string message, Evidence evidence) const {
  fail_at(at_, code, std::move(message), std::move(evidence));
}

void Words::fail_at(std::size_t offset, ErrorCode code, std::string message, Evidence evidence) const {
  source_.fail(code, std::move(message), offset, std::move(evidence));
}

bool same_word(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return upper(x) == upper(y); });
}

Evidence at_face(std::size_t face) {
  Evidence evidence;
  evidence.face = static_cast<std::int64_t>(face);
  return evidence;
}

Evidence at_vertex(std::size_t vertex) {
  Evidence evidence;
  evidence.vertex = static_cast<std::int64_t>(vertex);
  return evidence;
}

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
