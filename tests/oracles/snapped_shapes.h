// Round shapes of coordinates with 24 bits: what tests count on that know their sums to the digit, or want small tiers.
#pragma once

#include "dymsum/shapes.h"

namespace dymsum::snapped_shapes {

/// Polygons of more vertices would not stay convex, and keep all their bits.
inline Region disc(int vertices, double radius) {
  return shapes::disc(vertices, radius, vertices <= 2000 ? shapes::demo_snap(radius) : 0);
}
inline Region gear(int teeth, double inner, double outer) {
  return shapes::gear(teeth, inner, outer, shapes::demo_snap(outer));
}
inline Region star(int points, double inner, double outer) {
  return shapes::star(points, inner, outer, shapes::demo_snap(outer));
}
inline Region spiral(int turns, int vertices_per_turn, double pitch, double width) {
  return shapes::spiral(turns, vertices_per_turn, pitch, width, shapes::demo_snap(pitch * (turns + 1) + width));
}
inline Region pockets(int holes, double size) { return shapes::pockets(holes, size, shapes::demo_snap(size)); }

}  // namespace dymsum::snapped_shapes
