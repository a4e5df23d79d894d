// sum, nfp and erode of solids.
#pragma once

#include "verbs/sum_command.h"

namespace dymsum::cli {

ExitCode run_solid_sum(const SumVerb& verb, const SumCommand& command);

}  // namespace dymsum::cli
