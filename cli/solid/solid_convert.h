// dymsum convert IN OUT for solids, and dymsum hull IN OUT.
#pragma once

#include <string>

#include "exit_code.h"
#include "inputs.h"

namespace CLI {
class App;
}

namespace dymsum::cli {

struct SolidConvert {
  const CLI::App* parser = nullptr;  ///< which options were given
  std::string verb;
  std::string in, out;
  std::string to;  ///< the format of the output -
  bool json = false, canonical = false, triangulate = false;
  InputOptions input;
};

ExitCode run_solid_convert(const SolidConvert& command);

}  // namespace dymsum::cli
