// Points of operands in the units of a lattice.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "base/bit_cast.h"
#include "planar/operand/fraction_points.h"
#include "planar/operand/lattice_build.h"

namespace dymsum::planar {
namespace {

struct Corners {
  Point low, high;
};

// The corners of the bounding box: their coordinates are coordinates of vertices, hence on the grid.
Corners corners_of(std::span<const Point> points) {
  if (points.empty()) return {};
  Point low = points[0], high = low;
  for (const Point p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return {low, high};
}

// The largest coordinates are those of the high corner: rounding is monotone, and nothing is stretched backwards.
void position_below(PlacedPoints& points, int unit, Point high) {
  const double per_unit = power_of_two(-unit);
  const Point offset = points.offset, factors = points.factors;
  // The difference of two doubles is rounded once; the power of two is exact.
  const auto position_x = [=](double x) { return (x - offset.x) * per_unit * factors.x; };
  const auto position_y = [=](double y) { return (y - offset.y) * per_unit * factors.y; };
  points.unit = unit;
  const std::size_t n = points.input.size();
  points.x.resize(n);
  points.y.resize(n);
  double *const x = points.x.data(), *const y = points.y.data();
  const Point* const input = points.input.data();
  for (std::size_t i = 0; i < n; ++i) {
    x[i] = position_x(input[i].x);
    y[i] = position_y(input[i].y);
  }
  points.width = n == 0 ? 0 : position_x(high.x);
  points.height = n == 0 ? 0 : position_y(high.y);
}

}  // namespace

// One unit in the last place covers the rounding of the differences.
int top_of(double extent) {
  const int field = static_cast<int>(base::bit_cast<std::uint64_t>(extent) >> 52);
  if (field != 0 && field < 0x7ff) return field - 1022;  // the next double is at most the next power of two
  constexpr int kLow = -1100;                            // below all grids
  return kLow + exact::bits_needed(std::nextafter(extent, INFINITY), kLow);
}

void position_in_units(PlacedPoints& points, int unit) {
  if (points.fractions != nullptr) fractions_in_units(points, unit);
  else position_below(points, unit, corners_of(points.input).high);
}

int unit_for(double extent, int exponent, int bits) {
  return bits <= 61 ? std::max(exponent, -1000) : std::max(std::ilogb(extent) - 60, -1000);
}

std::shared_ptr<const PlacedPoints> place_points(std::vector<Point> input) {
  auto points = std::make_shared<PlacedPoints>();
  points->input = std::move(input);
  const Corners corners = corners_of(points->input);
  points->offset = corners.low;
  points->extent = std::max(corners.high.x - corners.low.x, corners.high.y - corners.low.y);
  points->exponent = exact::common_exponent(points->input);
  points->top = top_of(points->extent);
  const int unit = points->moderate() ? 0 : unit_for(points->extent, points->exponent, points->bits(points->exponent));
  position_below(*points, unit, corners.high);
  return points;
}

}  // namespace dymsum::planar
