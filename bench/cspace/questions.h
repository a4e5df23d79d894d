// Questions to the obstacles, beside table 4.3 of the thesis.
#pragma once

#include <iosfwd>

namespace dymsum::bench {

/// Writes the tables as markdown. False, and nothing written, where the library has no obstacle queries.
bool write_questions(std::ostream& out);

}  // namespace dymsum::bench
