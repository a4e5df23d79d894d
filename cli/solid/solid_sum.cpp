#include "solid/solid_sum.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>

#include "report.h"
#include "solid/solid_limits.h"
#include "solid/solid_operands.h"
#include "solid/solid_results.h"
#include "solid/solid_run.h"

namespace dymsum::cli {
namespace {

/// Two operands: as they are by their planes where both are so.
std::array<SpatialOperand, 2> operands_of(const SolidInput& p, const SolidInput& q) {
  if (p.by_planes && q.by_planes) return {*p.by_planes, *q.by_planes};
  return {p.operand(), q.operand()};
}

/// The operand of a sum: its second one inside out where the verb says so.
SolidInput term_of(const SumVerb& verb, SolidInput input, bool second) {
  if (!second || !verb.reflects_second) return input;
  if (input.by_planes) input.by_planes = negated(*input.by_planes);
  if (input.result) input.result = negated(*input.result);
  else input.mesh = negated(input.mesh);
  return input;
}

/// One after the other, in their order.
Result<SpatialSum> sum_in_order(const SumVerb& verb, const std::vector<SolidInput>& inputs,
                                const SpatialOptions& options) {
  SolidInput sum = inputs[0];
  for (std::size_t k = 1; k < inputs.size(); ++k) {
    const SolidInput term = term_of(verb, inputs[k], k == 1);
    const auto [p, q] = operands_of(sum, term);
    Result<SpatialSum> next = minkowski_sum(p, q, options);
    if (!next) return next;
    sum.result = *std::move(next);
    if (sum.by_planes) sum.by_planes = sum.result;
  }
  return *std::move(sum.result);
}

Result<SpatialSum> sum_of(const SumVerb& verb, const std::vector<SolidInput>& inputs, const SpatialOptions& options) {
  const auto is_result = [](const SolidInput& input) { return input.result || input.by_planes; };
  const bool results = std::any_of(inputs.begin(), inputs.end(), is_result);
  if (verb.solids) {
    std::vector<SpatialOperand> operands;
    for (const SolidInput& input : inputs) operands.push_back(input.operand());
    return verb.solids(operands, options);
  }
  if (verb.is_sum && results) return sum_in_order(verb, inputs, options);
  if (inputs.size() == 2 && !results) return verb.solid(inputs[0].mesh, inputs[1].mesh, options);
  if (verb.result) {
    const auto [p, q] = operands_of(inputs[0], inputs[1]);
    return verb.result(p, q, options);
  }
  std::vector<Mesh> operands;
  for (const SolidInput& input : inputs) operands.push_back(input.mesh);
  return minkowski_sum(operands, options);
}

}  // namespace

ExitCode run_solid_sum(const SumVerb& verb, const SumCommand& command) {
  refuse_options(*command.parser, {"--round-repair"}, "is for planar operands");
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
  if (verb.solids && command.semantics == "regular") report_left_out(inputs, command.input.quiet);
  const auto convex = [](const SolidInput& input) { return input.result || !convexity_error(input.mesh); };
  if (verb.is_sum && inputs.size() == 2 && !std::all_of(inputs.begin(), inputs.end(), convex))
    announce_cost(inputs[0].mesh, inputs[1].mesh);
  SolidRun run{verb.name,        command.engine,    inputs,           command.report, files, how,
               verb.empty_is_no, command.semantics, command.memory_mb};
  run.of_open_sets = verb.solids && command.semantics == "open";
  return run_solid(run, [&](const SpatialOptions& options) -> Result<SolidOutcome> {
    Result<SpatialSum> sum = sum_of(verb, inputs, options);
    if (!sum) return sum.error();
    return SolidOutcome{*std::move(sum), Json::object(), ""};
  });
}

}  // namespace dymsum::cli
