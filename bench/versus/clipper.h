// Clipper, the permissive but inexact choice: coordinates are scaled to integers and every crossing is rounded to that
// grid.
#pragma once

#include "dymsum/region.h"
#include "versus/rival.h"

namespace dymsum::bench {

enum class Clipper {
  six,  ///< Debian's libpolyclipping-dev
  two,  ///< Clipper2, from its sources, where the build has them (`./run bench planar` fetches them)
};

/// MinkowskiSum, which sums the two boundaries, joined with a translate of each operand to fill the inside; in a forked
/// child, stopped after `limit_s` seconds. Paths are made before the clock starts, on one integer grid for both
/// operands. Each operand has to be one part; without holes, as MinkowskiSum takes single paths.
RivalAnswer clipper_sum_in_child(Clipper which, const RegionData& p, const RegionData& q, const Repeats& repeats,
                                 double limit_s);

}  // namespace dymsum::bench
