// Whether two positions lie in one cell that the facets cut: then both are free, or neither is.
#pragma once

#include "depth/facet_lines.h"

namespace dymsum::depth {

/// Two positions in the plane of a facet, exactly, and within the slack where the position sees a and b: whether no
/// facet begins or ends on the way between them. Contact is constant along such a way, so one tells of the other. A
/// "no" says nothing. O(log n + k) for k facets near the way.
bool same_cell(const FacetView& view, const ExactFrame& frame, std::uint32_t facet, spatial::Vec3 a, spatial::Vec3 b);

/// Whether facets lie in one plane. Exact.
bool in_one_plane(const FacetView& view, const ExactFrame& frame, std::uint32_t f, std::uint32_t g);

}  // namespace dymsum::depth
