// The angles between which an event lies, from its root.
#pragma once

#include "cspace/events/rotation_events.h"
#include "exact/rounding_bound.h"

namespace dymsum::planar {

/// The error of the angle of a tangent, below 8: twice an arc tangent, half a turn as a double, their sum, and the sum
/// with this bound, which just below 4 may end at 4.
inline constexpr double kEventAngle = exact::rounding_bound(2 + 2 + 4 + 4, 16);

/// Requires event.root.
inline void set_angles(RotationEvent& event, const RotationRange& range) {
  event.low = range.theta(event.root->low()) - kEventAngle;
  event.high = range.theta(event.root->high()) + kEventAngle;
}

/// The same by the root to 60 binary digits, where what doubles know of it is far wider.
inline void narrow_angles(RotationEvent& event, const RotationRange& range) {
  exact::RootBracket bracket = event.root->bracket();
  bracket.refine_to(60);
  event.low = range.theta(exact::double_bounds(bracket.low().value()).first) - kEventAngle;
  event.high = range.theta(exact::double_bounds(bracket.high().value()).second) + kEventAngle;
}

}  // namespace dymsum::planar
