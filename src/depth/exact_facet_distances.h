// Exact distances of a point to the planes of facets.
#pragma once

#include <array>
#include <optional>

#include "depth/facet.h"
#include "depth/facet_distances.h"
#include "exact/big.h"
#include "exact/vector3.h"
#include "spatial/convex/convex_state.h"

namespace dymsum::spatial {

/// The square of a distance, up to a factor that all share, with the sign of the distance: num / size.
struct SignedSquare {
  exact::Big num, size;
  bool operator<(const SignedSquare& other) const { return (num * other.size).value() < (other.num * size).value(); }
};

/// Everything in integers: places as multiples of 2^exponent / den.
class ExactFacetDistances {
 public:
  ExactFacetDistances(const spatial::ConvexState& s, Point3 point);

  /// Nothing for crossings of parallel edges, which are no facets.
  std::optional<SignedSquare> signed_square(const GenericFacet& facet) const;
  /// The number itself.
  exact::BigRational value(const SignedSquare& s) const;
  /// An outward normal.
  exact::Vector3<exact::Big> normal(const GenericFacet& facet) const;
  /// The position of vertex 0 of P plus vertex 0 of Q, less the point.
  ScaledVector base() const;

 private:
  exact::Vector3<exact::Big> position(std::uint32_t p, std::uint32_t q) const;

  const spatial::ConvexState& s_;
  std::array<exact::Matrix3<exact::Big>, 2> m_;  // of the poses, over their own denominators
  std::array<exact::Big, 2> unit_;               // what vertices of an operand are multiplied with
  exact::Vector3<exact::Big> x_;
  exact::BigInteger den_;
  int exponent_ = 0;
};

}  // namespace dymsum::spatial
