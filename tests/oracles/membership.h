// Membership in a Minkowski sum by definition: z lies in P (+) Q exactly when P meets z - Q. Nothing is summed: the
// two sets are laid on each other and compared edge by edge.
#pragma once

#include <array>
#include <vector>

#include "dymsum/region.h"
#include "numbers.h"

namespace dymsum::oracles {

/// The pieces of a region: `rim` the edges of the parts with the interior on their left, cut where another
/// ring touches them, `lines` the edges of the polylines,
/// `dots` the points; `corners` all vertices of rim and lines.
template <class N>
struct Pieces {
  std::vector<Seg<N>> rim, lines;
  std::vector<Pt<N>> dots, corners;
};

template <class N>
Pieces<N> pieces_of(const RegionData& region);

/// Answers for one pair of regions at many places z. Exact; each answer costs O(nm) and more when the sets touch.
template <class N>
class Membership {
 public:
  Membership(const RegionData& p, const RegionData& q);

  /// P meets z - Q: z in P (+) Q.
  bool meets(const Pt<N>& z) const;
  /// As meets(), but not through a polyline or point of P against a polyline or point of Q.
  bool meets_with_area(const Pt<N>& z) const;
  /// int P meets z - Q, or P meets z - int Q.
  bool overlaps(const Pt<N>& z) const;
  /// z + Q lies in P, where P has parts only.
  bool holds(const Pt<N>& z) const;

 private:
  Pieces<N> p_, q_;
};

/// The same answers for a single position.
bool meets_closed(const RegionData& p, const RegionData& q, const Pt<Big>& z);
bool overlaps_open(const RegionData& p, const RegionData& q, const Pt<Big>& z);
bool holds_closed(const RegionData& p, const RegionData& q, const Pt<Big>& z);

extern template class Membership<Small>;
extern template class Membership<Big>;

}  // namespace dymsum::oracles
