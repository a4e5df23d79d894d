#include "dymsum/grown_region.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/double_text.h"
#include "dymsum/planar_sum.h"
#include "exact/rounding_bound.h"
#include "planar/region/chains.h"

namespace dymsum {
namespace {

double largest_coordinate(const Region& region) {
  double most = 0;
  planar::for_each_chain(region.data(), [&](const std::vector<Point>& points) {
    for (const Point& p : points) most = std::max({most, std::abs(p.x), std::abs(p.y)});
  });
  return most;
}

}  // namespace

// The error of coordinates: a vertex of the sum is rounded once, and so is every edge; a vertex of the disc three
// times.
constexpr double kMoved = exact::rounding_bound(2 + 3, 8);

// A disc that is larger by more than what vertices and edges are moved by holds the given one whichever way they move.
Result<GrownRegion> grown(const Region& region, double margin, int sides) {
  if (!(margin >= 0 && margin <= 0x1p400))
    return Error{
        ErrorCode::out_of_range, "the margin must be from 0 to 2^400, not " + base::general_text(margin, 6), {}};
  if (sides < 3 || sides > 4096)
    return Error{ErrorCode::out_of_range, "sides must be from 3 to 4096, not " + std::to_string(sides), {}};
  if (margin == 0) return GrownRegion{region, 0, 0};
  const double half = std::numbers::pi / sides, coordinates = largest_coordinate(region) + 4 * margin;
  const double inner = margin * exact::kOutwards + kMoved * coordinates,
               outer = inner / std::cos(half) * exact::kOutwards;
  Part polygon;
  for (int k = 0; k < sides; ++k) {
    const double angle = (2 * k + 1) * half;
    polygon.outer.push_back({outer * std::cos(angle), outer * std::sin(angle)});
  }
  const Result<Region> disc = Region::create({{polygon}, {}, {}});
  if (!disc) return disc.error();
  const Result<PlanarSum> sum = minkowski_sum(region, *disc);
  if (!sum) return sum.error();
  Result<Region> rounded = sum->rounded();
  if (!rounded) return rounded.error();
  return GrownRegion{std::move(rounded).value(), margin, outer * exact::kOutwards + kMoved * coordinates};
}

}  // namespace dymsum
