// What every JSON object of the command line has in common: how it begins, how it is printed, and how failures look.
#pragma once

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "dymsum/result.h"
#include "exit_code.h"
#include "timing.h"

namespace dymsum::cli {

using Json = nlohmann::ordered_json;

/// How every report begins: verb, version, inputs, tier (bits of the integers; 0 for arbitrary precision), time_ms and
/// repeats. `stages` are the medians of stages in milliseconds, where they are known.
Json report_head(const std::string& verb, Json inputs, int tier, const Timing& timing, Json stages = Json::object());

/// The text of a report, as all are printed. Bytes of file names that are no text are replaced.
std::string report_text(const Json& report);
/// Prints a report on standard output.
void print_report(const Json& report);

/// {"code", "message", "evidence", "exit"} of bad input: the message is the sentence on standard error, the evidence
/// what applies of file, line, part, ring, vertex, face, place, and the exit code the one that this error ends a run
/// with.
Json error_json(const Error& error);
/// The object of a run that failed: verb, version, and error with its exit code.
Json failure_json(const std::string& verb, const Stop& stop);

}  // namespace dymsum::cli
