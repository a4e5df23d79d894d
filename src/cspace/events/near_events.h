// Events of a narrow window around an angle at which many edges are aligned but for a rounding: hundreds of lines
// through one position, and of the events of all their combinations hardly one on the boundary.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "cspace/events/near_angle.h"
#include "cspace/events/overlap_filter.h"
#include "planar/motion/turning_forms.h"

namespace dymsum::planar {

/// Events by the indices of the window's segments.
struct NearEvents {
  struct Vertex {
    std::uint32_t segment = 0;
    Pair at;
    std::vector<NearRoot> where;
  };
  struct Triple {
    std::array<std::uint32_t, 3> segments;
    std::vector<NearRoot> where;  ///< at which angles
  };
  std::vector<Triple> triples;
  std::vector<Vertex> vertices;
  std::uint64_t looked_at = 0;  ///< triples
};

/// The triples of segments that may meet, and the vertices that may come onto a segment, in a window around an angle; a
/// superset, less those at positions that are covered at the event's angle: where a vertex of one operand lies in the
/// interior of the other one, which its position beside an edge there decides, by numbers that are known to all digits.
/// `end_left_out`: without those at the very end of the window, where that is the angle; never with those at its
/// beginning. `again` is called now and then: it throws to stop.
NearEvents near_events(const EventWindow& window, const TurningForms& forms, const NearAngle& angle,
                       const OverlapFilter& filter, bool end_left_out, const std::function<void()>& again);

}  // namespace dymsum::planar
