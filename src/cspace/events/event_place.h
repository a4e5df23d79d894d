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

/// Certainly inside the obstacle, where nothing is visible. The margins of the filter, 2^-36 of the span, are wider
/// than what places err, 2^-41 by rounding and 2^-38 by the angle; false for nearly parallel segments and uncertain
/// angles. Of a vertex event or three segments.
bool certainly_covered(const TurnEvent& event, const TurningForms& forms, const OverlapFilter& filter);

}  // namespace dymsum::planar
