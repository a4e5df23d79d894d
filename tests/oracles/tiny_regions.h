// Operands on tiny integer grids, where most positions are degenerate: the inputs that find mistakes.
#pragma once

#include <vector>

#include "dymsum/region.h"
#include "random.h"

namespace dymsum::oracles {

/// A random region with coordinates in 0 .. grid (sheared lattice shapes may leave that range a little): a simple
/// polygon, a polygon with holes, several parts that may touch, unions of lattice cells, polylines, points, and
/// mixtures. Valid in the sense of Region::create; never empty.
RegionData random_region(Random& random, int grid);

/// Two random regions; in a third of the pairs Q is made to fit P: it is minus one of P's holes, or a box that slides
/// or fits between P's lattice cells, or tiny beside a frame with islands.
struct Pair {
  RegionData p, q;
};
Pair random_pair(Random& random, int grid);

/// Parts only, for the operand of an erosion or of laws about areas.
RegionData random_parts(Random& random, int grid);

/// A random simple polygon with at most `corners` vertices, counter-clockwise.
Ring random_polygon(Random& random, int grid, int corners);

/// The union of the chosen unit cells of a width x height lattice, row by row; cells that only share a corner are one
/// ring there when `joined`, separate ones otherwise. Empty when no cell is chosen.
RegionData cells_region(const std::vector<bool>& cells, int width, int height, bool joined);

/// The integer map (a b; c d), with determinant 1 or -1, of a region; rings keep their orientation rules.
RegionData mapped(const RegionData& region, double a, double b, double c, double d);
RegionData moved(RegionData region, double dx, double dy);

/// All simple polygons with 3 or 4 vertices (no straight angle) on the 3 x 3 lattice, one for each translation class.
std::vector<RegionData> all_small_polygons(int corners);

}  // namespace dymsum::oracles
