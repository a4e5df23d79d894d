// Volume and surface of a convex sum, over one denominator.
#pragma once

#include <cstddef>

#include "dymsum/spatial_sum.h"
#include "exact/big.h"
#include "spatial/mesh/length_sum.h"

namespace dymsum::spatial {

/// The exact volume of a sum that is SpatialSum::is_convex. O(n).
exact::BigRational convex_volume(const SpatialSum& sum);
LengthSum convex_surface(const SpatialSum& sum);

/// Bits of the volume's denominator beyond powers of two, before it is reduced.
std::size_t convex_volume_bits(const SpatialSum& sum);

}  // namespace dymsum::spatial
