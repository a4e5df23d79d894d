// Verdicts on a sum: the first thing wrong with it in one sentence, or nothing. Exact.
#pragma once

#include <cstdint>
#include <string>

#include "dymsum/planar_sum.h"
#include "reference_sum.h"

namespace dymsum::oracles {

/// For tiny operands: the sum equals the reference sum in every vertex, edge and face, its rings are canonical, and its
/// provenance is true. `sum` is P (+) Q under these semantics.
std::string check_sum(const Region& p, const Region& q, Semantics semantics, const PlanarSum& sum);

/// The same for nfp(a, b) with semantics `closed` and for erode(p, q).
std::string check_nfp(const Region& a, const Region& b, const PlanarSum& sum);
std::string check_erode(const Region& p, const Region& q, const PlanarSum& sum);

/// The same for a Boolean expression, without provenance.
std::string check_boolean(const std::vector<RegionData>& inputs, const BooleanExpression& expression,
                          Semantics semantics, const PlanarSum& result);

/// For larger operands, in O(nm) a position: the membership of every vertex and edge midpoint of a closed sum, and of
/// `positions` random positions near it; canonical rings; provenance.
std::string spot_check_sum(const Region& p, const Region& q, const PlanarSum& sum, int positions, std::uint64_t seed);

}  // namespace dymsum::oracles
