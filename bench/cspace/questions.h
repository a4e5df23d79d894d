// Questions to the obstacles, beside table 4.3 of the thesis.
#pragma once

#include <iosfwd>

namespace dymsum::bench {

/// Writes the tables as markdown: contains against the slow exact test, clearance against the sampled one.
void write_questions(std::ostream& out);

}  // namespace dymsum::bench
