// Tight features: places outside the open sum that nothing outside it surrounds. docs/design/planar-sum.md, "Tight
// features".
#pragma once

#include "base/poll.h"
#include "planar/boundary/boundary.h"
#include "planar/boundary/raw_boundary.h"

namespace dymsum::planar {

/// Appends the cracks and punctures of an arrangement; `kept` are its true loops. Grows `grid_error` to the largest
/// error of a position.
void find_tight_features(const Soup& soup, const Arrangement& arrangement, const Array<BoundaryLoop>& kept,
                         Collision& collision, RawBoundary& out, double& grid_error, const Poll* poll = nullptr);

}  // namespace dymsum::planar
