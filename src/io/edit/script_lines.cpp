#include "io/edit/script_lines.h"

#include <cmath>
#include <limits>

#include "dymsum/rational.h"
#include "io/read_file.h"
#include "io/source.h"

namespace dymsum::io {

ScriptLine::ScriptLine(std::string_view text, std::string_view file, std::int64_t line) : file_(file), line_(line) {
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at;
    while (end < text.size() && !is_blank(text[end])) ++end;
    if (end > at) words_.push_back(text.substr(at, end - at));
    at = end + 1;
  }
}

void ScriptLine::fail(const std::string& message) const {
  Error error{ErrorCode::malformed, message, {}};
  error.evidence.file = file_, error.evidence.line = line_;
  throw ReadFailure{std::move(error)};
}

std::string_view ScriptLine::take(const std::string& what) {
  if (at_end()) fail("the line ends before " + what);
  return words_[next_++];
}

MovingOperand ScriptLine::operand() {
  const std::string_view word = take("an operand");
  if (word == "p") return MovingOperand::p;
  if (word == "q") return MovingOperand::q;
  fail("an edit begins with its operand, p or q, not " + in_quotes(word) + "; other lines are {, }, undo and redo");
}

std::uint32_t ScriptLine::index(const std::string& what) {
  const std::string_view word = take("the index of " + what);
  const ScannedCount count = scan_count(word);
  if (count.length == 0 || count.length != word.size() || count.value >= std::numeric_limits<std::uint32_t>::max())
    fail("the index of " + what + " is expected, counted from 0, not " + in_quotes(word));
  return static_cast<std::uint32_t>(count.value);
}

double ScriptLine::coordinate() {
  const std::string_view word = take("a coordinate");
  if (word.find('/') == std::string_view::npos) {
    const ScannedNumber number = scan_number(word);
    if (number.length == word.size() && number.length > 0 && std::isfinite(number.value)) return number.value;
    fail("a coordinate is expected, not " + in_quotes(word));
  }
  const Result<Rational> fraction = Rational::parse(word);
  if (!fraction) fail("a coordinate is expected, not " + in_quotes(word));
  const double value = fraction->to_double();
  const Result<Rational> held = Rational::of(value);
  if (held && *held == *fraction) return value;
  std::string nearest;
  if (held) append_number(nearest, value);
  fail(std::string(word) + " is no double" + (held ? "; the nearest is " + nearest : ""));
}

void ScriptLine::end() const {
  if (!at_end()) fail("the line goes on after its edit with " + in_quotes(peek()));
}

std::string ScriptLine::hyphened(std::string_view name) {
  std::string out(name);
  for (char& c : out)
    if (c == '_') c = '-';
  return out;
}

void ScriptLine::fail_with_kinds(std::string_view word, std::span<const std::string_view> kinds) const {
  std::string all;
  for (const std::string_view kind : kinds) all += (all.empty() ? "" : ", ") + hyphened(kind);
  fail(in_quotes(word) + " is no edit; there are " + all);
}

std::vector<ScriptLine> script_lines(std::string_view bytes, std::string_view file) {
  std::vector<ScriptLine> lines;
  std::int64_t number = 0;
  for (std::size_t at = 0; at < bytes.size(); ++number) {
    const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
    const std::string_view line = bytes.substr(at, end - at);
    ScriptLine words(line.substr(0, line.find('#')), file, number + 1);
    if (!words.at_end()) lines.push_back(std::move(words));
    at = end + 1;
  }
  return lines;
}

ScriptWord script_word(const ScriptLine& line) {
  const std::string_view word = line.peek();
  return word == "{"      ? ScriptWord::begin
         : word == "}"    ? ScriptWord::end
         : word == "undo" ? ScriptWord::undo
         : word == "redo" ? ScriptWord::redo
                          : ScriptWord::none;
}

std::optional<Error> read_failure(const std::function<void()>& use) {
  try {
    use();
  } catch (const ReadFailure& failure) {
    return failure.error;
  }
  return std::nullopt;
}

std::string script_words(MovingOperand operand, std::string_view kind) {
  return std::string(name(operand)) + " " + ScriptLine::hyphened(kind);
}

void write_index(std::string& out, std::uint32_t index) { out += " " + std::to_string(index); }

void write_numbers(std::string& out, std::initializer_list<double> numbers) {
  for (const double number : numbers) {
    out += ' ';
    append_number(out, number);
  }
}

}  // namespace dymsum::io
