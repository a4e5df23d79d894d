// The whole sum by definition: cut the plane by every edge + vertex of the operands, request each vertex, edge and face
// of that arrangement whether it belongs to the sum, and keep what separates the answers. For tiny operands.
#pragma once

#include <functional>
#include <vector>

#include "dymsum/planar_sum.h"
#include "membership.h"

namespace dymsum::oracles {

/// What the result of a sum must be. All lists sorted.
template <class N>
struct ReferenceSum {
  std::vector<Pt<N>> stops;      ///< every vertex of the arrangement
  std::vector<Seg<N>> rim;       ///< boundary of the parts, cut at every stop, interior on the left
  std::vector<Seg<N>> segments;  ///< maximal, a < b
  std::vector<Pt<N>> points;
  std::vector<Seg<N>> tight_segments;  ///< maximal, a < b
  std::vector<Pt<N>> tight_points;
  std::size_t cells_queried = 0;
};

/// P (+) Q. closed: M, with the tight part T = F \ cl int F for F the complement of the open sum; where both operands
/// have polylines or points, these add to M outside the closure of the open sum and T is not reported. open: the same
/// as if such pairs added nothing, with T. regular: parts only.
template <class N>
ReferenceSum<N> reference_sum(const RegionData& p, const RegionData& q, Semantics semantics);

/// { x : x + Q inside P }; its segments and points are its tight features.
template <class N>
ReferenceSum<N> reference_erode(const RegionData& p, const RegionData& q);

/// Of a Boolean expression: `closed` is what it is of closed sets, `open` of open ones, given these of every input;
/// what is taken away of a closed set is open. Semantics as those of planar_boolean.h.
struct ClosedAndOpen {
  bool closed = false, open = false;
};
using BooleanExpression = std::function<ClosedAndOpen(const std::vector<ClosedAndOpen>&)>;
template <class N>
ReferenceSum<N> reference_boolean(const std::vector<RegionData>& inputs, const BooleanExpression& expression,
                                  Semantics semantics);

/// True when a polyline or point of p meets a polyline or point of q in the sum's definition: both have some.
bool has_thin_pair(const RegionData& p, const RegionData& q);

extern template struct ReferenceSum<Small>;
extern template struct ReferenceSum<Big>;

}  // namespace dymsum::oracles
