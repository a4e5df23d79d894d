#include "solid/solid_sum.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "report.h"
#include "solid/solid_limits.h"
#include "solid/solid_operands.h"
#include "solid/solid_results.h"
#include "solid/solid_run.h"

namespace dymsum::cli {
namespace {

bool is_result(const SolidInput& input) { return input.result.has_value(); }

/// Only sums take results in fractions in any position; others as the first operand, if at all.
void refuse_results(const SumVerb& verb, const std::vector<SolidInput>& inputs) {
  if (verb.name == "sum") return;
  refuse_fractions({inputs.begin() + (verb.result ? 1 : 0), inputs.end()});
}

/// A result first, then all other operands, in their order.
Result<SpatialSum> sum_with_results(const SumVerb& verb, const std::vector<SolidInput>& inputs,
                                    const SpatialOptions& options) {
  const auto first = std::find_if(inputs.begin(), inputs.end(), is_result);
  Result<SpatialSum> sum = *first->result;
  for (auto input = inputs.begin(); input != inputs.end() && sum; ++input)
    if (input != first)
      sum = input->result ? minkowski_sum(*sum, *input->result, options) : verb.result(*sum, input->mesh, options);
  return sum;
}

Result<SpatialSum> sum_of(const SumVerb& verb, const std::vector<SolidInput>& inputs, const SpatialOptions& options) {
  if (std::any_of(inputs.begin(), inputs.end(), is_result)) return sum_with_results(verb, inputs, options);
  if (inputs.size() == 2 && !verb.solids) return verb.solid(inputs[0].mesh, inputs[1].mesh, options);
  std::vector<Mesh> operands;
  for (const SolidInput& input : inputs) operands.push_back(input.mesh);
  return verb.solids ? verb.solids(operands, options) : minkowski_sum(operands, options);
}

}  // namespace

ExitCode run_solid_sum(const SumVerb& verb, const SumCommand& command) {
  refuse_options(*command.parser, {"--round-repair"}, "is for planar operands");
  if (verb.solids) refuse_options(*command.parser, {"--semantics"}, "of " + verb.name + " is for planar operands");
  if (command.engine == "winding")
    throw Stop(kUsage, "--engine winding is for planar operands; for solids there are fast and brute");
  const std::vector<std::string>& files = command.output.files;
  report_stream(files, command.report.json);
  if (!writes_to_stdout(files)) refuse_options(*command.parser, {"--to"}, "is the format of -o -");
  const SolidOutput how{command.parser->count("--to") > 0 ? command.output.to : "off", command.input.hull,
                        command.triangulate, command.round};
  check_solid_outputs(files, how);
  if (!writes_mesh(files, how))
    refuse_options(*command.parser, {"--triangulate"}, "belongs to -o FILE.off and other meshes");
  std::vector<std::string> operands = command.operands;
  operands.insert(operands.end(), command.more.begin(), command.more.end());
  are_solid(operands, command.input);
  const std::vector<SolidInput> inputs = read_solids_and_results(operands, command.input);
  refuse_results(verb, inputs);
  const auto convex = [](const SolidInput& input) { return input.result || !convexity_error(input.mesh); };
  if (verb.is_sum && inputs.size() == 2 && !std::all_of(inputs.begin(), inputs.end(), convex))
    announce_cost(inputs[0].mesh, inputs[1].mesh);
  const SolidRun run{verb.name,        command.engine,    inputs,           command.report, files, how,
                     verb.empty_is_no, command.semantics, command.memory_mb};
  return run_solid(run, [&](const SpatialOptions& options) -> Result<SolidOutcome> {
    Result<SpatialSum> sum = sum_of(verb, inputs, options);
    if (!sum) return sum.error();
    return SolidOutcome{*std::move(sum), Json::object(), ""};
  });
}

}  // namespace dymsum::cli
