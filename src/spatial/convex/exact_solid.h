// A sum as an operand of the next one.
#pragma once

#include "dymsum/convex_sum.h"
#include "dymsum/result.h"
#include "spatial/gauss/polytope.h"

namespace dymsum::spatial {

/// The sum's exact vertices and facets. Errors: unsupported_operand where positions are not multiples of a power of
/// two.
Result<ExactSolid> exact_solid(const SolidSum& sum);

}  // namespace dymsum::spatial
