// What an operation takes, as the engine sees it.
#pragma once

#include <cstdint>
#include <memory>

#include "dymsum/planar_operand.h"
#include "planar/operand/operand.h"

namespace dymsum::planar {

/// A region as it is kept prepared, a result as region_of_result; or its reflection.
std::shared_ptr<const Operand> taken_operand(const PlanarOperand& operand, std::uint32_t op, bool reflected = false);

}  // namespace dymsum::planar
