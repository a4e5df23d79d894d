// A surface whose nearest doubles cross, made one that does not by merging what is nearer than a tolerance.
#pragma once

#include <optional>

#include "dymsum/mesh.h"
#include "dymsum/result.h"
#include "dymsum/spatial_sum.h"

namespace dymsum::spatial {

/// `drawn` is the surface of a sum, every vertex at its nearest doubles. The answer is a valid mesh of triangles with
/// coordinates of that precision, checked exactly (Mesh::create), and what was done to get it. Its `distance` is
/// proved: the surface is the image of the exact one under a map that moves no point further, so where the two solids
/// differ, it is within that distance of both surfaces. `tolerance` is a fraction of the largest coordinate. Error
/// rounding_changed_topology with a position where merging within the tolerance is not enough; cannot_write past the
/// range of single precision. O(r n log n) for r rounds, at most 64 at each of the doubling tolerances; rounds after
/// the first look at what changed. `untangle` is asked where no two triangles meet and what is left still is no mesh:
/// surfaces that were merged along edges may enclose a sliver twice. The surface's winding number at positions further
/// than `distance` from it is that of the exact surface, so a solid by winding number keeps that bound.
Result<SpatialSum::Rounded> separated_surface(
    const SpatialSum::Rounded& drawn, Precision precision, double tolerance,
    std::optional<SpatialSum::Rounded> (*untangle)(const SpatialSum::Rounded&));

}  // namespace dymsum::spatial
