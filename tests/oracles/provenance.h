// Whether a sum's provenance is true: contacts name segments that pass through the vertices they are given for.
#pragma once

#include <string>

#include "dymsum/planar_sum.h"

namespace dymsum::oracles {

enum class Combination { sum, difference, erosion };  ///< p + q; p - q; p - q with P eroded

/// The first false statement, or nothing. Checked exactly: every vertex lies on the segments of its `in` and `out`
/// contacts and is the sum of its corner, if named; an edge of a ring runs along the line of the `out` contact of its
/// start and of the `in` contact of its end, in their direction, and shares more than a point with each; positions are
/// within the sum's at_error, which is small. A contact's edge stands for the straight run of edges it belongs to.
std::string check_provenance(const Region& p, const Region& q, Combination combination, const PlanarSum& sum);

}  // namespace dymsum::oracles
