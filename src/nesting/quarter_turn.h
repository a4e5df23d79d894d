// Quarter turns, which are exact in doubles.
#pragma once

#include "planar/region/region.h"

namespace dymsum::nesting {

/// Turned about the origin by that many quarters, from 0 to 3, counter-clockwise.
inline Point turned(Point p, int quarters) {
  switch (quarters) {
    case 1:
      return {0 - p.y, p.x};
    case 2:
      return {0 - p.x, 0 - p.y};
    case 3:
      return {p.y, 0 - p.x};
    default:
      return p;
  }
}

inline RegionData turned(RegionData data, int quarters) {
  planar::for_each_chain(data, [quarters](std::vector<Point>& points) {
    for (Point& p : points) p = turned(p, quarters);
  });
  return data;
}

}  // namespace dymsum::nesting
