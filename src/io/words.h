// The words of a text, one after the other: what the readers of meshes have in common.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "io/source.h"

namespace dymsum::io {

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

}  // namespace dymsum::io
