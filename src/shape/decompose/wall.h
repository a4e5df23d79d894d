// What a cut can end at: edges of the region and cuts made before; and the nearest point of one in the cone of a notch.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "dymsum/decomposition.h"
#include "exact/interval.h"

namespace dymsum::shape {

/// Double bounds of an exact number: between the neighbours of the double nearest to it.
exact::Interval bounds_of(const Rational& v);

struct Box {
  double x0, y0, x1, y1;
  bool meets(const Box& b) const { return x0 <= b.x1 && b.x0 <= x1 && y0 <= b.y1 && b.y0 <= y1; }
  void add(const Box& b) {
    x0 = std::min(x0, b.x0), y0 = std::min(y0, b.y0), x1 = std::max(x1, b.x1), y1 = std::max(y1, b.y1);
  }
};

/// No more than the square of the distance of p from the box.
double least_square(const Box& box, Point p);

/// A closed segment from a plain point: an edge or a cut.
struct Wall {
  Cut::End kind;        ///< edge or cut
  std::uint32_t index;  ///< of the edge or cut
  std::uint32_t ring;   ///< of its first end
  Point a, b;           ///< of a cut the double nearest to its end
  exact::Interval bx, by;
  std::optional<RationalPoint> to;  ///< the exact end of a cut
  Box box;

  RationalPoint from() const;
  RationalPoint end() const;
};
Wall edge_wall(Point a, Point b, std::uint32_t index, std::uint32_t ring);
Wall cut_wall(Point a, const RationalPoint& to, std::uint32_t index, std::uint32_t ring);

/// The sign of (b - a) x (p - a) for the second end p of the wall. Exact.
int side_of_end(Point a, Point b, const Wall& wall);
/// The sign of (b - a) x (p - a) for the line through a wall. Exact.
int side_of(const Wall& wall, Point p);

/// The nearest point of a wall in a cone.
struct Nearest {
  Rational square, t;  ///< of the distance; along the wall from 0 to 1
  RationalPoint at;
};

/// A reflex vertex, and the directions that resolve it: not to the right of m -> next, not to the left of m ->
/// previous.
struct Notch {
  Point m, previous, next;

  bool admits(Point p) const;
  bool admits_end(const Wall& wall) const;
  /// Whether doubles prove that the cone and the box are apart.
  bool misses(const Box& box) const;

  /// Bounds of the square of the distance of the wall's part in the cone. `none`: it has no such part. `proved`: it
  /// has, and m does not lie on it.
  struct Estimate {
    bool none = false, proved = false;
    exact::Interval square;
  };
  Estimate estimate(const Wall& wall) const;
  /// Nothing where the wall has no part in the cone, or only m. Exact.
  std::optional<Nearest> nearest(const Wall& wall) const;
};

}  // namespace dymsum::shape
