// Where along a site a disc can touch another site, as far as these two are concerned.
#pragma once

#include <array>
#include <cstdint>

#include "shape/complex/order.h"

namespace dymsum::shape {

struct Interval {
  Mark low, high;
};
struct Domain {
  std::array<Interval, 2> intervals;
  int count = 0;
  void add(Mark low, Mark high) { intervals[static_cast<std::size_t>(count++)] = {low, high}; }
};

/// A superset within which Formulas::function(s, j) is the disc's. At a vertex the function may be negative in it,
/// where no disc touches both. Empty where no disc does; ends may lie beyond the section's. Exact.
Domain domain(Order& order, const Section& s, std::uint32_t j);

}  // namespace dymsum::shape
