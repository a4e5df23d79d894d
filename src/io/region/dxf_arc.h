// Arcs of circles as chains of chords.
#pragma once

#include <vector>

#include "dymsum/region.h"

namespace dymsum::io {

/// A step of at most 1/12 of a radian: a chord is then at most (1 - cos(1/24)) r < 0.00087 r away from its arc, inside
/// of the circle. With what the vertices err by (a few roundings of coordinates of the size of r, and of the
/// coordinates themselves) the chain is within r / 1000 of the arc, for circles that are not minute beside their
/// coordinates.
inline constexpr double kArcSteps = 12;

/// Ends of lines and arcs that differ by at most this fraction of an arc's radius are one: the angles of arcs are
/// rounded in files, and where an arc ends is rounded here.
inline constexpr double kArcJoint = 1e-6;

/// Appends the vertices strictly between `from` and `to` of the arc with the bulge b = tan(angle / 4),
/// counter-clockwise for b > 0; all of them lie on it but for rounding. Requires: b finite. Not finite where the arc
/// leaves the range of doubles.
void append_bulge(std::vector<Point>& chain, Point from, Point to, double b);

/// The chain of an arc, counter-clockwise from one angle to another one, in degrees; ends at multiples of 90 degrees
/// are exact but for one rounding. Nothing where both are the same direction.
std::vector<Point> arc_chain(Point centre, double radius, double from_degrees, double to_degrees);

/// The ring of a circle, counter-clockwise.
Ring circle_ring(Point centre, double radius);

}  // namespace dymsum::io
