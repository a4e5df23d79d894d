// What coordinates cost sums of convex solids.
#pragma once

#include <string>

namespace dymsum::bench {

/// The table of kinds; false where an answer is wrong.
bool measure_kinds(const std::string& folder);

}  // namespace dymsum::bench
