#include "dymsum/orientation_sum.h"

#include "dymsum/cspace_obstacle.h"
#include "planar/frames/region_pair.h"
#include "planar/position/exact_source.h"
#include "planar/turning/slice.h"

namespace dymsum {
namespace {

Result<PlanarSum> sum_of(const Region& p, const Region& q, const Orientation& theta, const SumOptions& options,
                         planar::PairOptions pair) {
  pair.min_tier_bits = planar::SumInternals::min_tier_bits(options);
  pair.spread = planar::Spread::any;
  const auto base = planar::pair_of_regions(p, q, pair);
  if (!base) return base.error();
  return planar::sum_at(**base, theta, options);
}

}  // namespace

Result<PlanarSum> cspace_slice(const Region& robot, const Region& obstacle, const Orientation& theta,
                               const SumOptions& options) {
  return sum_of(obstacle, robot, theta, options, {.moved = 1, .reflect_q = true});
}

Result<PlanarSum> rotated_sum(const Region& p, const Region& q, const Orientation& theta, const SumOptions& options) {
  return sum_of(p, q, theta, options, {.moved = 0});
}

}  // namespace dymsum
