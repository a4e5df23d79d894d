// What sum, nfp and erode share: their options, and running one of them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "dymsum/planar_sum.h"
#include "exit_code.h"
#include "inputs.h"
#include "options.h"
#include "outputs.h"

namespace CLI {
class App;
}

namespace dymsum::cli {

/// What makes a verb of this kind.
struct SumVerb {
  std::string name, first, second, description, example;
  /// The public function it calls.
  std::function<Result<PlanarSum>(const Region&, const Region&, const SumOptions&)> compute;
  bool reflects_second = false;  ///< the convolution behind it is that of P and -Q
  bool empty_is_no = false;      ///< an empty result ends with kNo
};

/// What the command line asks of it.
struct SumCommand {
  std::vector<std::string> operands{"", ""};
  std::string engine = "fast", semantics = "closed";
  ReportOptions report;
  InputOptions input;
  OutputOptions output;
};

/// Adds the verb with its operands and all options.
void add_sum_verb(CLI::App& app, const SumVerb& verb, Action& action);

/// Reads, computes, writes the outputs and reports.
ExitCode run_sum(const SumVerb& verb, const SumCommand& command);

}  // namespace dymsum::cli
