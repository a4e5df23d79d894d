// Planar test and demo shapes: valid regions, of the same coordinates everywhere. disc (up to 2,000 vertices), gear,
// star, spiral and pockets round these to a grid of about 2^-24 of their size; the others have the numbers that they
// are given.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "dymsum/region.h"

namespace dymsum::shapes {

Region rectangle(double x0, double y0, double x1, double y1);
Region disc(int vertices, double radius);            ///< regular-looking convex polygon with this many vertices
Region gear(int teeth, double inner, double outer);  ///< 4 vertices a tooth
Region grate(int bars, double pitch, double bar, double length);  ///< a frame with `bars` - 1 rectangular holes
Region comb(int teeth, double pitch, double tooth, double length);
Region star(int points, double inner, double outer);  ///< 2 vertices a point
Region noisy_star(int vertices, double noise,
                  std::uint64_t seed);  ///< star-shaped about the origin, radii in [1 - noise, 1]
Region spiral(int turns, int vertices_per_turn, double pitch, double width);
Region letter_u(double width, double height, double thickness);
Region letter_l(double width, double height, double thickness);
Region pockets(int holes, double size);                              ///< a plate with square holes of growing size
Region random_polygon(int vertices, int holes, std::uint64_t seed);  ///< simple, non-convex, with holes

/// A generated stand-in for each polygon of the thesis's figure 3.3, with its vertex count: airplane 51, bar 4, bird
/// 275, blob 18, dog 145, G1 30, G2 34, G3 24, G4 43, hand1 57, hand2 84, insignia 4, sewing 10, fence 10, pentagon 5,
/// star 44, U 8.
struct Named {
  std::string_view name;
  Region region;
};
std::vector<Named> thesis_like_set();

}  // namespace dymsum::shapes
