// Placements that are tight along a curve of angles.
#pragma once

#include <vector>

#include "cspace/events/turn_events.h"

namespace dymsum::planar {

/// What two sorted lists have in common, and what only one of them has.
std::vector<AlwaysConcurrent> common_curves(const std::vector<AlwaysConcurrent>& before,
                                            const std::vector<AlwaysConcurrent>& behind);
std::vector<AlwaysConcurrent> other_curves(const std::vector<AlwaysConcurrent>& before,
                                           const std::vector<AlwaysConcurrent>& behind);

}  // namespace dymsum::planar
