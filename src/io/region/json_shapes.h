// The two planar formats that are written in JSON, as readers of one tape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dymsum/rational.h"
#include "dymsum/region.h"
#include "dymsum/region_io.h"
#include "io/source.h"

namespace dymsum::io {

// A JSON text as one flat array of tokens with line numbers. A pair of numbers, which is what large files consist of,
// is a single token, so ten million vertices take 320 MB. Nothing is recursive.

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

/// GeoJSON: geometry, feature or collection; each feature of a collection is a shape. Closing vertices are dropped and
/// rings oriented, because files follow neither order reliably.
std::vector<NamedShape> read_geojson(const Source& source, const JsonValue& root);

/// A nesting instance: a shape per entry of `items`, named by its id. Closing vertices are dropped; all else stays.
std::vector<NamedShape> read_nesting(const Source& source, const JsonValue& root);

/// An item or a bin of such an instance: its `shape`, named by its `id`; a name that is no text is empty.
NamedShape read_nesting_shape(const Source& source, const JsonValue& item);

/// What an object has under a key. Failure malformed where it has none.
JsonValue require_member(const Source& source, const JsonValue& object, std::string_view key);

/// The text of a string. Failure malformed for other kinds.
const std::string& require_text(const Source& source, const JsonValue& value, std::string_view what);

/// [x, y], and [x, y, z] where third coordinates are dropped. Failure malformed for anything else.
Point require_position(const Source& source, const JsonValue& value);

/// [[x, y], ...].
std::vector<Point> require_positions(const Source& source, const JsonValue& value);

/// Calls visit(JsonValue) for each value of an array. Failure malformed for other kinds, and for two bare numbers.
template <class Visit>
void visit_array(const Source& source, const JsonValue& value, const std::string& what, Visit visit) {
  if (value.kind() != JsonKind::array)
    source.fail_on_line(ErrorCode::malformed, "expected an array of " + what, value.line());
  value.each(visit);
}

/// [], as an inner ring that is none is written.
bool is_empty_array(const JsonValue& value);

/// A text or a whole number as a name.
std::optional<std::string> name_of(const JsonValue& value);

// What exact results in JSON have in common, planar and solid: how they begin, and coordinates "n/d".

/// Whether a text begins with an object whose first key is this one.
bool begins_with_key(std::string_view text, std::string_view key);

/// Whether a path ends in .json or .json.gz and names a file that begins so. A pipe, which can be read once only, is
/// not read. Cost: of a compressed file reading it; else of its first bytes.
bool names_json_with(const std::string& path, std::string_view key);

/// A string that is a number of any size. Failure malformed for others, and for more than 20,000 characters;
/// unsupported_operand beyond 2^1000.
Rational require_exact_coordinate(const Source& source, const JsonValue& value);

}  // namespace dymsum::io
