// Makes, of surfaces, the solid of all positions whose winding number is one of those requested.
#pragma once

#include <span>

#include "dymsum/mesh.h"
#include "dymsum/result.h"
#include "dymsum/spatial_sum.h"
#include "spatial/boolean/surface.h"
#include "spatial/sum/exact_set.h"

namespace dymsum::spatial {

/// The winding numbers that are inside: those of at least `least`, or at most -`least` where `both` ways count; of
/// these, odd ones where `odd` alone count.
struct InsideRule {
  int least = 1;
  bool both = false, odd = false;

  bool holds(int winding) const {
    return (winding >= least || (both && winding <= -least)) && (!odd || winding % 2 != 0);
  }
};

/// Statement, errors and cost: united in solid_union.h. Method: docs/design/solid-union.md.
Result<SpatialSum> solid_inside(const MeshData& surface, InsideRule rule, const SpatialOptions& options);
/// The same of solids together: faces that nothing of another solid comes near are not arranged. With the engine
/// `brute` all are.
Result<SpatialSum> solid_inside(std::span<const DirectedSolid> solids, InsideRule rule, const SpatialOptions& options);
/// The same of triangles with area whose vertices are fractions.
Result<SpatialSum> solid_inside(const ExactSet& surface, InsideRule rule, const SpatialOptions& options);

}  // namespace dymsum::spatial
