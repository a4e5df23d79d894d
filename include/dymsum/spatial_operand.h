// Results as operands: solids, and sums, inner fits and Boolean results of solids, wherever a solid is taken, exactly.
#pragma once

#include <span>
#include <variant>
#include <vector>

#include "dymsum/mesh.h"
#include "dymsum/progress.h"
#include "dymsum/rational.h"
#include "dymsum/result.h"
#include "dymsum/spatial_sum.h"

namespace dymsum {

/// What operations on solids take: a solid, or a result of another operation. It refers to it, and is meant for the
/// call alone.
///
/// A result is a closed set: its regular part, united with what is tight outside of that. So of an inner fit the
/// positions without room to move count, and of a sum that of parts without volume; what is tight in a sum of solids
/// lies within its regular part, and adds nothing. With regular semantics results are their regular parts. Nothing is
/// rounded: where doubles hold all vertices it is that solid, elsewhere signs are those of integers over a common
/// denominator of all vertices, or where that is long of fractions with denominators of their own, of any length.
class SpatialOperand {
 public:
  SpatialOperand(const Mesh& solid) : set_(&solid) {}          // NOLINT(google-explicit-constructor)
  SpatialOperand(const SpatialSum& result) : set_(&result) {}  // NOLINT(google-explicit-constructor)

  const std::variant<const Mesh*, const SpatialSum*>& set() const { return set_; }

 private:
  std::variant<const Mesh*, const SpatialSum*> set_;
};

/// The sum of operands of either kind, exact as that of solids (spatial_sum.h). Faces name triangles and vertices of a
/// result's regular part as as_mesh would number them where it has nothing tight outside; of two operands by the same
/// planes (by_planes), those of what they were before they were mapped. Errors: as minkowski_sum.
Result<SpatialSum> minkowski_sum(const SpatialOperand& p, const SpatialOperand& q, const SpatialOptions& options = {});

/// Whether positions lie in the sum, as contains of solids determines it. The operands are prepared once. Errors: as
/// contains_each of solids.
Result<std::vector<bool>> contains_each(const SpatialOperand& p, const SpatialOperand& q,
                                        std::span<const RationalPoint3> positions,
                                        Semantics semantics = Semantics::closed, const Progress& progress = {});
Result<bool> contains(const SpatialOperand& p, const SpatialOperand& q, const RationalPoint3& z,
                      Semantics semantics = Semantics::closed);

}  // namespace dymsum
