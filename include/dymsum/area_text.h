// Areas of any size as text: for those outside the range of doubles, which area() gives as zero or infinity.
#pragma once

#include <string>

#include "dymsum/planar_sum.h"
#include "dymsum/region.h"

namespace dymsum {

/// The exact area as a decimal number of 17 significant digits, correctly rounded (ties to even), and an exponent:
/// "1.2345678901234567e+400", "0" for zero. As area() needs the fraction only where the area is a tie.
std::string area_text(const PlanarSum& sum);
/// O(n) operations on exact numbers.
std::string area_text(const Region& region);

}  // namespace dymsum
