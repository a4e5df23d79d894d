// Exact results of solids as operands.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dymsum/spatial_sum.h"
#include "solid/solid_inputs.h"

namespace dymsum::cli {

/// Whether a file, or standard input, holds an exact result of solids, by its first characters.
bool holds_solid_result(const std::string& file, const InputOptions& options);

/// That result, as it is. Stops where it is none, and for options that are for coordinates in doubles.
SpatialSum read_solid_result(const std::string& file, const InputOptions& options);

/// As an operand: its regular part, a solid like any other where doubles hold its vertices.
SolidInput result_operand(const std::string& file, const InputOptions& options);

/// Stops where an input is a result that no doubles hold, and says what takes it and what writes it in doubles.
void refuse_fractions(const std::vector<SolidInput>& inputs);

}  // namespace dymsum::cli
