// The stages of a planar sum as data: what pictures, tests and a viewer look at.
#pragma once

#include <cstdint>
#include <vector>

#include "dymsum/region.h"

namespace dymsum {

/// Drawn positions are rounded; decisions never read them back.
struct PlanarTrace {
  struct Segment {
    Point from, to;
    bool edge_of_p = true;  ///< edge of P + vertex of Q; otherwise vertex of P + edge of Q
  };
  struct Cell {
    Point low, high;
  };
  std::vector<Segment> convolution;  ///< all segments of the reduced (or kinetic) convolution
  std::vector<Cell> masked_cells;    ///< grid cells proved to lie in the interior of the sum (merged into row runs)
  std::vector<Point> crossings;      ///< crossings found between live segments
  std::vector<Ring> kept_loops;      ///< closed loops on the boundary
  std::vector<Ring> dropped_loops;   ///< closed loops that a collision test or nesting refuted
  std::vector<Point> tight_points;
  std::vector<std::vector<Point>> tight_segments;  ///< two points each
};

}  // namespace dymsum
