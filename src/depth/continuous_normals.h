// Normals of a sum's boundary, averaged over a distance: a vector field that does not depend on how the boundary is
// cut.
#pragma once

#include "depth/continuous_surface.h"

namespace dymsum::depth {

/// The integral of the outward normals over the surface, weighted by (l^2 - r^2)^2 where r < l, at any position x, and
/// its derivative: row k holds the derivatives of component k.
///
/// By the divergence theorem it is minus the gradient of the volume of the solid around x, weighted by the same kernel:
/// it depends on the solid alone, and twice continuously differentiable on x off its edges, once everywhere.
struct SmoothedNormal {
  Vec3 value;
  spatial::Mat3 derivative{};
};
/// The smoothed normal in closed form, up to rounding. Requires the whole surface within l of x. O(n).
SmoothedNormal smoothed_normal(const ContinuousSurface& surface, double l, Vec3 x);

}  // namespace dymsum::depth
