// Facets that move with a scale, in pairs: forms of small coordinates in integers of 128 bits.
#pragma once

#include <optional>

#include "spatial/events/moving_facets.h"

namespace dymsum::spatial {

/// A linear function of the scale, a + s b: each within 2^-52 of its size, so zero only where it is zero.
struct ProvedForm {
  double a = 0, b = 0;
};

class PairFacets : public MovingFacets {
 public:
  PairFacets(ScalingPair of, StageWatch& watch);

  /// Whether corners are sums with the same vertex of the operand that does not scale, or of that which does.
  bool same_fixed(SumPoint a, SumPoint b) const { return moving() == 0 ? a.q == b.q : a.p == b.p; }
  bool same_moved(SumPoint a, SumPoint b) const { return moving() == 0 ? a.p == b.p : a.q == b.q; }
  /// The height of a corner over a facet's plane, times the length of its normal; nothing where coordinates are too
  /// large for 128 bits.
  std::optional<ProvedForm> proved_height(SumPoint corner, std::uint32_t facet) const;
  /// det(e, h, gap) for two borders, without the scale in their lengths, and the gap from e's beginning to h's.
  std::optional<ProvedForm> proved_twist(const SumEdge& e, const SumEdge& h) const;

 private:
  using SmallVector = std::array<std::int64_t, 3>;
  /// n . (to - from).
  ProvedForm form_of(const SmallVector& n, SumPoint from, SumPoint to) const;

  bool small_ = false;                                // all coordinates are
  std::array<std::vector<SmallVector>, 2> integers_;  // where they are small, as are the normals
  std::vector<SmallVector> small_normals_;
};

}  // namespace dymsum::spatial
