#include "dymsum/orientation_sum.h"

#include "dymsum/cspace_obstacle.h"
#include "planar/motion/operand_pair.h"
#include "planar/operand/prepared_region.h"
#include "planar/position/exact_source.h"
#include "planar/region/complement.h"
#include "planar/sum/inside_of_frame.h"
#include "planar/sum/placed_sum.h"
#include "planar/sum/sum_engine.h"

namespace dymsum {
namespace {

Result<PlanarSum> sum_of(const Region& p, const Region& q, const Orientation& theta, const SumOptions& options,
                         planar::PairOptions pair) {
  pair.min_tier_bits = planar::SumInternals::min_tier_bits(options);
  pair.spread = planar::Spread::any;
  const auto base = planar::pair_of_regions(p, q, pair);
  if (!base) return base.error();
  return planar::placed_sum((*base)->placed(theta), options);
}

}  // namespace

Result<PlanarSum> cspace_slice(const Region& robot, const Region& obstacle, const Orientation& theta,
                               const SumOptions& options) {
  return sum_of(obstacle, robot, theta, options, {.moved = 1, .reflect_q = true});
}

Result<PlanarSum> rotated_erode(const Region& p, const Region& q, const Orientation& theta, const SumOptions& options) {
  if (std::optional<Error> error = planar::not_erodible(p, q)) return *std::move(error);
  if (p.empty()) return minkowski_sum(p, q, options);  // empty too
  const auto base =
      planar::OperandPair::create({planar::make_operand(planar::complement_of(p, q, planar::Turning::any), 0),
                                   planar::prepared_operand(q, 1, true)},
                                  {}, 1, planar::SumInternals::min_tier_bits(options));
  if (!base) return base.error();
  Result<planar::SumState> computed = planar::compute_boundary((*base)->placed(theta), planar::options_inside(options));
  if (!computed) return computed.error();
  return planar::inside_of_frame(std::move(computed).value(), options);
}

Result<PlanarSum> rotated_sum(const Region& p, const Region& q, const Orientation& theta, const SumOptions& options) {
  return sum_of(p, q, theta, options, {.moved = 0});
}

}  // namespace dymsum
