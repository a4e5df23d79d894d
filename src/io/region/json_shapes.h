// The two planar formats that are written in JSON, as readers of one tape.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dymsum/region_io.h"
#include "io/region/json_tape.h"

namespace dymsum::io {

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

}  // namespace dymsum::io
