#include "cspace/queries/tight_distance.h"

#include <numbers>

namespace dymsum::cspace {

// The error of a rotation is this times its weight: both angles' doubles, and the product of at most 4. The length of a
// vector errs relatively.
constexpr double kTurnError = exact::rounding_bound(2 * 12 + 4, 128), kFlatLength = exact::rounding_bound(3, 8);

NearestTight nearest_tight(const CspaceObstacle& obstacle, const Configuration& from, double weight) {
  NearestTight nearest;
  for (const TightFeature& f : obstacle.tight()) {
    const double theta = obstacle.angles()[f.angle].theta;
    const double turn = weight * std::remainder(theta - from.theta, 2 * std::numbers::pi);
    if (std::abs(turn) > nearest.position.distance + nearest.position.error + kTurnError * weight) continue;
    NearestPosition flat;
    flat.add_segment({from.x, from.y}, f.from, f.to, f.error);
    const double before = nearest.position.distance;
    nearest.position.add(std::hypot(flat.distance, turn),
                         flat.error + kTurnError * weight + kFlatLength * flat.distance, flat.at);
    if (nearest.position.distance != before) nearest.theta = theta;
  }
  return nearest;
}

}  // namespace dymsum::cspace
