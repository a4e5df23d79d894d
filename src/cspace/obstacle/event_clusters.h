// Events at one angle by what they change: each changes the boundary around its own place only, so that events at
// different places are handled one by one even if a segment takes part in several of them.
#pragma once

#include <vector>

#include "cspace/events/turn_events.h"
#include "cspace/obstacle/sweep_scene.h"

namespace dymsum::planar {

/// Events at one angle, or some of them.
using EventGroup = std::vector<TurnEvent*>;

/// Segments that take part in an event, by index, and perhaps some that only nearly do.
std::vector<std::uint32_t> segments_of(const TurnEvent& event, const SweepScene& scene);

/// Parts that share no segment, or only at places that are apart.
std::vector<EventGroup> clusters(const EventGroup& group, const SweepScene& scene);

}  // namespace dymsum::planar
