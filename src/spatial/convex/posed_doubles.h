// A pose in doubles, scaled so that nothing overflows or vanishes.
#pragma once

#include "spatial/gauss/relative_map.h"
#include "spatial/mesh/vec3.h"

namespace dymsum::spatial {

/// The pose x -> 2^exponent map x, and the map of its normals and area vectors, n -> (a positive factor) cofactors n.
/// The largest entries of both matrices are in [1, 2). Column j of the map is a column of a rotation times the factor
/// of axis j, column j of the cofactors one times those of the other two axes: every entry has relative error below
/// 2^-49.
struct PosedDoubles {
  Mat3 map, cofactors;
  int exponent = 0, cofactors_exponent = 0;  ///< det(A) A^-T = 2^cofactors_exponent cofactors for the pose A
  double determinant = 1;                    ///< of 2^exponent map, in units of 8^exponent

  explicit PosedDoubles(const PoseFactors& pose);
};

/// The power of two at or below the largest magnitude of the entries, which are not all zero.
int exponent_of(const Mat3& m);
Mat3 scaled_by_power(const Mat3& m, int exponent);

}  // namespace dymsum::spatial
