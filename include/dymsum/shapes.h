// Planar test and demo shapes: valid regions, of the same coordinates everywhere. Numbers that are coordinates are
// taken as they are; points of circles and cells are doubles within a few units of the last place. On request (`snap`,
// a power of two) every coordinate is rounded to its nearest multiple of `snap`, ties up: coordinates of fewer bits are
// in a smaller tier, and sums of them cost less. Arguments that give no valid region throw std::invalid_argument.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "dymsum/region.h"

namespace dymsum::shapes {

/// A `snap` for shapes with coordinates up to this size: these have at most 24 bits.
double demo_snap(double size);

Region rectangle(double x0, double y0, double x1, double y1);
/// A convex polygon with this many vertices on a circle. Snapped to demo_snap(radius) it stays convex up to about
/// 2,000.
Region disc(int vertices, double radius, double snap = 0);
Region gear(int teeth, double inner, double outer, double snap = 0);  ///< 4 vertices a tooth
Region grate(int bars, double pitch, double bar, double length);      ///< a frame with `bars` - 1 rectangular holes
Region comb(int teeth, double pitch, double tooth, double length);
Region star(int points, double inner, double outer, double snap = 0);  ///< 2 vertices a point
/// Star-shaped about the origin, radii in [1 - noise, 1]; multiples of 2^-24.
Region noisy_star(int vertices, double noise, std::uint64_t seed);
Region spiral(int turns, int vertices_per_turn, double pitch, double width, double snap = 0);
Region letter_u(double width, double height, double thickness);
Region letter_l(double width, double height, double thickness);
Region pockets(int holes, double size, double snap = 0);  ///< a plate with square holes of growing size
/// Simple, non-convex, with holes; multiples of 2^-24.
Region random_polygon(int vertices, int holes, std::uint64_t seed);

}  // namespace dymsum::shapes
