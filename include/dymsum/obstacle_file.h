// Obstacles in files: what CspaceObstacle::create computed, to be asked again without computing it.
#pragma once

#include <string>
#include <string_view>

#include "dymsum/cspace_obstacle.h"

namespace dymsum {

/// The obstacle as text: both regions, every event angle as a root of an integer polynomial, patches, shells, free
/// cells and work (docs/guide/cspace.md, "Files of obstacles"). Nothing is rounded. O(size).
std::string format_obstacle(const CspaceObstacle& obstacle);

/// The obstacle of such a text; it answers every question as the one that was written. Errors: truncated or malformed
/// where the text is not complete, not of this format and version, or not what was written (a checksum over all of it,
/// and indices that name something); those of CspaceObstacle::create for its regions. The checksum tells damage and
/// careless edits; whoever forges it together with the content is believed. O(size) and a few exact signs an angle.
Result<CspaceObstacle> parse_obstacle(std::string_view text, std::string_view name_for_errors);

/// The same of a file; "-" is standard input. Errors: cannot_open, and those of parse_obstacle.
Result<CspaceObstacle> read_obstacle(const std::string& path);

}  // namespace dymsum
