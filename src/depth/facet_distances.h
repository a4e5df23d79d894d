// Distances of a point to the planes of facets, in doubles with bounds of their errors.
#pragma once

#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "depth/facet.h"
#include "spatial/convex/posed_doubles.h"
#include "spatial/gauss/overlay.h"

namespace dymsum::spatial {

/// A vector 2^exponent v; every component has relative error below 2^-50.
struct ScaledVector {
  Vec3 v;
  int exponent = 0;
};

/// Everything is scaled by one power of two so that the largest of these is about 1: the extents of the posed operands,
/// the position of the sum of their first vertices as seen from the point. So nothing overflows, and what vanishes is
/// far below the bounds of errors, whatever the sizes of the solids.
class FacetDistances {
 public:
  /// `base`: the position of vertex 0 of P plus vertex 0 of Q, less the point.
  FacetDistances(const Overlay& overlay, const PosedDoubles& p, const PosedDoubles& q, const ScaledVector& base);

  /// The facets that may be nearest.
  std::vector<GenericFacet> candidates();

 private:
  void consider(const GenericFacet& facet, Vec3 n, Vec3 corner);
  Vec3 corner(const GenericFacet& facet) const;

  const Overlay& o_;
  std::array<Mat3, 2> map_, cofactors_;        // up to positive factors
  std::array<double, 3> spread_{0, 0, 1};      // bounds of the lengths of normals, by kind of facet
  std::array<std::vector<Vec3>, 2> position_;  // of every vertex, seen from vertex 0, P's also from the point
  double reach_ = 0;                           // a bound of the lengths of positions, and of their sum
  // What is known of the facets so far: an upper bound of the least distance, a little more than its square, and lower
  // bounds of the distances of those that may have it.
  double least_upper_ = std::numeric_limits<double>::infinity(), far_ = least_upper_;
  std::vector<std::pair<double, GenericFacet>> lower_;
};

}  // namespace dymsum::spatial
