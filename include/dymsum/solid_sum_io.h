// Exact results of solids as JSON, written and read back as operands.
#pragma once

#include <string>
#include <string_view>

#include "dymsum/result.h"
#include "dymsum/spatial_sum.h"

namespace dymsum {

/// Counts and measures, then vertices, edges, faces and what is tight, exactly and with provenance, as JSON text
/// (docs/guide/json.md). `volume_exact` is null where its denominator is longer than 16,384 bits.
std::string solid_sum_to_json(const SpatialSum& sum);

/// Whether a text begins as what solid_sum_to_json writes: an object with "shells". No planar JSON does.
bool begins_like_solid_sum(std::string_view text);

/// Whether a path ends in .json or .json.gz and names a file that begins so.
bool names_solid_sum(const std::string& path);

/// The sum that solid_sum_to_json has written, with its tight features, from the exact coordinates "n/d" of its
/// vertices and the indices in its lists. It equals the sum that was written, has its provenance, and is written as the
/// same text; is_convex is false for it. That the faces bound a solid and are its canonical ones is decided by winding
/// numbers, exactly. Errors: malformed, with the line, and of what is no result with the face, or a vertex; for
/// coordinates of more than 20,000 characters too; unsupported_operand for coordinates beyond 2^1000; truncated. Cost:
/// that of the union of the faces.
Result<SpatialSum> parse_solid_sum(std::string_view text, std::string_view name_for_errors);
/// The same of a file; "-" is standard input, .gz is unpacked. Errors: cannot_open; as above.
Result<SpatialSum> read_solid_sum(const std::string& path);

}  // namespace dymsum
