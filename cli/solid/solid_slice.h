// slice of two solids: the section of their sum at one height.
#pragma once

#include "verbs/sum_command.h"

namespace dymsum::cli {

/// Runs a slice of P (+) Q, with `reflected` one of P (+) -Q. Writes planar files.
ExitCode run_solid_slice(const SumCommand& command, double z, bool reflected);

}  // namespace dymsum::cli
