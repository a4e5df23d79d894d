// Areas of any size as text, for those outside of the range of doubles, where area() is zero or infinity.
#pragma once

#include <string>

#include "dymsum/planar_sum.h"
#include "dymsum/region.h"

namespace dymsum {

/// The exact area as a decimal number of 17 significant digits, correctly rounded (ties to even), and an exponent:
/// "1.2345678901234567e+400", "0" for zero. Cost: that of PlanarSum::area.
std::string area_text(const PlanarSum& sum);
/// The same of a region. O(n) operations on exact numbers.
std::string area_text(const Region& region);

}  // namespace dymsum
