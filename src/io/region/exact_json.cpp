#include "io/region/exact_json.h"

#include <cmath>
#include <filesystem>
#include <fstream>

#include "io/plain_text.h"
#include "io/read_file.h"

namespace dymsum::io {

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
