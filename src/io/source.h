// Text that is read with the position of each word, and numbers as text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "dymsum/read_options.h"
#include "dymsum/result.h"

namespace dymsum::io {

// The text a reader works on, and how a reader fails: by throwing a ReadFailure that parse_shapes turns into a Result.

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

// The words of a text, one after the other: what the readers of meshes have in common.

class Words {
 public:
  /// Where `comments`, '#' hides the rest of a line; where `continued`, a backslash at the end of a line outside of
  /// comments joins the next one to it.
  Words(const Source& source, bool comments, bool continued = false)
      : source_(source), comments_(comments), continued_(continued) {}

  std::size_t offset() const { return at_; }
  void go_to(std::size_t offset) { at_ = offset; }

  /// Skips blanks and comments; true when nothing follows.
  bool at_end();
  /// Skips blanks and comments within the line; true at the line's or the text's end.
  bool at_line_end();
  /// Moves to the start of the next line.
  void skip_line();

  /// The next word, without taking it; empty at the end. Afterwards offset() is where it starts.
  std::string_view peek();
  /// Takes the next word. Error truncated, saying that the file ends before `what`.
  std::string_view take(const std::string& what);
  /// Takes the word that has to follow, in any case.
  void expect(std::string_view keyword);

  /// Takes a number that may be infinite or NaN. Errors truncated, malformed.
  double number(const std::string& what, const Evidence& evidence = {});
  /// Takes a finite number. Errors also: not_finite.
  double coordinate(const Evidence& evidence);
  /// Takes the digits of a number from 0 on. Errors truncated, malformed.
  std::uint64_t count(const std::string& what, const Evidence& evidence = {});
  /// Takes the number of one of `vertices` vertices, from 0 on. Errors also: bad_index.
  std::uint32_t index(std::uint64_t vertices, Evidence evidence);

  /// Fails at the word that is next, or at `offset`.
  [[noreturn]] void fail(ErrorCode code, std::string message, Evidence evidence = {}) const;
  [[noreturn]] void fail_at(std::size_t offset, ErrorCode code, std::string message, Evidence evidence = {}) const;

 private:
  void skip_blanks(bool stay_on_line);
  /// The length of a backslash and the end of the line behind it, 0 elsewhere.
  std::size_t joint_at(std::size_t offset) const;

  const Source& source_;
  bool comments_, continued_;
  std::size_t at_ = 0;
};

/// The words are equal but for capitals.
bool same_word(std::string_view a, std::string_view b);

/// The evidence that names a face, or a vertex.
Evidence at_face(std::size_t face);
Evidence at_vertex(std::size_t vertex);

// Numbers as text: read correctly rounded, written with the fewest digits that read back; independent of the locale.

struct ScannedNumber {
  double value = 0;        ///< nearest double; infinite past the double range, infinite or NaN where the text says so
  std::size_t length = 0;  ///< characters used; 0 where no number starts
};

/// The longest decimal number (or inf, infinity, nan) at the start of a text; one leading '+' is allowed.
ScannedNumber scan_number(std::string_view text);

struct ScannedCount {
  std::uint64_t value = 0;  ///< the largest 64-bit value where the digits say more
  std::size_t length = 0;
};

/// The digits at the start of a text.
ScannedCount scan_count(std::string_view text);

/// Appends the shortest text that reads back to the same double (0 for both zeros). Requires: finite.
void append_number(std::string& out, double value);

/// Appends a value rounded to at most `decimals` decimals, without trailing zeros: for pictures.
void append_rounded(std::string& out, double value, int decimals);

/// 1234567 as "1,234,567".
std::string with_commas(std::uint64_t value);

}  // namespace dymsum::io
