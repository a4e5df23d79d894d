#include "planar/turning/slice.h"

#include "dymsum/cspace_obstacle.h"
#include "dymsum/orientation_sum.h"
#include "planar/operand/prepared_region.h"
#include "planar/result/finish_sum.h"
#include "planar/turning/turn.h"

namespace dymsum::planar {

Result<std::shared_ptr<const OperandPair>> turning_base(const Region& p, const Region& q, std::uint32_t turning,
                                                        bool reflect_q,
                                                        const std::array<std::vector<Point>, 2>& further,
                                                        int min_tier_bits) {
  return OperandPair::create({prepared_operand(p, 0), prepared_operand(q, 1, reflect_q)}, further, turning,
                             min_tier_bits);
}

PlacedPair placed_at(const OperandPair& base, const Orientation& theta) {
  return base.placed_on_lattice(make_turned_lattice(*base.lattice, turn_of(theta, base.scaled), base.min_tier_bits));
}

Result<PlanarSum> sum_at(const OperandPair& base, const Orientation& theta, const SumOptions& options) {
  return placed_sum(placed_at(base, theta), options);
}

}  // namespace dymsum::planar

namespace dymsum {

Result<PlanarSum> cspace_slice(const Region& robot, const Region& obstacle, const Orientation& theta,
                               const SumOptions& options) {
  const auto base = planar::turning_base(obstacle, robot, 1, true, {}, planar::SumInternals::min_tier_bits(options));
  if (!base) return base.error();
  return planar::sum_at(**base, theta, options);
}

Result<PlanarSum> rotated_sum(const Region& p, const Region& q, const Orientation& theta, const SumOptions& options) {
  const auto base = planar::turning_base(p, q, 0, false, {}, planar::SumInternals::min_tier_bits(options));
  if (!base) return base.error();
  return planar::sum_at(**base, theta, options);
}

}  // namespace dymsum
