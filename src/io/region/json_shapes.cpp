#include "io/region/json_shapes.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "io/read_file.h"

namespace dymsum::io {
namespace {

/// How far the parser has read; its events carry no position of their own.
struct Progress {
  std::uint32_t line = 1;
  char last = 0;
};

class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* at, Progress* progress) : at_(at), progress_(progress) {}
  reference operator*() const { return *at_; }
  CountingIterator& operator++() {
    progress_->last = *at_++;
    if (progress_->last == '\n') ++progress_->line;
    return *this;
  }
  CountingIterator operator++(int) {
    CountingIterator old = *this;
    ++*this;
    return old;
  }
  friend bool operator==(const CountingIterator& a, const CountingIterator& b) { return a.at_ == b.at_; }

 private:
  const char* at_;
  Progress* progress_;
};

constexpr const char* kEndsEarly = "the JSON text ends too early";

/// Receives the parser's events and writes the tape. Throws through the parser, which holds no resources but its own.
class TapeWriter : public nlohmann::json_sax<nlohmann::json> {
 public:
  /// What is parsed are the bytes of the source from `begin` to `end`.
  TapeWriter(const Source& source, std::size_t begin, std::size_t end, const Progress& progress,
             std::vector<JsonToken>& tokens, std::vector<std::string>& texts)
      : source_(source), begin_(begin), end_(end), progress_(progress), tokens_(tokens), texts_(texts) {}

  bool null() override { return add({JsonKind::null, progress_.line, 0, {}}); }
  bool boolean(bool) override { return add({JsonKind::boolean, progress_.line, 0, {}}); }
  bool number_integer(number_integer_t value) override { return add_number(static_cast<double>(value)); }
  bool number_unsigned(number_unsigned_t value) override { return add_number(static_cast<double>(value)); }
  bool number_float(number_float_t value, const string_t&) override { return add_number(value); }
  bool string(string_t& text) override { return add_text(JsonKind::string, text); }
  bool key(string_t& text) override { return add_text(JsonKind::key, text); }
  bool binary(binary_t&) override { return false; }  // does not occur in text
  bool start_object(std::size_t) override { return open(JsonKind::object); }
  bool start_array(std::size_t) override { return open(JsonKind::array); }
  bool end_object() override { return close(); }

  bool end_array() override {
    const std::size_t start = open_.back();
    const auto is_number = [this](std::size_t i) { return tokens_[i].kind == JsonKind::number; };
    if (tokens_.size() == start + 3 && is_number(start + 1) && is_number(start + 2)) {
      tokens_[start].kind = JsonKind::pair;
      tokens_[start].pair = {tokens_[start + 1].pair.x, tokens_[start + 2].pair.x};
      tokens_.resize(start + 1);
    }
    return close();
  }

  /// `position` characters have been read, the last one by the token that does not fit.
  bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& error) override {
    const std::string_view text = source_.text;
    const std::size_t read = begin_ + position, end = read < end_ ? read : end_;
    std::size_t start = end > 0 ? end - 1 : 0;
    while (start > 0 && !is_delimiter(text[start]) && !is_delimiter(text[start - 1])) --start;
    constexpr std::size_t kMostShown = 64;  // more than messages quote
    const std::string_view rest = text.substr(start, kMostShown),
                           word = rest.substr(0, rest.find_first_of(kDelimiters, 1));
    constexpr int kNumberOverflow = 406;
    if (error.id == kNumberOverflow || spells_no_finite_number(word)) {
      source_.fail(ErrorCode::not_finite, "the number " + in_quotes(word) + " is not a finite double", start);
    }
    if (read > end_) source_.fail(ErrorCode::truncated, kEndsEarly, text.size());
    source_.fail(ErrorCode::malformed, "no JSON value at " + in_quotes(word), start);
  }

 private:
  static constexpr std::size_t kMostNested = 200;

  static constexpr std::string_view kDelimiters = " \t\r\n,:[]{}";
  static bool is_delimiter(char c) { return kDelimiters.find(c) != std::string_view::npos; }

  static bool spells_no_finite_number(std::string_view text) {
    if (!text.empty() && text[0] == '-') text.remove_prefix(1);
    return text.starts_with("NaN") || text.starts_with("nan") || text.starts_with("Inf") || text.starts_with("inf");
  }

  bool add(JsonToken token) {
    tokens_.push_back(token);
    return true;
  }

  /// A number ends where another character has been read, which may have been the line's end.
  bool add_number(double value) {
    const std::uint32_t line = progress_.line - (progress_.last == '\n' ? 1 : 0);
    return add({JsonKind::number, line, 0, {value, 0}});
  }

  bool add_text(JsonKind kind, string_t& text) {
    texts_.push_back(std::move(text));
    return add({kind, progress_.line, texts_.size() - 1, {}});
  }

  bool open(JsonKind kind) {
    if (open_.size() == kMostNested) {
      source_.fail_on_line(ErrorCode::malformed, "JSON nested deeper than " + std::to_string(kMostNested),
                           progress_.line);
    }
    open_.push_back(tokens_.size());
    return add({kind, progress_.line, 0, {}});
  }

  bool close() {
    tokens_[open_.back()].link = tokens_.size();
    open_.pop_back();
    return true;
  }

  const Source& source_;
  std::size_t begin_, end_;
  const Progress& progress_;
  std::vector<JsonToken>& tokens_;
  std::vector<std::string>& texts_;
  std::vector<std::size_t> open_;
};

}  // namespace

JsonTape::JsonTape(const Source& source) {
  // Blanks around the value are no token, which the parser would keep, and write out in its error.
  constexpr std::string_view kBlanks = " \t\r\n";
  const std::size_t begin = source.text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) source.fail(ErrorCode::truncated, kEndsEarly, source.text.size());
  const std::size_t end = source.text.find_last_not_of(kBlanks) + 1;
  const char* const text = source.text.data();
  Progress progress;
  progress.line += static_cast<std::uint32_t>(std::count(text, text + begin, '\n'));
  TapeWriter writer(source, begin, end, progress, tokens_, texts_);
  nlohmann::json::sax_parse(CountingIterator(text + begin, &progress), CountingIterator(text + end, &progress),
                            &writer);
}

const JsonToken& JsonValue::token() const { return tape_->tokens_[index_]; }

const std::string& JsonValue::text() const { return tape_->texts_[token().link]; }

std::size_t JsonValue::after(std::size_t index) const {
  const JsonToken& token = tape_->tokens_[index];
  return token.kind == JsonKind::array || token.kind == JsonKind::object ? token.link : index + 1;
}

std::optional<JsonValue> JsonValue::find(std::string_view key) const {
  if (!is_object()) return std::nullopt;
  for (std::size_t i = index_ + 1; i < token().link; i = after(i + 1)) {
    if (tape_->texts_[tape_->tokens_[i].link] == key) return JsonValue(*tape_, i + 1);
  }
  return std::nullopt;
}

namespace {

constexpr std::size_t kMostCharacters = 20000;
constexpr double kLargest = 0x1p1000;

/// The first bytes of a file, more than blanks before an object take.
std::string head_of(const std::string& path) {
  constexpr std::size_t kHead = 4096;
  std::string head(kHead, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  return head;
}

}  // namespace

bool begins_with_key(std::string_view text, std::string_view key) {
  const auto skip = [&] {
    const std::size_t start = text.find_first_not_of(" \t\r\n");
    text.remove_prefix(start == std::string_view::npos ? text.size() : start);
  };
  skip();
  if (!text.starts_with('{')) return false;
  text.remove_prefix(1);
  skip();
  if (!text.starts_with('"')) return false;
  text.remove_prefix(1);
  return text.starts_with(key) && text.substr(key.size()).starts_with('"');
}

bool names_json_with(const std::string& path, std::string_view key) {
  std::error_code unknown;
  if (extension(path) != ".json" || !std::filesystem::is_regular_file(path, unknown)) return false;
  const std::string head = head_of(path);
  if (!head.starts_with("\x1f\x8b")) return begins_with_key(PlainText(head).view(), key);
  const Result<std::string> text = read_file(path);
  return text && begins_with_key(PlainText(*text).view(), key);
}

Rational require_exact_coordinate(const Source& source, const JsonValue& value) {
  const std::string& text = require_text(source, value, "an exact coordinate");
  if (text.size() > kMostCharacters)
    source.fail_on_line(ErrorCode::malformed,
                        "an exact coordinate has " + std::to_string(text.size()) + " characters, more than 20000",
                        value.line());
  Result<Rational> number = Rational::parse(text);
  if (!number) source.fail_on_line(ErrorCode::malformed, "no exact coordinate: " + in_quotes(text), value.line());
  if (!(std::abs(number->to_double()) <= kLargest))
    source.fail_on_line(ErrorCode::unsupported_operand, "a coordinate is larger than 2^1000", value.line());
  return *std::move(number);
}

}  // namespace dymsum::io
