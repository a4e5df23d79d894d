// A solid result under a linear map and a translation, exactly: the same faces, with its vertices in their new order.
#pragma once

#include <array>
#include <functional>
#include <optional>

#include "dymsum/spatial_sum.h"
#include "exact/big.h"
#include "spatial/mesh/vec3.h"

namespace dymsum::spatial {

/// x -> rows x + shift, of doubles at face value.
struct AffineMap {
  Mat3 rows{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  std::array<exact::BigRational, 3> shift;
};
bool same_linear_part(const AffineMap& a, const AffineMap& b);

/// What a mapped result was made from. Sums commute with linear maps, so that two with the same linear part are added
/// before they are mapped.
struct MappedSum {
  SpatialSum base;
  AffineMap map;
};

/// The image, with the result's contacts. Requires a determinant that is not 0. O(n log n).
SpatialSum mapped_sum(SpatialSum base, AffineMap map);

/// An operation of two results that are images of solids in doubles under maps with one linear part, done with these
/// and mapped after that: with the first one's shift, and the second one's times `sign`. Nothing for other results.
std::optional<Result<SpatialSum>> before_mapping(
    const SpatialSum& p, const SpatialSum& q, int sign,
    const std::function<Result<SpatialSum>(const Mesh&, const Mesh&)>& operation);

}  // namespace dymsum::spatial
