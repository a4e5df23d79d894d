// Points of operands in the units of a lattice.
#include <algorithm>
#include <cmath>

#include "planar/lattice_build.h"

namespace dymsum::planar {
namespace {

// The smallest corner of the bounding box: its coordinates are coordinates of vertices, hence on the grid.
Point low_corner(std::span<const Point> points) {
  if (points.empty()) return {};
  Point low = points[0];
  for (const Point& p : points) low = {std::min(low.x, p.x), std::min(low.y, p.y)};
  return low;
}

}  // namespace

void place_in_units(PlacedPoints& points, int unit) {
  const double per_unit = std::ldexp(1.0, -unit);
  points.unit = unit;
  const std::size_t n = points.input.size();
  points.x.resize(n);
  points.y.resize(n);
  double width = 0, height = 0;
  const Point offset = points.offset, stretch = points.stretch;
  for (std::size_t i = 0; i < n; ++i) {
    const Point v = points.input[i];
    // The difference of two doubles is rounded once; the power of two is exact.
    const double x = (v.x - offset.x) * per_unit * stretch.x, y = (v.y - offset.y) * per_unit * stretch.y;
    points.x[i] = x;
    points.y[i] = y;
    width = std::max(width, x);
    height = std::max(height, y);
  }
  points.width = width;
  points.height = height;
}

int unit_for(double extent, int exponent, int bits) {
  return bits <= 61 ? std::max(exponent, -1000) : std::max(std::ilogb(extent) - 60, -1000);
}

std::shared_ptr<const PlacedPoints> place_points(std::vector<Point> input) {
  auto points = std::make_shared<PlacedPoints>();
  points->input = std::move(input);
  points->offset = low_corner(points->input);
  double extent = 0;
  for (const Point v : points->input) extent = std::max({extent, v.x - points->offset.x, v.y - points->offset.y});
  points->extent = extent;
  points->exponent = exact::common_exponent(points->input);
  // One unit in the last place covers the rounding of the differences.
  constexpr int kLow = -1100;  // below all grids
  points->top = kLow + exact::bits_needed(std::nextafter(points->extent, INFINITY), kLow);
  place_in_units(*points, points->moderate() ? 0 : unit_for(points->extent, points->exponent, points->bits(points->exponent)));
  return points;
}

}  // namespace dymsum::planar
