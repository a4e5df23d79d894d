// Exact scales at which segments begin or cease to meet.
#pragma once

#include <functional>
#include <vector>

#include "dymsum/scaling_sum.h"
#include "planar/scaling/exact_forms.h"
#include "planar/scaling/window.h"

namespace dymsum::planar {

struct EventValue {
  exact::BigRational s;
  ScaleEvent::Kind kind = ScaleEvent::Kind::vertex_on_segment;
};

/// All events in [low, high] among the segments live in a window, sorted, each value once. Every scale there at which
/// the boundary's combinatorics change is among them. `again` is called every so many pairs: it throws to stop.
std::vector<EventValue> events_of(const Window& window, const ExactForms& forms, const exact::BigRational& low,
                                  const exact::BigRational& high, const std::function<void()>& again);

}  // namespace dymsum::planar
