#include "planar/turning/slice.h"

#include "planar/frames/operand_pair.h"
#include "planar/sum/placed_sum.h"
#include "planar/turning/turn.h"

namespace dymsum::planar {

PlacedPair placed_at(const OperandPair& base, const Orientation& theta) {
  return base.placed_on_lattice(make_turned_lattice(*base.lattice, turn_of(theta, base.moved), base.min_tier_bits));
}

Result<PlanarSum> sum_at(const OperandPair& base, const Orientation& theta, const SumOptions& options) {
  return placed_sum(placed_at(base, theta), options);
}

}  // namespace dymsum::planar
