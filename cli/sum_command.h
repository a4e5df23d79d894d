// What sum, nfp and erode share: their options, and running one of them.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "dymsum/planar_sum.h"
#include "exit_code.h"
#include "inputs.h"
#include "outputs.h"

namespace dymsum::cli {

/// What the verb chosen on the command line does; returns the exit code.
using Action = std::function<ExitCode()>;

struct SumCommand {
  std::string verb;
  std::vector<std::string> operands{"", ""};
  std::string engine = "fast", semantics = "closed";
  std::size_t repeat = 1;
  bool json = false;
  InputOptions input;
  OutputOptions output;

  /// The computation, of the public function's type.
  std::function<Result<PlanarSum>(const Region&, const Region&, const SumOptions&)> compute;
  /// The second operand of the convolution behind it: Q or -Q.
  bool reflects_second = false;
};

/// Declares operands named `first` and `second` and all options.
void add_sum_options(CLI::App& verb, SumCommand& command, const char* first, const char* second);

/// Reads, computes, writes the outputs and reports. kNo when `empty_is_no` and the result is empty.
ExitCode run_sum(const SumCommand& command, bool empty_is_no = false);

/// Declares --repair and --from.
void add_input_options(CLI::App& verb, InputOptions& options);

}  // namespace dymsum::cli
