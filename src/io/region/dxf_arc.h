// Arcs as DXF has them: by angles in degrees, and by bulges.
#pragma once

#include <optional>

#include "dymsum/region.h"
#include "io/region/curves.h"

namespace dymsum::io {

/// Ends of lines and arcs that differ by at most this fraction of an arc's radius are one: the angles of arcs are
/// rounded in files, and where an arc ends is rounded here.
inline constexpr double kArcJoint = 1e-6;

/// The arc from `from` to `to` with the bulge b = tan(angle / 4), counter-clockwise for b > 0; both ends lie on it but
/// for rounding. Requires: b finite and not 0, from and to different.
EllipseArc bulge_arc(Point from, Point to, double b);

/// The arc of a circle, counter-clockwise from one angle to another one, in degrees. Nothing where both are the same
/// direction.
std::optional<EllipseArc> degree_arc(Point centre, double radius, double from_degrees, double to_degrees);

/// (cos, sin) of an angle in degrees, exact at multiples of 90.
Point direction(double degrees);

/// The point of a circle in that direction.
Point on_circle(Point centre, double radius, double degrees);

/// All of an ellipse from the end of its first half axis on, once around: four arcs, which end exactly where the half
/// axes do but for one rounding.
ChordChain ellipse_ring(Point centre, Point u, Point v, const CurveOptions& options);

}  // namespace dymsum::io
