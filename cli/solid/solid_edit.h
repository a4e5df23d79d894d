// Solids edited by a script, and sessions that are made again.
#pragma once

#include <string>
#include <vector>

#include "dymsum/solid_edit_script.h"
#include "exit_code.h"
#include "inputs.h"
#include "options.h"

namespace dymsum::cli {

struct SolidEditing {
  std::vector<std::string> operands;
  std::string script;
  SolidEditOptions options;
  std::vector<std::string> files;
  std::string to = "off";   ///< the format of -
  std::string record;       ///< a file; empty: none
  bool keep_going = false;  ///< past steps that are refused
  ReportOptions report;
  InputOptions input;
};

/// As run_planar_edit.
ExitCode run_solid_edit(const SolidEditing& edit);

/// Whether the text of a recording is one of solids.
bool records_solids(const std::string& text);
/// As run_replay.
ExitCode run_solid_replay(const std::string& file, const std::string& text, const ReportOptions& report);

}  // namespace dymsum::cli
