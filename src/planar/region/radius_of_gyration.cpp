#include <cmath>
#include <vector>

#include "dymsum/region.h"
#include "exact/big.h"
#include "exact/grid.h"

namespace dymsum {

using exact::Big;

double radius_of_gyration(const Region& region) {
  std::vector<double> coordinates;
  const auto each_ring = [&](auto visit) {
    for (const Part& part : region.parts()) {
      visit(part.outer);
      for (const Ring& hole : part.holes) visit(hole);
    }
  };
  each_ring([&](const Ring& ring) {
    for (const Point& p : ring) coordinates.insert(coordinates.end(), {p.x, p.y});
  });
  if (coordinates.empty()) return 0;
  const int unit = exact::common_exponent(coordinates);
  // Twice the area, and twelve times the integral of x x + y y.
  Big area, moment;
  each_ring([&](const Ring& ring) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Point u = ring[k], v = ring[(k + 1) % ring.size()];
      const Big ax = exact::grid_coordinate<Big>(u.x, unit), ay = exact::grid_coordinate<Big>(u.y, unit);
      const Big bx = exact::grid_coordinate<Big>(v.x, unit), by = exact::grid_coordinate<Big>(v.y, unit);
      const Big twice = ax * by - ay * bx;
      area = area + twice;
      moment = moment + twice * (ax * ax + ay * ay + ax * bx + ay * by + bx * bx + by * by);
    }
  });
  // The mean square in [1/4, 4] times 4^half, so that it stays in the range of doubles.
  exact::BigInteger over = moment.value(), under = 6 * area.value();
  const int half = (static_cast<int>(msb(over)) - static_cast<int>(msb(under))) / 2;
  (half > 0 ? under : over) <<= 2 * std::abs(half);
  return std::ldexp(std::sqrt(exact::round_to_double(exact::BigRational(over, under))), half + unit);
}

}  // namespace dymsum
