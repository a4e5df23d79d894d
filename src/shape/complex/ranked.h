// What discs touch, told without their positions: congruent pictures have equal keys.
#pragma once

#include <vector>

#include "shape/complex/exact_complex.h"

namespace dymsum::shape {

/// Integers; equal ones, not empty, mean discs of equal radius. Empty for descriptions that have no key. A mirror image
/// has the same key, and so mostly have equal parts of a symmetric shape. Exact.
std::vector<exact::BigInteger> congruence_key(const Walks& walks, const DiscSource& source);

}  // namespace dymsum::shape
