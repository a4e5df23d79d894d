// What an engine finds, before canonical output.
#pragma once

#include <cstdint>
#include <vector>

#include "dymsum/planar_sum.h"

namespace dymsum::planar {

struct RawBoundary {
  std::vector<SumRing> rings;        ///< interior on the left
  std::vector<std::uint8_t> outer;   ///< per ring: counter-clockwise
  std::vector<SumSegment> cracks;    ///< closed sub-edges of tight segments, not merged
  std::vector<SumVertex> punctures;  ///< candidates that are not on cracks are tight points
  double at_error = 0;               ///< |at - exact| in input coordinates
  bool may_touch = true;             ///< rings may touch one another

  void add(SumRing ring, bool counter_clockwise) {
    rings.push_back(std::move(ring));
    outer.push_back(counter_clockwise);
  }
};

}  // namespace dymsum::planar
