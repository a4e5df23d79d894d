// Integers of any size as intervals of thirty digits.
#pragma once

#include "exact/big.h"
#include "exact/fine_interval.h"
#include "exact/root_value.h"

namespace dymsum::spatial {

/// v 2^shift. Requires that to be at most 1 in magnitude.
exact::FineInterval fine_coordinate(const exact::Big& v, int shift);
/// The same of a value at a root.
exact::FineInterval fine_coordinate(const exact::RootValue& v, int shift);

}  // namespace dymsum::spatial
