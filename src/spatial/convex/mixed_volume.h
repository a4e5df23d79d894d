// The volume of a sum of convex solids from the extreme vertices alone:
// V(P + Q) = V(P) + sum over faces f of P of |f| h_Q(n_f) + sum over faces g of Q of |g| h_P(n_g) + V(Q), with support functions h (Minkowski).
#pragma once

#include "dymsum/rotation.h"
#include "exact/big.h"
#include "spatial/convex/overlay.h"

namespace dymsum::spatial {

exact::BigRational exact_mixed_volume(const Overlay& overlay, const SolidPose& p, const SolidPose& q);
double mixed_volume(const Overlay& overlay, const PoseFactors& p, const PoseFactors& q);

/// rotation diag(scale) in doubles, every entry with relative error below 2^-49.
Mat3 pose_matrix(const PoseFactors& pose);
/// det(m) m^-T: what m makes of area vectors and normals.
Mat3 cofactors(const Mat3& m);

}  // namespace dymsum::spatial
