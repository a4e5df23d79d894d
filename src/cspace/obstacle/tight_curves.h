// Placements that are tight along a curve of angles.
#pragma once

#include <vector>

#include "cspace/events/rotation_events.h"
#include "cspace/obstacle/sweep_scene.h"

namespace dymsum::planar {

/// Returns those of some threes that meet in a tight position at an angle between events; sorted. Requires the boundary
/// there.
std::vector<AlwaysConcurrent> tight_curves(const SweepScene& scene, const std::vector<AlwaysConcurrent>& threes,
                                           const Orientation& at, const OverlapFilter& filter);

/// What two sorted lists have in common, and what only one of them has.
std::vector<AlwaysConcurrent> common_curves(const std::vector<AlwaysConcurrent>& before,
                                            const std::vector<AlwaysConcurrent>& after);
std::vector<AlwaysConcurrent> other_curves(const std::vector<AlwaysConcurrent>& before,
                                           const std::vector<AlwaysConcurrent>& after);

}  // namespace dymsum::planar
