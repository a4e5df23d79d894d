// Degrees less whole turns, and all differences of two sets of them.
#pragma once

#include <set>

#include "dymsum/rational.h"
#include "nesting/planning_poll.h"

namespace dymsum::nesting {

/// The angle in [0, 360).
Rational reduced_angle(const Rational& degrees);

/// All b - a for a of `from` and b of `to`, all in [0, 360), reduced; each once. O(nm) machine operations and, for d
/// results, O(d) rational ones, where one denominator of at most 40 bits serves all; else O(nm) rational ones. Asks
/// `poll` where that takes long.
std::set<Rational> angle_differences(const std::set<Rational>& from, const std::set<Rational>& to,
                                     const PlanningPoll& poll);

}  // namespace dymsum::nesting
