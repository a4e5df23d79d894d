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

/// As an operand: where doubles hold its vertices its regular part is a solid like any other.
SolidInput result_operand(const std::string& file, const InputOptions& options);

/// For verbs that take solids in doubles. Stops where an input is a result that no doubles hold, and says what takes it
/// and what writes it in doubles; says what is left out where something is tight.
void refuse_fractions(const std::vector<SolidInput>& inputs, bool quiet);
/// Says, unless it is to be quiet, which results have tight features, for verbs that leave them out.
void report_left_out(const std::vector<SolidInput>& inputs, bool quiet);

}  // namespace dymsum::cli
