// Doubles that are next to each other, and sums that are rounded to one side.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "base/doubles.h"

namespace dymsum::uncertain {

/// a + b rounded away from a, so that nothing between them is left out.
inline double sum_outwards(double a, double b) {
  const double s = a + b, of_b = s - a, rest = (a - (s - of_b)) + (b - of_b);  // a + b == s + rest
  if (rest == 0 || (rest > 0) != (b > 0)) return s;
  return std::nextafter(s, b > 0 ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity());
}

/// The double that is so many doubles away; doubles in order are these integers in order, both zeros being 0.
inline double steps_from(double v, std::int64_t steps) {
  constexpr std::int64_t kSign = std::numeric_limits<std::int64_t>::min();
  const auto bits = base::bit_cast<std::int64_t>(v);
  const std::int64_t at = (bits < 0 ? kSign - bits : bits) + steps;
  return base::bit_cast<double>(at < 0 ? kSign - at : at);
}

}  // namespace dymsum::uncertain
