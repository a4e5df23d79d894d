// The angles between which an event lies, from its root.
#pragma once

#include "cspace/events/turn_events.h"
#include "exact/rounding_bound.h"

namespace dymsum::planar {

/// Of the angle of a tangent: twice an arc tangent, and its sum with half a turn, below 8.
inline constexpr double kEventAngle = exact::rounding_bound(2 + 4, 8);

/// Requires event.root.
inline void set_angles(TurnEvent& event, const TurnRange& range) {
  event.low = range.theta(event.root->low()) - kEventAngle;
  event.high = range.theta(event.root->high()) + kEventAngle;
}

}  // namespace dymsum::planar
