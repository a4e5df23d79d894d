// How much of a frame the one before tells: the corners that both have.
#pragma once

#include "dymsum/planar_sum.h"

namespace dymsum::bench {

/// The fraction of the corners of `now`, each the two contacts it lies on, that `before` has too; 1 for an empty sum.
/// What is not among them has to be found anew by any method that updates.
double corners_kept(const PlanarSum& before, const PlanarSum& now);

}  // namespace dymsum::bench
