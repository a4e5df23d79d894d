// Sets whose vertices are fractions, as operands of sums: what one operation leaves is what the next one takes,
// unrounded.
//
// Sums commute with scaling. In units of 1 / D, D the smallest odd number in whose fractions all coordinates lie up to
// powers of two, the vertices of both operands are integers on one grid; the sum in these units, divided by D, is the
// sum. Where these integers are long, every coordinate is a fraction over a denominator of its own.
#pragma once

#include <vector>

#include "dymsum/spatial_sum.h"
#include "spatial/sum/sum_source.h"

namespace dymsum::spatial {

/// A surface as sum_of_solids takes it, with exact positions.
struct ExactSet {
  MeshData set;                   ///< at the nearest doubles
  std::vector<bool> thin;         ///< faces that are thin parts; empty where none is
  std::vector<ExactPosition> at;  ///< of every vertex
};

/// The set whose vertices are doubles.
ExactSet exact_set(MeshData set, std::vector<bool> thin = {});
/// The regular part of a sum, in triangles.
ExactSet exact_set(const SpatialSum& sum);

/// Coordinates up to so many bits over a common denominator are integers; longer ones are fractions.
inline constexpr int kMostCommonBits = 250;

/// The sum of two of them. Errors as minkowski_sum.
Result<SpatialSum> sum_of_exact_sets(const ExactSet& p, const ExactSet& q, const SpatialOptions& options,
                                     int most_common_bits = kMostCommonBits);

}  // namespace dymsum::spatial
