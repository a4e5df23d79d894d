#include "planar/turned_region.h"

#include <cmath>
#include <utility>

namespace dymsum::cli {

std::optional<Region> turned(const Region& region, const Orientation& theta) {
  // t = n / d, 1 / 0 for half a turn: with |t| <= 1 no square is too large.
  const bool far = theta.is_half_turn() || std::abs(theta.tan_half().to_double()) > 1;
  const double t = theta.is_half_turn() ? 0 : far ? 1 / theta.tan_half().to_double() : theta.tan_half().to_double();
  const double w = 1 + t * t, sine = 2 * t / w, cosine = (far ? t * t - 1 : 1 - t * t) / w;
  const auto turn = [&](std::vector<Point>& points) {
    for (Point& p : points) p = {cosine * p.x - sine * p.y, sine * p.x + cosine * p.y};
  };
  RegionData data = region.data();
  for (Part& part : data.parts) {
    turn(part.outer);
    for (Ring& hole : part.holes) turn(hole);
  }
  for (Polyline& line : data.polylines) turn(line);
  turn(data.points);
  Result<Region> made = Region::create(std::move(data));
  if (!made) return std::nullopt;
  return std::move(made).value();
}

}  // namespace dymsum::cli
