// Distances of positions from triangles in space.
#pragma once

#include <array>
#include <optional>

#include "dymsum/mesh.h"
#include "exact/big.h"

namespace dymsum::check {

using RationalVector = std::array<exact::BigRational, 3>;
using ExactTriangle = std::array<RationalVector, 3>;

RationalVector minus_of(const RationalVector& a, const RationalVector& b);
exact::BigRational dot_of(const RationalVector& a, const RationalVector& b);
RationalVector cross_of(const RationalVector& a, const RationalVector& b);
/// At right angles to the triangle.
RationalVector normal_of(const ExactTriangle& t);

/// The nearest position of a triangle, and the square of its distance.
struct TriangleNearest {
  exact::BigRational squared;
  RationalVector at;
};
TriangleNearest nearest_on(const RationalVector& p, const ExactTriangle& t);

/// The squared distance of two segments and the positions that are so near, where these lie inside of both and the
/// segments are not parallel.
struct SegmentsNearest {
  exact::BigRational squared;
  RationalVector of_a, of_b;
};
std::optional<SegmentsNearest> nearest_inside(const RationalVector& a0, const RationalVector& a1,
                                              const RationalVector& b0, const RationalVector& b1);

/// The distance in doubles. Two of them differ from the exact distances by no more than this, times the largest
/// coordinate: triangles thinner than 2^-20 of their longest side count as their sides, others have a normal to 2^-30.
inline constexpr double kRoughDistance = 0x1p-17;
double rough_distance(const Point3& p, const std::array<Point3, 3>& t);

}  // namespace dymsum::check
