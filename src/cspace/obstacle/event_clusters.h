// Events at one angle by what they change: each changes the boundary around its own position only, so that events at
// different positions are handled one by one even if a segment takes part in several of them.
#pragma once

#include <vector>

#include "cspace/events/rotation_events.h"
#include "cspace/obstacle/sweep_scene.h"

namespace dymsum::planar {

/// Events at one angle, or some of them.
using EventGroup = std::vector<RotationEvent*>;

/// Segments that take part in an event, by index, and perhaps some that only nearly do.
std::vector<std::uint32_t> segments_of(const RotationEvent& event, const SweepScene& scene);

/// Parts that share no segment, or only at positions that are apart.
std::vector<EventGroup> clusters(const EventGroup& group, const SweepScene& scene);

}  // namespace dymsum::planar
