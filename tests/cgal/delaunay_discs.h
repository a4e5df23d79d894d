// The discs of CGAL's segment Delaunay graph, with an exact kernel: those that touch three sites of a boundary and hold
// none inside. (package Segment_Delaunay_graph_2)
#pragma once

#include <array>
#include <vector>

#include "dymsum/region.h"

namespace dymsum::sdg {

/// Each contains the exact number, some units in the last place wide.
struct Disc {
  std::array<double, 2> x, y, radius2;
};

/// Of the closed segments of all rings, on both sides of the boundary. One disc that touches more sites comes several
/// times. Seconds for a hundred segments.
std::vector<Disc> discs_of(const RegionData& region);

}  // namespace dymsum::sdg
