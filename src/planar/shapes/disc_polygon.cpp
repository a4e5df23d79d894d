#include "planar/shapes/disc_polygon.h"

#include <cmath>
#include <numbers>
#include <string>

#include "base/double_text.h"

namespace dymsum::planar {

// With u = 2^-12 times the power of two below r, rounding moves a vertex by less than r 2^-12, and so every edge, which
// was further away than r by r 2^-10 less some roundings. The vertices were 1 / cos(pi / 32) < 1.005 times as far.
Result<Region> polygon_around_disc(double radius, const char* what) {
  if (!(radius >= 0x1p-900 && radius <= 0x1p400))
    return Error{
        ErrorCode::out_of_range,
        std::string("the ") + what + " must be 0 or from 2^-900 to 2^400, not " + base::general_text(radius, 6),
        {}};
  constexpr int kQuarter = 8;
  const double half = std::numbers::pi / (4 * kQuarter), unit = std::ldexp(1.0, std::ilogb(radius) - 12);
  const double reach = radius * (1 + 0x1p-10) / std::cos(half) / unit;
  Part polygon;
  for (int quarter = 0; quarter < 4; ++quarter)
    for (int k = 0; k < kQuarter; ++k) {
      // The second half of a quarter mirrors the first one.
      const int first = k < kQuarter / 2 ? k : kQuarter - 1 - k;
      const double x = unit * std::round(reach * std::cos((2 * first + 1) * half)),
                   y = unit * std::round(reach * std::sin((2 * first + 1) * half));
      const Point p = k < kQuarter / 2 ? Point{x, y} : Point{y, x};
      const Point turned[] = {p, {-p.y, p.x}, {-p.x, -p.y}, {p.y, -p.x}};
      polygon.outer.push_back(turned[quarter]);
    }
  return Region::create({{polygon}, {}, {}});
}

Result<std::optional<Region>> polygon_of_distance(double distance, const char* what) {
  if (distance == 0) return std::optional<Region>();
  Result<Region> disc = polygon_around_disc(distance, what);
  if (!disc) return disc.error();
  return std::optional(*std::move(disc));
}

}  // namespace dymsum::planar
