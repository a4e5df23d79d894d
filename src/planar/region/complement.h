// The complement of a region inside a frame, for questions about what lies inside.
#pragma once

#include <array>
#include <optional>

#include "planar/region/engine_region.h"

namespace dymsum::planar {

/// The angles by which Q may be rotated.
enum class Turning { none, any };

/// The frame with P cut out, under the numbers of P; the frame's own vertices and edges have the number
/// SumVertex::kNone. The frame is wide enough that its boundary plays no part in sums with -Q, or with
/// Q rotated by any angle.
EngineRegion complement_of(const Region& p, const Region& q, Turning turning = Turning::none);

/// Half the side of that frame around the origin, for the bounds of P and Q: smallest x and y, largest x and y.
double frame_margin(const std::array<double, 4>& p, const std::array<double, 4>& q, Turning turning);

/// The error for operands around which no such frame can be laid: a coordinate that no sum can take, or so large a one
/// that the frame's would be. Evidence is the operand's own coordinate.
std::optional<Error> too_large_to_frame(const Region& p, const Region& q);

}  // namespace dymsum::planar
