// All vertices of a region, by nothing of the library but its data.
#pragma once

#include <vector>

#include "dymsum/region.h"

namespace dymsum::oracles {

/// Calls f(v) for every vertex, which it may change.
template <class F>
void for_each_vertex(RegionData& region, const F& f) {
  const auto all = [&](std::vector<Point>& list) {
    for (Point& v : list) f(v);
  };
  for (Part& part : region.parts) {
    all(part.outer);
    for (Ring& hole : part.holes) all(hole);
  }
  for (Polyline& line : region.polylines) all(line);
  all(region.points);
}

/// The region with f(v) for every vertex v.
template <class F>
RegionData vertices_by(RegionData region, const F& f) {
  for_each_vertex(region, [&](Point& v) { v = f(v); });
  return region;
}

}  // namespace dymsum::oracles
