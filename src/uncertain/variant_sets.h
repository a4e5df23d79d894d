// What finitely many sets have in common, and their union, where they differ only here and there.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "dymsum/planar_local_sum.h"
#include "dymsum/planar_operand.h"
#include "dymsum/result.h"
#include "dymsum/uncertain.h"

namespace dymsum::uncertain {

/// A box that holds all edges in which variants differ from the first one; nothing where they have the same edges. Off
/// it all variants are the same set: what their winding numbers differ by is that of closed chains of these edges.
std::optional<PlanarBox> differing_box(std::span<const Region> variants);

struct CommonAndAny {
  PlanarSum common, any;  ///< the intersection, and the union
};
/// Of closed sets that are the same off the inside of `window`; without one, that may differ everywhere. Each is cut to
/// the window, these small sets are intersected and united, and put into what the first set has outside: edges in which
/// all sets agree do not meet each other. Where the window is no smaller than the sets, Boolean operations of all of
/// them. Errors: as these.
Result<CommonAndAny> common_and_any(std::span<const PlanarOperand> sets, const std::optional<PlanarBox>& window,
                                    const SumOptions& options);

}  // namespace dymsum::uncertain
