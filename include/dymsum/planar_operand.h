// Results as operands: a sum, an erosion, a Boolean result wherever a region is taken, exactly.
#pragma once

#include <span>
#include <variant>

#include "dymsum/planar_sum.h"
#include "dymsum/region.h"
#include "dymsum/result.h"

namespace dymsum {

/// What an operation takes: a region, or a result of another one. It refers to it, and is meant for the call alone.
///
/// A result is the closed set of its parts, segments and points, with vertices that may be any fractions. What open
/// semantics left out of it counts again; tight features are no part of it. Nothing is rounded: where all vertices are
/// doubles it is that region, elsewhere signs are those of integers of any size (SumStats::tier_bits is 0).
/// Vertices of a result have indices as those of a region: part by part, outer ring then holes, then the ends of its
/// segments, then its points.
class PlanarOperand {
 public:
  PlanarOperand(const Region& region) : set_(&region) {}     // NOLINT(google-explicit-constructor)
  PlanarOperand(const PlanarSum& result) : set_(&result) {}  // NOLINT(google-explicit-constructor)

  const std::variant<const Region*, const PlanarSum*>& set() const { return set_; }

 private:
  std::variant<const Region*, const PlanarSum*> set_;
};

/// The sum, the no-fit polygon and the erosion of planar_sum.h for operands of either kind, with the same results.
/// Where results are sums of any number of terms, unions of them or of regions, no number grows with the depth: their
/// convex corners are sums of vertices (docs/design/planar-operand.md). Each erosion, difference or intersection that a
/// sum follows multiplies the digits by up to three. Errors: as those of regions.
Result<PlanarSum> minkowski_sum(const PlanarOperand& p, const PlanarOperand& q, const SumOptions& options = {});
Result<PlanarSum> nfp(const PlanarOperand& a, const PlanarOperand& b, const SumOptions& options = {});
Result<PlanarSum> erode(const PlanarOperand& p, const PlanarOperand& q, const SumOptions& options = {});

/// The sum of all, one after the other. Provenance is that of the last step: `p` counts the vertices of the sum of all
/// but the last, `q` those of the last. So are tight features, and the semantics of the options. Errors: out_of_range
/// for no operand.
Result<PlanarSum> minkowski_sum(std::span<const PlanarOperand> sets, const SumOptions& options = {});

/// All of P that translates of Q inside P cover: the erosion, then the sum. Points and segments at which Q fits exactly
/// count. Empty where Q does not fit. Errors: as erode.
Result<PlanarSum> opening(const PlanarOperand& p, const PlanarOperand& q, const SumOptions& options = {});
/// P with all that translates of -Q outside of P do not reach: the sum, then the erosion. Errors: as erode of the sum.
Result<PlanarSum> closing(const PlanarOperand& p, const PlanarOperand& q, const SumOptions& options = {});

/// True when z lies in the sum, as contains of planar_sum.h.
bool contains(const PlanarOperand& p, const PlanarOperand& q, Point z, Semantics semantics = Semantics::closed);

}  // namespace dymsum
