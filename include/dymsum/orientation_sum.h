// Planar sums of which an operand is turned by an exact orientation.
#pragma once

#include "dymsum/orientation.h"
#include "dymsum/planar_sum.h"

namespace dymsum {

/// R(theta) P (+) Q: P turned about the origin of its coordinates, never rounded. Provenance indices refer to P and Q.
/// Errors as minkowski_sum.
Result<PlanarSum> rotated_sum(const Region& p, const Region& q, const Orientation& theta,
                              const SumOptions& options = {});

/// P (-) R(theta) Q = { x : x + R(theta) Q inside P }, Q never rounded. Provenance indices refer to P and Q. Errors as
/// erode.
Result<PlanarSum> rotated_erode(const Region& p, const Region& q, const Orientation& theta,
                                const SumOptions& options = {});

}  // namespace dymsum
