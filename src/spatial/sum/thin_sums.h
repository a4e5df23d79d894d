// What parts without volume of both operands add to the closed sum where they do not even make a face: sums of
// segments and points with points and with segments parallel to them.
//
// Such a sum lies on no facet of the convolution, since every plane through it supports both. It is listed where it
// lies neither in the regular part of the sum nor on a face that others make.
#pragma once

#include "dymsum/spatial_sum.h"
#include "spatial/convolution/solid_operand.h"
#include "spatial/convolution/sum_space.h"

namespace dymsum::spatial {

/// Adds these as tight segments, each as long as its line allows, and tight points. Requires a sum in the space's own
/// units without any of either. Exact, by rationals. O(k (k + n)) for k such sums and n triangles of the sum.
void add_thin_sums(SpatialSum& sum, const SumSpace& space, const SolidOperand& p, const SolidOperand& q);

}  // namespace dymsum::spatial
