// The rings of a sum, and those that they lie in.
#pragma once

#include "planar/position/exact_source.h"

namespace dymsum::planar {

/// A box that contains a ring's exact positions.
struct RingBox {
  double min_x, min_y, max_x, max_y;
};

RingBox box_of(const SumRing& ring, double at_error);
bool boxes_disjoint(const RingBox& a, const RingBox& b);

/// True when `inner` lies in the closed bounded side of `outer`. Requires: the two rings do not cross and differ; they
/// may touch at points. Doubles decide when a point of `inner` is clear of `outer`; positions of the source otherwise.
/// O(n + m); exact fallback O(n m) at worst, when all of inner's vertices lie on outer.
bool ring_contains(const SumRing& outer, const SumRing& inner, const ExactSource& source, double at_error);

}  // namespace dymsum::planar
