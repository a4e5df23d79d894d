// What is left of a solid when another one has to fit inside, and the two operations made of it: opening and closing.
#pragma once

#include "dymsum/mesh.h"
#include "dymsum/result.h"
#include "dymsum/spatial_operand.h"
#include "dymsum/spatial_sum.h"

namespace dymsum {

/// A (-) B = { x : x + B inside A }, the inner fit: the positions of B's reference point, the origin of its
/// coordinates, at which B lies inside A. (Others write A (-) -B for this set.) The faces of the result bound the
/// positions with room to move and are seen from outside of these; its tight features are the positions without: a
/// plate as thick as its slot has a face of them, a peg as wide as its tunnel a segment, a key in its cavity a point.
/// Contacts name features of A and B. Exact. The result has no volume and no tight features where B fits nowhere.
/// Parts without volume count in B; in A they hold nothing of a B that has none. Cost: that of the sum of A with a box
/// around it, and -B. Errors: as minkowski_sum; unsupported_operand for an empty B (every position holds it), where
/// both have parts without volume, and where A is too far from the origin to put a box around it.
Result<SpatialSum> erode(const Mesh& a, const Mesh& b, const SpatialOptions& options = {});
/// The same of results, unrounded.
Result<SpatialSum> erode(const SpatialOperand& a, const SpatialOperand& b, const SpatialOptions& options = {});

/// What becomes of positions between two operations that are no doubles.
enum class BetweenSteps : std::uint8_t {
  exact,    ///< they are fractions, and the result is exact (the default)
  rounded,  ///< each coordinate to the nearest double, or where nothing is tight and faces cross then, as
            ///< SpatialSum::rounded; SolidOpening reports how far that moved them. Error rounding_changed_topology with
            ///< the position where that leaves less of a tight face or segment, or faces cross beside tight features
};

struct SolidOpening {
  SpatialSum solid;
  /// No vertex between the two operations was moved by more than this; 0: the result is exact.
  double moved = 0;
};

/// (A (-) B) (+) B: the union of all x + B inside A. What is tight in A (-) B counts, positions without room to move:
/// a channel opened by itself is itself. With Semantics::regular it does not, and only what B covers in positions with
/// room to move is left. The result's own tight features are those of the open sum with int B, such as the seam
/// between two copies of B side by side. Exact; where vertices of A (-) B are fractions, as those of most solids whose
/// faces are not parallel to the axes, signs cost more: see BetweenSteps.
Result<SolidOpening> opening(const SpatialOperand& a, const SpatialOperand& b, const SpatialOptions& options = {},
                             BetweenSteps between = BetweenSteps::exact);

/// (A (+) B) (-) B: all positions that no x - B outside of A reaches. Likewise.
Result<SolidOpening> closing(const SpatialOperand& a, const SpatialOperand& b, const SpatialOptions& options = {},
                             BetweenSteps between = BetweenSteps::exact);

}  // namespace dymsum
