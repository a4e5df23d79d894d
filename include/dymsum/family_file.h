// Families in files: what ScalingFamily::create computed, to be queried again without computing it.
#pragma once

#include <string>
#include <string_view>

#include "dymsum/scaling_family.h"

namespace dymsum {

/// The family as text: both regions, the interval, every event as a fraction, the structure of every cell as what it
/// changes in the one before (docs/guide/families.md, "Files of families"). Nothing is rounded. O(size).
std::string format_family(const ScalingFamily& family);

/// The family of such a text; it answers every question as the one that was written, and is written as the same text.
/// Errors: truncated or malformed where the text is not complete, not of this format and version, or not what was
/// written (a checksum over all of it, indices that name something, events in order, vertices on their lines); those of
/// ScalingFamily::create for its regions. The checksum detects damage and careless edits; whoever forges it together
/// with the content is believed. Cost: O(size) of all structures, and one exact position a vertex.
Result<ScalingFamily> parse_family(std::string_view text, std::string_view name_for_errors);

/// The same of a file, compressed or not; "-" is standard input. Errors: cannot_open, and those of parse_family.
Result<ScalingFamily> read_family(const std::string& path);

}  // namespace dymsum
