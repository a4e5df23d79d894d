// Sums of convex solids within a budget of memory.
#pragma once

#include <cstdint>

#include "dymsum/convex_sum.h"

namespace dymsum {

/// ConvexSum::create(p, q) that holds at most `memory` bytes (ConvexSum::bytes), prepared operands included; 0: no
/// limit. What moving it and solid() take comes on top. Errors also: out_of_memory, found out before more than about
/// the limit is taken, or what the operands alone need.
Result<ConvexSum> convex_sum_within(const Mesh& p, const Mesh& q, std::uint64_t memory);
Result<ConvexSum> convex_sum_within(const SpatialSum& p, const Mesh& q, std::uint64_t memory);

}  // namespace dymsum
