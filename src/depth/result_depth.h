// The depth of results: solids whose vertices are fractions, by the boundary of the exact sum.
#pragma once

#include "depth/boundary_distance.h"
#include "dymsum/spatial_operand.h"
#include "dymsum/spatial_sum.h"
#include "spatial/sum/exact_locator.h"

namespace dymsum::depth {

/// The sum of P and -Q, asked about positions of Q.
class ResultDepth {
 public:
  /// Requires a sum that is not empty.
  explicit ResultDepth(SpatialSum sum) : sum_(std::move(sum)), locator_(sum_) {}

  std::size_t faces() const { return sum_.faces.size(); }
  /// Positions of the boundary, tight features included, that are nearest, relative to the position.
  std::vector<RationalVector> nearest(const RationalVector& from) const {
    return nearest_by_doubles_first(sum_, from).all;
  }
  /// Whether a position that is not on the boundary, nor tight, lies in the open sum.
  bool overlaps(const RationalVector& from) const { return locator_.of(from) == spatial::ExactLocator::Where::inside; }
  /// The least s >= 0 with from + s direction not in the open sum.
  exact::BigRational exit_along(const RationalVector& from, const RationalVector& direction) const;

 private:
  bool is_free(const RationalVector& at) const;
  void add_tight_crossings(const RationalVector& from, const RationalVector& to,
                           std::vector<exact::BigRational>& cuts) const;

  SpatialSum sum_;
  spatial::ExactLocator locator_;
};

/// The sum of P and -Q. Errors: as minkowski_sum.
Result<SpatialSum> sum_with_reflected(const SpatialOperand& p, const SpatialOperand& q, const SpatialOptions& options);

}  // namespace dymsum::depth
