// Guesses which sites bound each other's cells.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "shape/complex/walks.h"

namespace dymsum::shape {

/// The other sites for each one, ascending.
using Candidates = std::vector<std::vector<std::uint32_t>>;

/// Neighbours in the Voronoi diagram of the sites with coordinates rounded to 30 bits; of their ends and midpoints
/// alone where rounding makes segments meet. O(n log n).
Candidates candidates_of(const Walks& walks);

/// The same with coordinates of 22 bits and without integers of more than 64 bits: two to three times faster, but wrong
/// in places where four sites and more nearly touch one disc. Nothing where rounding makes segments meet.
std::optional<Candidates> rough_candidates_of(const Walks& walks);

}  // namespace dymsum::shape
