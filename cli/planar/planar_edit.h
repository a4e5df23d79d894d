// Regions edited by a script, and sessions that are made again.
#pragma once

#include <string>
#include <vector>

#include "dymsum/edit_script.h"
#include "exit_code.h"
#include "inputs.h"
#include "options.h"
#include "outputs.h"

namespace dymsum::cli {

struct PlanarEdit {
  std::vector<std::string> operands;
  std::string script;
  EditOptions options;
  OutputOptions output;
  std::string film, record;  ///< files; empty: none
  bool keep_going = false;   ///< past steps that are refused
  ReportOptions report;
  InputOptions input;
};

/// Makes the steps of the script, writes and reports. Stops with bad input where a step is refused, before anything is
/// written; kNo where that is passed over.
ExitCode run_planar_edit(const PlanarEdit& edit);

/// Makes the recorded session of a file again, whose text this is; kNo where a step differs.
ExitCode run_replay(const std::string& file, const std::string& text, const ReportOptions& report);

}  // namespace dymsum::cli
