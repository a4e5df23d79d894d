// The boundary of a region as sites: what discs outside (or inside) can touch, in the order of its walks.
#pragma once

#include <cstdint>
#include <vector>

#include "exact/big.h"
#include "exact/interval.h"
#include "shape/complex/complex.h"

namespace dymsum::shape {

/// A vertex of the boundary: as given, on the integer grid of all coordinates, and as an interval in units in which
/// nothing under- or overflows.
struct BoundaryPoint {
  Point input;
  exact::BigInteger x, y;  ///< input = 2^grid_exponent (x, y)
  exact::Interval ix, iy;  ///< they contain input / 2^unit_exponent
};

/// What a site is made of.
struct SiteEnds {
  std::uint32_t a = 0, b = 0;        ///< boundary points; equal for a vertex
  std::uint32_t prev = 0, next = 0;  ///< sites of the walk; itself for an isolated point
};

/// A closed walk with the discs on its right: sites [first, last).
struct SiteLoop {
  std::uint32_t first = 0, last = 0;
};

struct Walks {
  Side side = Side::outside;
  std::vector<Site> sites;
  std::vector<SiteEnds> ends;         ///< per site
  std::vector<std::uint32_t> corner;  ///< per site: the region's vertex at its start if that is reflex, or kNoIndex
  std::vector<SiteLoop> loops;
  std::vector<BoundaryPoint> points;
  int grid_exponent = 0, unit_exponent = 0;

  bool is_edge(std::uint32_t s) const { return sites[s].kind == Site::Kind::edge; }
  /// A point that is a component by itself: discs touch it from all sides.
  bool is_isolated(std::uint32_t s) const { return ends[s].next == s; }
};

/// Errors: as make_complex. O(n log n).
Result<Walks> make_walks(const Region& region, Side side);

}  // namespace dymsum::shape
