// Questions to the obstacles, beside table 4.3 of the thesis.
#pragma once

#include <iosfwd>
#include <vector>

#include "cspace/turning_pairs.h"

namespace dymsum::bench {

/// Writes tables of the pairs in table 4.3 as markdown: contains against the slow exact test, clearance against the
/// sampled one.
void write_questions(const std::vector<TurningPair>& pairs, std::ostream& out);

}  // namespace dymsum::bench
