#include "io/words.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "io/number_text.h"

namespace dymsum::io {

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

}  // namespace dymsum::io
