// Thin parts of both operands that can cross each other, so that a small motion does not part them.
#pragma once

#include <cstdint>
#include <optional>

#include "spatial/convolution/solid_operand.h"
#include "spatial/convolution/sum_space.h"

namespace dymsum::spatial {

/// A plate of one operand, and a plate or a segment of the other one that is not parallel to it.
struct ThinCrossing {
  std::uint32_t p = 0, q = 0;  ///< faces of the operands' meshes
};

/// The first one, or nothing: then the sum of all thin parts of P and Q has no interior. Exact. O(m + n) for m and n
/// plates, O(m k) for m plates and k segments of the other operand.
std::optional<ThinCrossing> find_thin_crossing(const SumSpace& space, const SolidOperand& p, const SolidOperand& q);

/// Thrown where the open sum is requested: such parts have none.
struct NoOpenSum {
  ThinCrossing parts;
};

}  // namespace dymsum::spatial
