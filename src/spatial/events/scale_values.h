// The scales at which a sum may change, in order, with what is known of each.
#pragma once

#include "spatial/events/event_judge.h"

namespace dymsum::spatial {

struct ScaleOfInterest {
  exact::BigRational s;
  EventKind kind = EventKind::vertex_on_facet;
  bool changes = false;           ///< surely
  bool unknown = false;           ///< sums have to be compared, unless it surely changes
  bool unknown_topology = false;  ///< in any case
};

/// All of them from `low` to `high`, and perhaps some just beside. Exact. Throws Cancelled.
std::vector<ScaleOfInterest> scales_of_interest(const MovingFacets& all, const ScaledOverlap& overlap, double low,
                                                double high, SolidEventWork& work, StageWatch& watch);

}  // namespace dymsum::spatial
