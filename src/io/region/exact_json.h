// What exact results in JSON have in common, planar and solid: how they begin, and coordinates "n/d".
#pragma once

#include <string>
#include <string_view>

#include "dymsum/rational.h"
#include "io/region/json_shapes.h"

namespace dymsum::io {

/// Whether a text begins with an object whose first key is this one.
bool begins_with_key(std::string_view text, std::string_view key);

/// Whether a path ends in .json or .json.gz and names a file that begins so. A pipe, which can be read once only, is
/// not read. Cost: of a compressed file reading it; else of its first bytes.
bool names_json_with(const std::string& path, std::string_view key);

/// A string that is a number of any size. Failure malformed for others, and for more than 20,000 characters;
/// unsupported_operand beyond 2^1000.
Rational require_exact_coordinate(const Source& source, const JsonValue& value);

}  // namespace dymsum::io
