// What coordinates cost penetration depth and sums near a position.
#pragma once

#include <string>
#include <vector>

#include "page.h"
#include "solid/inputs.h"

namespace dymsum::bench {

/// The table of kinds; false where an answer is wrong.
bool measure_kinds(const std::string& folder);

/// Pairs of solids (p, q) with a name in coordinates of a kind; of those that rounding spoils a line in the report.
template <class Pair>
std::vector<Pair> with_coordinates(std::vector<Pair> pairs, Kind kind, Report& report) {
  std::erase_if(pairs, [&](Pair& pair) {
    const std::string wrong = set_coordinates(pair.p, pair.q, kind);
    if (!wrong.empty()) report.row({pair.name, "left out: " + wrong});
    return !wrong.empty();
  });
  return pairs;
}

}  // namespace dymsum::bench
