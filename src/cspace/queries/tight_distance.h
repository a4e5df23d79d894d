// How far a configuration is from the tight placements of an obstacle.
#pragma once

#include "cspace/queries/segment_distance.h"

namespace dymsum::cspace {

struct NearestTight {
  NearestPosition position;  ///< by the metric dx^2 + dy^2 + weight^2 dtheta^2; infinitely far where nothing is tight
  double theta = 0;          ///< of the nearest one
};

/// The nearest of all tight features, tried one after the other. `from.theta` in [-pi, pi], within 2^-50 of the angle
/// that is meant; a finite weight.
NearestTight nearest_tight(const CspaceObstacle& obstacle, const Configuration& from, double weight);

}  // namespace dymsum::cspace
