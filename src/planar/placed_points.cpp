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
  points.x.clear();
  points.y.clear();
  points.x.reserve(points.input.size());
  points.y.reserve(points.input.size());
  points.width = points.height = 0;
  for (const Point& v : points.input) {
    // The difference of two doubles is rounded once; the power of two is exact.
    points.x.push_back((v.x - points.offset.x) * per_unit * points.stretch.x);
    points.y.push_back((v.y - points.offset.y) * per_unit * points.stretch.y);
    points.width = std::max(points.width, points.x.back());
    points.height = std::max(points.height, points.y.back());
  }
}

int unit_for(double extent, int exponent, int bits) {
  return bits <= 61 ? std::max(exponent, -1000) : std::max(std::ilogb(extent) - 60, -1000);
}

std::shared_ptr<const PlacedPoints> place_points(std::vector<Point> input) {
  auto points = std::make_shared<PlacedPoints>();
  points->input = std::move(input);
  points->offset = low_corner(points->input);
  std::vector<double> all;
  all.reserve(2 * points->input.size());
  for (const Point& v : points->input) {
    all.push_back(v.x);
    all.push_back(v.y);
    points->extent = std::max({points->extent, v.x - points->offset.x, v.y - points->offset.y});
  }
  points->exponent = exact::common_exponent(all);
  // One unit in the last place covers the rounding of the differences.
  constexpr int kLow = -1100;  // below all grids
  points->top = kLow + exact::bits_needed(std::nextafter(points->extent, INFINITY), kLow);
  place_in_units(*points, points->moderate() ? 0 : unit_for(points->extent, points->exponent, points->bits(points->exponent)));
  return points;
}

}  // namespace dymsum::planar
