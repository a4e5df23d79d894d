#include "planar/local/local_walls.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dymsum::planar {

namespace {

/// Of the sums' extent: nodes are found to within 2^-32 of it.
constexpr double kLeastMargin = 0x1p-28;
/// In scaled doubles, where all sums are within 1.
constexpr double kBeyond = 1.5;

double lower(double v, double by) {
  const double w = v - by;
  return std::isfinite(w) ? (w < v ? w : std::nextafter(v, -INFINITY)) : -std::numeric_limits<double>::max();
}

}  // namespace

PlanarBox larger_box(const PlanarBox& box, double extent) {
  // Along each axis by itself: a thin box stays thin.
  const double least = extent * kLeastMargin, x = std::max(box.high.x / 32 - box.low.x / 32, least),
               y = std::max(box.high.y / 32 - box.low.y / 32, least);
  return {{lower(box.low.x, x), lower(box.low.y, y)}, {-lower(-box.high.x, x), -lower(-box.high.y, y)}};
}

LocalWalls::LocalWalls(const PosedRegions& posed, const PlanarBox& box, const PlanarBox& reach) {
  const std::array<double, 8> values{box.low.x,   box.high.x,   box.low.y,   box.high.y,
                                     reach.low.x, reach.high.x, reach.low.y, reach.high.y};
  for (std::size_t k = 0; k < 8; ++k) {
    LocalWall& wall = walls_[k];
    wall.axis = k % 4 < 2 ? 0 : 1;
    wall.value = values[k];
    wall.scaled = posed.scaled(wall.value);
    wall.beyond = std::abs(wall.scaled) > kBeyond;
    if (wall.beyond) continue;
    const Big v = posed.exact_number(wall.value);
    wall.exact = {v, v, Big::from_int64(1)};
    wall.pair = posed.pair(v);
  }
}

}  // namespace dymsum::planar
