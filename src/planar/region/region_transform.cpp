// Moving regions.
#include <algorithm>
#include <cmath>

#include "dymsum/region.h"
#include "planar/region/region_validate.h"

namespace dymsum {

namespace {

// Every vertex through f, in place; with `reverse`, rings run the other way round from the same first vertex.
template <class F>
void map_region(RegionData& data, F f, bool reverse) {
  const auto map_chain = [f](std::vector<Point>& chain) {
    std::transform(chain.begin(), chain.end(), chain.begin(), f);
  };
  const auto map_ring = [map_chain, reverse](Ring& ring) {
    map_chain(ring);
    if (reverse && !ring.empty()) std::reverse(ring.begin() + 1, ring.end());
  };
  for (Part& part : data.parts) {
    map_ring(part.outer);
    for (Ring& hole : part.holes) map_ring(hole);
  }
  for (Polyline& line : data.polylines) map_chain(line);
  map_chain(data.points);
}

}  // namespace

Region negated(const Region& region) {
  RegionData data = region.data();
  // Half a turn keeps orientations. Subtracting from zero leaves no negative zeros.
  map_region(
      data,
      [](Point p) {
        return Point{0 - p.x, 0 - p.y};
      },
      false);
  std::vector<Point> touching(region.touching_points().rbegin(), region.touching_points().rend());
  for (Point& p : touching) p = {0 - p.x, 0 - p.y};
  return planar::trusted_region(std::move(data), std::move(touching));
}

Result<Region> translated(const Region& region, double dx, double dy) {
  RegionData data = region.data();
  map_region(
      data,
      [dx, dy](Point p) {
        return Point{p.x + dx, p.y + dy};
      },
      false);
  return Region::create(std::move(data));
}

Result<Region> scaled(const Region& region, double sx, double sy) {
  if (!std::isfinite(sx) || !std::isfinite(sy) || sx == 0 || sy == 0) {
    return Error{ErrorCode::unsupported_operand, "a scale factor is zero or not finite", {}};
  }
  RegionData data = region.data();
  map_region(
      data,
      [sx, sy](Point p) {
        return Point{p.x * sx, p.y * sy};
      },
      (sx < 0) != (sy < 0));
  return Region::create(std::move(data));
}

}  // namespace dymsum
