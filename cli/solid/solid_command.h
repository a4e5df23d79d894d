// What verbs have in common whose operands and results are solids alone.
#pragma once

#include <string>
#include <vector>

#include "solid/solid_run.h"

namespace CLI {
class App;
}

namespace dymsum::cli {

struct SolidCommand {
  const CLI::App* parser = nullptr;
  std::vector<std::string> operands, files;
  std::string to = "off", engine = "fast", semantics = "closed";
  double memory_mb = 0;  ///< 0: no limit
  double round = 0;      ///< as SolidOutput
  ReportOptions report;
  InputOptions input;
};

/// Declares -o, --to, --engine, --semantics, --round, --json, --repeat, --exact, --memory, --repair, --hull and --from.
void add_solid_options(CLI::App& verb, SolidCommand& command, OperandKind kind = OperandKind::solid);

/// Checks outputs and reads the operands.
SolidRun read_solid_run(const std::string& verb, const SolidCommand& command);

}  // namespace dymsum::cli
