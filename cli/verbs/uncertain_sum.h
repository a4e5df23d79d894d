// sum, nfp and erode of regions that are not known exactly.
#pragma once

#include "exit_code.h"
#include "verbs/sum_command.h"

namespace dymsum::cli {

/// Reads, computes, writes the outputs and reports. Requires: command.uncertain.given().
ExitCode run_uncertain_sum(const SumVerb& verb, const SumCommand& command);

}  // namespace dymsum::cli
