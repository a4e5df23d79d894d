// The text a reader works on, and how a reader fails: by throwing a ReadFailure that parse_shapes turns into a Result.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "dymsum/read_options.h"
#include "dymsum/result.h"

namespace dymsum::io {

/// Thrown inside the readers only; it never leaves this room.
struct ReadFailure {
  Error error;
};

struct Source {
  std::string_view text;
  std::string_view file;  ///< for the evidence
  ReadOptions options = {};
  bool drops_third() const { return options.third == ThirdCoordinates::dropped; }

  /// The line of a byte, from 1; past the last character that is not blank, the line of that character.
  std::int64_t line(std::size_t offset) const;

  [[noreturn]] void fail(ErrorCode code, std::string message, std::size_t offset, Evidence evidence = {}) const;
  /// Fails where bytes are no text: they have no lines, and the message tells the byte.
  [[noreturn]] void fail_in_bytes(ErrorCode code, std::string message) const;
  [[noreturn]] void fail_on_line(ErrorCode code, std::string message, std::int64_t line, Evidence evidence = {}) const;
};

/// Up to 24 characters of a text between quotation marks, for messages; what cannot be printed becomes '?'.
std::string in_quotes(std::string_view text);

constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v'; }
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
constexpr bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
constexpr char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

}  // namespace dymsum::io
