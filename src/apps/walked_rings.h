// The rings of a robot or an obstacle by the numbers that contacts have.
#pragma once

#include "dymsum/region.h"

namespace dymsum::apps {

/// Calls f(ring) for every ring of a region; a robot that is a segment is walked there and back, as a ring of two vertices, and a point is
/// a ring of one.
template <class F>
void for_each_ring(const Region& region, F&& f) {
  for (const Part& part : region.parts()) {
    f(part.outer);
    for (const Ring& hole : part.holes) f(hole);
  }
  for (const Polyline& segment : region.polylines()) f(segment);
  if (!region.points().empty()) f(region.points());
}

}  // namespace dymsum::apps
