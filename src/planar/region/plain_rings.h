// The common case of validation: rings that stay apart everywhere and are nested as they should be, proved without a
// sweep.
#pragma once

#include "dymsum/region.h"

namespace dymsum::planar {

/// True only for a valid region (see Region) of one part or more, without polylines and points, whose rings touch
/// nowhere: every two edges that do not follow each other are disjoint and no edge folds back on the one before. False
/// says nothing: the data are to be looked at in full, which finds the evidence. Exact: boxes in monotone quanta
/// distinguish most pairs of edges, signs of orientations the others. O(n) in practice: it stops, with false, past a
/// constant number of pairs a vertex.
bool plainly_valid(const RegionData& data);

}  // namespace dymsum::planar
