// What lies in R(theta) P (+) Q at some angle of an interval, and what lies in it at all of them, on the safe side.
#pragma once

#include "dymsum/orientation.h"
#include "dymsum/planar_sum.h"
#include "dymsum/progress.h"
#include "dymsum/region.h"

namespace dymsum::planar {

/// The sums are R(theta) `moves` (+) `stays`.
struct RotatedOperands {
  Region moves, stays;
};
RotatedOperands rotated_operands(const Region& p, const Region& q, bool p_moves, bool reflect_q);

/// As RotationFamily::outer and inner. Between an orientation and the next ones no point of the rotating operand moves
/// by more than rho, so it stays in that operand grown by a disc of rho, and holds it shrunk by one. An octagon about
/// the disc stands for it. Cost: that of 1.1 r w / (2 tolerance) sums, r being how far the rotating operand reaches and
/// w the width of the interval in radians, and of a union of them.
Result<PlanarSum> outer_set(const RotatedOperands& operands, const Orientation& a, const Orientation& b,
                            double tolerance, const Progress& progress);
Result<PlanarSum> inner_set(const RotatedOperands& operands, const Orientation& a, const Orientation& b,
                            double tolerance, const Progress& progress);

/// The region moved, where that rounds nothing. Errors: unsupported_operand with the vertex.
Result<Region> translated_exactly(const Region& region, Point by);

}  // namespace dymsum::planar
