#include "uncertain/disc_polygons.h"

#include <cmath>
#include <numbers>
#include <string>

#include "base/double_text.h"

namespace dymsum::uncertain {
namespace {

// Coordinates are multiples of 2^-26 of the power of two below the radius, but for those that are the radius itself:
// short numbers keep sums in a low tier.
double unit_of(double radius) { return std::ldexp(1.0, std::ilogb(radius) - 26); }

double radians_of(int half_steps, int sides) { return half_steps * std::numbers::pi / sides; }

/// A quarter of the vertices, rotated to all four.
Region of_quarter(const Ring& quarter) {
  Part polygon;
  for (int quadrant = 0; quadrant < 4; ++quadrant)
    for (const Point& p : quarter) {
      const Point rotated[] = {p, {-p.y, p.x}, {-p.x, -p.y}, {p.y, -p.x}};
      polygon.outer.push_back(rotated[quadrant]);
    }
  return Region::create({{polygon}, {}, {}}).value();
}

}  // namespace

// Vertices are those of the polygon whose edges touch the disc, edges through the axes included, and both coordinates
// are enlarged by more than the roundings of the functions and then to the next multiple of the unit, except where one
// is the radius. Normals of edges in a quarter have no negative coordinates there, so no edge comes nearer.
Region polygon_around(double radius, int sides) {
  const double unit = unit_of(radius), reach = radius * (1 + 0x1p-40) / std::cos(radians_of(1, sides));
  const auto rounded = [&](double v) { return unit * std::ceil(v / unit); };
  Ring quarter;
  const int count = sides / 4;
  for (int k = 0; k < count; ++k) {
    // The second half of a quarter mirrors the first one, vertex by vertex.
    const int first = std::min(k, count - 1 - k);
    const double x = first == 0 ? radius : rounded(reach * std::cos(radians_of(2 * first + 1, sides)));
    const double y = 2 * first + 1 == count ? x : rounded(reach * std::sin(radians_of(2 * first + 1, sides)));
    quarter.push_back(2 * k + 1 < count ? Point{x, y} : 2 * k + 1 == count ? Point{x, x} : Point{y, x});
  }
  return of_quarter(quarter);
}

// Vertices on the circle, (radius, 0) first; both coordinates of the others are made smaller.
Region polygon_inside(double radius, int sides) {
  const double unit = unit_of(radius), reach = radius * (1 - 0x1p-40);
  const auto rounded = [&](double v) { return unit * std::floor(v / unit); };
  Ring quarter{{radius, 0}};
  const int count = sides / 4;
  for (int k = 1; k < count; ++k) {
    const int first = std::min(k, count - k);
    const double x = rounded(reach * std::cos(radians_of(2 * first, sides)));
    const double y = 2 * first == count ? x : rounded(reach * std::sin(radians_of(2 * first, sides)));
    quarter.push_back(2 * k <= count ? Point{x, y} : Point{y, x});
  }
  return of_quarter(quarter);
}

// Vertices around are at radius / cos plus the unit in each coordinate; edges inside at radius cos less it.
double polygon_error(double radius, int sides) {
  return radius == 0 ? 0 : radius * (1 / std::cos(radians_of(1, sides)) - 1) * (1 + 0x1p-20) + 4 * unit_of(radius);
}

Result<void> check_disc(double radius, int sides) {
  if (!(radius == 0 || (radius >= 0x1p-900 && radius <= 0x1p400)))
    return Error{ErrorCode::out_of_range,
                 "a tolerance must be 0 or from 2^-900 to 2^400, not " + base::general_text(radius, 6),
                 {}};
  if (sides < 4 || sides > 256 || sides % 4 != 0)
    return Error{ErrorCode::out_of_range,
                 "polygons for discs have a multiple of 4 sides, from 4 to 256, not " + std::to_string(sides),
                 {}};
  return {};
}

}  // namespace dymsum::uncertain
