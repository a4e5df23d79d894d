// Integers of any size as intervals of thirty digits, or of seventy.
#pragma once

#include "exact/algebraic_root.h"
#include "exact/big.h"
#include "exact/interval.h"

namespace dymsum::spatial {

/// v 2^shift. Requires that to be at most 1 in magnitude.
exact::FineInterval fine_coordinate(const exact::Big& v, int shift);
/// The same of a value at a root.
exact::FineInterval fine_coordinate(const exact::RootValue& v, int shift);
/// The same with all digits that a WideInterval has.
exact::WideInterval wide_coordinate(const exact::RootValue& v, int shift);

}  // namespace dymsum::spatial
