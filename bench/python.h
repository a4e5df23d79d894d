// Systems that are reached through a script in Python, versus/NAME.py.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace dymsum::bench {

/// Whether there is an interpreter: the environment's DYMSUM_PYTHON.
bool has_python();

/// What the script prints when it is given the paths of files with these names and texts, and then `more`. Empty where
/// it fails, has not what it imports, or takes longer. Requires: has_python().
std::string query_python(const std::string& script, const std::vector<std::pair<std::string, std::string>>& files,
                         const std::string& more, double limit_s);

}  // namespace dymsum::bench
