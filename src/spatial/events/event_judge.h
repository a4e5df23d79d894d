// What happens at a point where facets meet: whether the sum changes there, as the facets through it tell.
#pragma once

#include "dymsum/solid_scale_events.h"
#include "spatial/events/meeting_search.h"

namespace dymsum::spatial {

struct JudgedPoint {
  enum class Verdict : std::uint8_t {
    changes,  ///< the boundary changes, and its topology does not
    quiet,    ///< the topology does not change; sums have to be compared for the rest
    unknown,  ///< sums have to be compared
    covered,  ///< nothing changes: the point lies in the open sum
  };
  Verdict verdict = Verdict::unknown;
  EventKind kind = EventKind::vertex_on_facet;
  std::vector<std::uint32_t> facets;  ///< through the point, where the verdict is unknown
  bool is_general = false;            ///< their position is
};

/// By doubles. Statement and proof: docs/design/scaling-solids.md, "What the facets tell".
JudgedPoint judge(const MovingFacets& all, const EventSearch& search, const ScaledOverlap& overlap,
                  const MeetingEvent& event);

}  // namespace dymsum::spatial
