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

/// A generated stand-in for each polygon of the thesis's figure 3.3, with its vertex count: airplane 51, bar 4, bird
/// 275, blob 18, dog 145, G1 30, G2 34, G3 24, G4 43, hand1 57, hand2 84, insignia 4, sewing 10, fence 10, pentagon 5,
/// star 44, U 8.
struct Named {
  std::string_view name;
  Region region;
};
std::vector<Named> thesis_like_set();

}  // namespace dymsum::shapes
