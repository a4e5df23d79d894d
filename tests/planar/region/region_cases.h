// Small makers of regions for the tests of Region.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "dymsum/region.h"

namespace dymsum::test {

inline Ring reversed(Ring ring) {
  std::reverse(ring.begin() + 1, ring.end());
  return ring;
}

inline Ring box(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

inline RegionData one_ring(Ring ring) { return {{{std::move(ring), {}}}, {}, {}}; }

inline RegionData with_holes(Ring outer, std::vector<Ring> holes) {
  return {{{std::move(outer), std::move(holes)}}, {}, {}};
}

inline RegionData two_parts(Ring a, Ring b) { return {{{std::move(a), {}}, {std::move(b), {}}}, {}, {}}; }

}  // namespace dymsum::test
