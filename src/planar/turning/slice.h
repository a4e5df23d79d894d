// The sum at one orientation: a static sum on the lattice of rotated vertices.
#pragma once

#include "dymsum/orientation.h"
#include "planar/frames/operand_pair.h"

namespace dymsum::planar {

/// Operands of which `turning` rotates about the origin of its coordinates, unrotated. `further`: source vertices that
/// belong to no walk. Errors: unsupported_operand.
Result<std::shared_ptr<const OperandPair>> turning_base(const Region& p, const Region& q, std::uint32_t turning,
                                                        bool reflect_q,
                                                        const std::array<std::vector<Point>, 2>& further,
                                                        int min_tier_bits);

/// Lattice and operands at an orientation.
PlacedPair placed_at(const OperandPair& base, const Orientation& theta);
Result<PlanarSum> sum_at(const OperandPair& base, const Orientation& theta, const SumOptions& options);

}  // namespace dymsum::planar
