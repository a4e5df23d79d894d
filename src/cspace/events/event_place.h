// Where in the plane of sums an event happens, and whether that place is certainly covered.
#pragma once

#include "cspace/events/overlap_filter.h"
#include "cspace/events/turn_events.h"

namespace dymsum::planar {

/// In the forms' doubles at heading h. A vertex for vertex events, for three segments the crossing of the two that are
/// least parallel, for alignments the vertex between the two edges, for overlaps the start of the first segment.
struct EventPlace {
  Point at;
  double sine = 1;  ///< at most that of the angle between the two segments: the place errs by its inverse
};
EventPlace place_of(const TurnEvent& event, const TurningForms& forms, Heading h);

/// Lines that cross at a smaller sine have no place that is known well enough.
inline constexpr double kPlacedSine = 0x1p-5;

/// Certainly inside the obstacle, where nothing is visible; false for nearly parallel segments and uncertain angles. Of
/// a vertex event or three segments.
bool certainly_covered(const TurnEvent& event, const TurningForms& forms, const OverlapFilter& filter);

}  // namespace dymsum::planar
