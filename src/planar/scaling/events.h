// Exact scales at which segments begin or cease to meet.
#pragma once

#include <functional>
#include <vector>

#include "dymsum/scaling_sum.h"
#include "planar/scaling/exact_forms.h"
#include "planar/scaling/exact_frame.h"
#include "planar/scaling/window.h"

namespace dymsum::planar {

struct EventValue {
  exact::BigRational s;
  ScaleEvent::Kind kind = ScaleEvent::Kind::vertex_on_segment;
  std::vector<Place> at;  ///< where something meets, each position once or more; in the units of the frame's lattice
};

/// All events in [low, high] among the segments live in a window, sorted, each value once, but for those that doubles
/// prove to lie in the open sum. Every scale there at which the boundary's combinatorics change is among them. `again`
/// is called every so many pairs: it throws to stop.
std::vector<EventValue> events_of(const Window& window, const ExactForms& forms, const exact::BigRational& low,
                                  const exact::BigRational& high, const std::function<void()>& again);

/// Whether all of its positions lie in the open sum, exactly: then nothing changes on the boundary. `frame`: of its
/// scale.
bool is_covered(const EventValue& event, ExactFrame& frame);

}  // namespace dymsum::planar
