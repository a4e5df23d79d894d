// Integers of any size, and their fractions, as intervals of thirty digits, or of seventy.
#pragma once

#include "exact/big.h"
#include "exact/fine_interval.h"
#include "exact/fraction.h"
#include "exact/root_value.h"
#include "exact/wide_interval.h"

namespace dymsum::spatial {

/// v 2^shift. Requires that to be at most 1 in magnitude.
exact::FineInterval fine_coordinate(const exact::Big& v, int shift);
/// The same of a value at a root.
exact::FineInterval fine_coordinate(const exact::RootValue& v, int shift);
exact::FineInterval fine_coordinate(const exact::Fraction& v, int shift);
/// The same with all digits that a WideInterval has.
exact::WideInterval wide_coordinate(const exact::RootValue& v, int shift);
exact::WideInterval wide_coordinate(const exact::Fraction& v, int shift);

}  // namespace dymsum::spatial
