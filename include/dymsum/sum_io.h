// Results from files: the exact set that was written as JSON, read back as an operand.
#pragma once

#include <string>
#include <string_view>

#include "dymsum/planar_sum.h"
#include "dymsum/result.h"

namespace dymsum {

/// Whether a text begins as what sum_to_json writes: an object with "parts". Other planar JSON never does.
bool begins_like_sum(std::string_view text);

/// Whether a path ends in .json or .json.gz and names a file that begins so.
bool names_sum(const std::string& path);

/// The set and its tight features that sum_to_json has written, from the exact coordinates "n/d". It equals the sum
/// that was written; its provenance does not: each vertex and edge of a set that was read names itself (Contact::p is
/// its index, as PlanarOperand counts them). Errors: malformed, with the line, for anything else, also where rings
/// cross, overlap or are not in canonical order, and for coordinates of more than 20,000 characters;
/// unsupported_operand for coordinates beyond 2^1000; truncated.
Result<PlanarSum> parse_sum(std::string_view text, std::string_view name_for_errors);
/// The same of a file; "-" is standard input, .gz is unpacked. Errors: cannot_open; as above.
Result<PlanarSum> read_sum(const std::string& path);

}  // namespace dymsum
