// A result as an operand of the next operation: its exact positions, and its rings as the engine wants them.
#pragma once

#include "dymsum/planar_sum.h"
#include "planar/region/engine_region.h"

namespace dymsum::planar {

/// The closed set of a result: its parts, segments (as polylines) and points; tight features are no part of it. Where
/// all positions are doubles the data are these. Rings that touch are cut and joined anew, as separate_touching does.
/// Vertices have the indices of the result's lists: part by part, outer ring then holes, then the ends of segments,
/// then points.
EngineRegion region_of_result(const PlanarSum& sum);

/// The positions of all vertices in that order, in lowest terms.
std::vector<exact::HomogeneousPoint> positions_of(const PlanarSum& sum);
/// Whether a position is this pair of doubles.
bool is_double(const exact::HomogeneousPoint& position, Point nearest);

}  // namespace dymsum::planar
