// dymsum info F for solids.
#pragma once

#include <string>
#include <vector>

#include "exit_code.h"
#include "inputs.h"

namespace dymsum::cli {

struct SolidInfo {
  std::string file;
  bool json = false;
  InputOptions input;
  std::vector<std::string> pictures;  ///< .glb
};

ExitCode run_solid_info(const SolidInfo& command);

}  // namespace dymsum::cli
