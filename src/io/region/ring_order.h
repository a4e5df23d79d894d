// Rings of formats that leave orientation or nesting to the reader.
#pragma once

#include <vector>

#include "dymsum/region.h"

namespace dymsum::io {

/// 1 when a ring that does not cross itself runs counter-clockwise, -1 clockwise; 0 when it encloses nothing or has a
/// spike at its lexicographically smallest vertex. Exact: the lowest ray at that vertex leaves it exactly when the ring
/// runs counter-clockwise. Requires finite coordinates. Cost: O(n).
int ring_sign(const Ring& ring);

/// Outer ring counter-clockwise, holes clockwise; the first vertex stays first. Rings of sign 0 stay as they are.
void orient_rings(Part& part);

/// What counts as inside of rings that lie around one another: places inside an odd number of them, or those around
/// which they wind at all.
enum class FillRule { even_odd, nonzero };

/// Nesting of rings that do not cross. Even-odd: a ring inside an even number of others starts a part, one inside an
/// odd number is a hole of the innermost ring around it. Nonzero: the same of those rings that bound what is filled;
/// others are left out, and where rings cross none is. Exact. Rings are oriented; parts come in the order of their
/// outer rings. Returns false, with `parts` unchanged, when that would take more than about 10^9 steps (thousands of
/// large rings, or tens of thousands of small ones, around one another). Rings that cross are put somewhere: validation
/// finds them.
bool nest_rings(std::vector<Ring> rings, std::vector<Part>& parts, FillRule rule = FillRule::even_odd);

}  // namespace dymsum::io
