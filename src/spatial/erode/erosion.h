// The inner fit of solids given by plain lists.
#pragma once

#include <array>

#include "dymsum/mesh.h"
#include "dymsum/result.h"
#include "dymsum/spatial_sum.h"
#include "spatial/sum/exact_set.h"

namespace dymsum::spatial {

// The complement of a solid as a solid: a box around it without it.

/// Ends of an interval that reaches beyond `low` and `high` by more than `length`, in multiples of a power of two that
/// is at most the length and at least 2^-50 of the ends, so that both are doubles of few bits.
std::array<double, 2> framed(double low, double high, double length);

/// A box, less `a`. Vertices and faces of `a` keep their indices, those of the box follow; a's faces are turned over.
/// Along every axis the box reaches further beyond `a` than b is long, so whatever of a translate of b touches `a`, all
/// of the translate lies in the box. Requires: both have vertices, and b is not
/// much longer than a along any axis. Error unsupported_operand with a vertex of `a` where
/// that box has no doubles.
/// fits_lengthwise tells that, up to rounding: where it is false, b is longer than a along an axis.
bool fits_lengthwise(const MeshData& a, const MeshData& b);
Result<MeshData> framed_complement(const MeshData& a, const MeshData& b);

/// The inner fit that erode makes, for surfaces that sum_of_solids takes.
Result<SpatialSum> erosion(const MeshData& a, const MeshData& b, const SpatialOptions& options);
/// The same of sets with thin parts, with vertices that are any fractions. Those of `a` hold nothing of a `b` without
/// them: x + int b is open, and an open set within a closed solid and plates lies in the solid. Error
/// unsupported_operand where both have them.
Result<SpatialSum> erosion(const ExactSet& a, const ExactSet& b, const SpatialOptions& options);

}  // namespace dymsum::spatial
