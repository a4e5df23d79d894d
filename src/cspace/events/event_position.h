// The position in the plane of sums at which an event happens, and whether that position is provably covered.
#pragma once

#include "cspace/events/overlap_filter.h"
#include "cspace/events/rotation_events.h"

namespace dymsum::planar {

/// The position in the forms' doubles at heading h: a vertex for vertex events, for three segments the crossing of the
/// two that are least parallel, for alignments the vertex between the two edges, for overlaps the start of the first
/// segment.
struct EventPosition {
  Point at;
  double sine = 1;  ///< at most that of the angle between the two segments: the position errs by its inverse
};
EventPosition position_of(const RotationEvent& event, const TurningForms& forms, Heading h);

/// Lines that cross at a smaller sine have no position that is known well enough.
inline constexpr double kPlacedSine = 0x1p-5;

/// Provably inside the obstacle, where nothing is visible; false for nearly parallel segments and uncertain angles. Of
/// a vertex event or three segments.
bool provably_covered(const RotationEvent& event, const TurningForms& forms, const OverlapFilter& filter);

}  // namespace dymsum::planar
