// The vertices of a region, list by list.
#pragma once

#include "dymsum/region.h"

namespace dymsum::planar {

/// Calls f(list) for all lists of vertices of a RegionData, which may be const, in the order of the vertex indices:
/// each part's outer ring and holes, polylines, points.
template <class Data, class F>
void for_each_chain(Data& data, F f) {
  for (auto& part : data.parts) {
    f(part.outer);
    for (auto& hole : part.holes) f(hole);
  }
  for (auto& line : data.polylines) f(line);
  f(data.points);
}

}  // namespace dymsum::planar
