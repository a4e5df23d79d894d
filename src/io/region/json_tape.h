// A JSON text as one flat array of tokens with line numbers. A pair of numbers, which is what large files consist of,
// is a single token, so ten million vertices take 320 MB. Nothing is recursive.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dymsum/region.h"
#include "io/source.h"

namespace dymsum::io {

enum class JsonKind : std::uint8_t { null, boolean, number, string, key, array, object, pair };

struct JsonToken {
  JsonKind kind = JsonKind::null;
  std::uint32_t line = 0;
  std::uint64_t link = 0;  ///< array, object: index after its last token; string, key: index of its text
  Point pair;              ///< pair: the two numbers; number: in x
};

class JsonTape;

/// A value in a tape; cheap to copy.
class JsonValue {
 public:
  JsonValue(const JsonTape& tape, std::size_t index) : tape_(&tape), index_(index) {}

  JsonKind kind() const { return token().kind; }
  bool is_object() const { return kind() == JsonKind::object; }
  std::int64_t line() const { return token().line; }
  Point pair() const { return token().pair; }       ///< requires kind pair
  double number() const { return token().pair.x; }  ///< requires kind number
  const std::string& text() const;                  ///< requires kind string
  /// What an object has under a key, the first where there are several; nothing for other kinds.
  std::optional<JsonValue> find(std::string_view key) const;

  /// Calls visit(JsonValue) for each value of an array that is not a pair.
  template <class Visit>
  void each(Visit visit) const {
    if (kind() != JsonKind::array) return;
    for (std::size_t i = index_ + 1; i < token().link; i = after(i)) visit(JsonValue(*tape_, i));
  }

 private:
  const JsonToken& token() const;
  std::size_t after(std::size_t index) const;

  const JsonTape* tape_;
  std::size_t index_;
};

class JsonTape {
 public:
  /// Reads a whole text. Throws ReadFailure: malformed, truncated, not_finite (numbers past the double range, NaN,
  /// Infinity).
  explicit JsonTape(const Source& source);

  JsonValue root() const { return {*this, 0}; }

 private:
  friend class JsonValue;
  std::vector<JsonToken> tokens_;
  std::vector<std::string> texts_;
};

}  // namespace dymsum::io
