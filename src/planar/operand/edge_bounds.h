// Bounds of signs of edge vectors in doubles.
#pragma once

#include "exact/rounding_bound.h"

namespace dymsum::planar {

/// Of x y' - y x' for vectors whose components carry one rounding each, times |x y'| + |y x'|: two of the factors, the
/// product and the difference.
inline constexpr double kEdgeCross = exact::rounding_bound(4, 8);
/// The same for those of a scaled or turned operand, which carry three each.
inline constexpr double kScaledEdgeCross = exact::rounding_bound(8, 16);
/// Of the difference of two such components, times the sum of both.
inline constexpr double kScaledEdgeGap = exact::rounding_bound(4, 8);

}  // namespace dymsum::planar
