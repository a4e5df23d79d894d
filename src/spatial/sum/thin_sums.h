// What parts without volume of both operands add to the closed sum where they do not even make a face: sums of
// segments and points with points and with segments parallel to them.
//
// Such a sum lies on no facet of the convolution, since every plane through it supports both. It is listed where it
// lies neither in the regular part of the sum nor on a face that others make.
#pragma once

#include <array>
#include <vector>

#include "dymsum/spatial_sum.h"
#include "spatial/convolution/solid_operand.h"
#include "spatial/convolution/sum_space.h"
#include "spatial/sum/sum_source.h"

namespace dymsum::spatial {

/// A segment, or a point where both ends are one, and what touches there. Ends are in the order of positions.
struct ThinSum {
  ExactPosition from, to;
  SolidContact contact;
};

/// Adds segments, with those that the sum has, as tight segments, each as long as its line allows, and points that lie
/// on none of them as tight points. `sources` have what touches on those that are new. Positions are in the units of
/// the sum's. O(k^2) for k segments, points and sources.
void add_tight_lines(SpatialSum& sum, std::vector<ThinSum> sources, std::vector<std::array<ExactPosition, 2>> segments,
                     std::vector<ExactPosition> points);

/// Adds these as tight segments, each as long as its line allows, and tight points. Requires a sum in the space's own
/// units without any of either. Exact, by rationals. O(k (k + n)) for k such sums and n triangles of the sum.
void add_thin_sums(SpatialSum& sum, const SumSpace& space, const SolidOperand& p, const SolidOperand& q);

}  // namespace dymsum::spatial
