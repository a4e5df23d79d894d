// The rings of a robot or an obstacle by the numbers that contacts have (CspaceObstacle::create).
#pragma once

#include "dymsum/region.h"

namespace dymsum::apps {

/// Calls f(ring) for every ring of a region; a polyline of n vertices is walked there and back, as a ring of 2 (n - 1),
/// and a point is a ring of one.
template <class F>
void for_each_ring(const Region& region, F&& f) {
  for (const Part& part : region.parts()) {
    f(part.outer);
    for (const Ring& hole : part.holes) f(hole);
  }
  for (const Polyline& line : region.polylines()) {
    Ring ring(line);
    for (std::size_t k = line.size() - 1; k-- > 1;) ring.push_back(line[k]);
    f(ring);
  }
  for (const Point& point : region.points()) f(Ring{point});
}

}  // namespace dymsum::apps
