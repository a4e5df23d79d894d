// Offsets of solids, outward and inward, by a ball of plane facets whose error is known.
#pragma once

#include <cstddef>

#include "dymsum/mesh.h"
#include "dymsum/result.h"
#include "dymsum/spatial_operand.h"
#include "dymsum/spatial_sum.h"

namespace dymsum {

/// The side of the exact offset on which a result lies.
enum class OffsetBound : std::uint8_t {
  inside,   ///< contained in it: material that is provably there (the default)
  outside,  ///< containing it: room that is provably enough
};

/// A convex solid about the origin: the ball of radius `low` lies in it, and it in that of radius `high`.
struct TessellatedBall {
  Mesh mesh;
  double low = 0, high = 0;
};

/// A ball with high - low <= tolerance; inside: high <= radius, outside: low >= radius. Its facets are those of a
/// geodesic sphere, about 7 radius / tolerance of them, its coordinates have few digits. Errors: out_of_range for a
/// radius or a tolerance that is not a positive number, or one of less than 2^-14 of the radius.
Result<TessellatedBall> tessellated_ball(double radius, double tolerance, OffsetBound bound = OffsetBound::inside);

struct SolidOffset {
  SpatialSum solid;
  /// The exact offset by `low` lies in the result, and the result in the exact offset by `high`, high - low at most the
  /// tolerance: every point of its surface is at a signed distance from the operand between the two.
  double low = 0, high = 0;
  std::size_t ball_facets = 0;
};

/// The points at a distance of at most `distance` from the solid, or, for a negative one, the points of the solid at a
/// distance of at least -distance from its outside, up to the tolerance: the sum with a tessellated ball, or the inner
/// fit of one. That sum or fit is exact. inside: `high` <= distance, outside: `low` >= distance. Errors: out_of_range
/// as above, and for the distance 0; else as minkowski_sum and erode.
Result<SolidOffset> offset(const SpatialOperand& set, double distance, double tolerance,
                           OffsetBound bound = OffsetBound::inside, const SpatialOptions& options = {});

}  // namespace dymsum
