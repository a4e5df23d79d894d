// sum and nfp of two solids of any shape.
#pragma once

#include "dymsum/spatial_sum.h"
#include "solid/solid_outputs.h"
#include "verbs/sum_command.h"

namespace dymsum::cli {

/// Of solids that need not be convex.
ExitCode run_any_solid_sum(const SumVerb& verb, const SumCommand& command, const std::vector<SolidInput>& inputs,
                           const SolidOutput& how);

/// .json the exact sum with provenance, else a closed mesh of triangles coloured by kind, with tight features in red in
/// .glb; a Stop where rounding would spoil it.
std::string any_solid_output(const SpatialSum& sum, const std::string& file, const SolidOutput& how);

Json any_solid_sum_json(const SpatialSum& sum);

}  // namespace dymsum::cli
