#include "solid/solid_sum.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "dymsum/solid_union.h"
#include "report.h"
#include "solid/solid_limits.h"
#include "solid/solid_operands.h"
#include "solid/solid_results.h"
#include "solid/solid_run.h"

namespace dymsum::cli {
namespace {

bool is_result(const SolidInput& input) { return input.result || input.by_planes; }

/// The exact result that an input is.
Result<SpatialSum> result_of(const SolidInput& input, const SpatialOptions& options) {
  if (input.by_planes) return *input.by_planes;
  return input.result ? *input.result : united(std::span(&input.mesh, 1), options);
}

/// The operand of a sum: its second one inside out where the verb says so.
SolidInput term_of(const SumVerb& verb, SolidInput input, bool second) {
  if (!second || !verb.reflects_second) return input;
  if (input.by_planes) input.by_planes = negated(*input.by_planes);
  if (input.result) input.result = negated(*input.result);
  else input.mesh = negated(input.mesh);
  return input;
}

Result<SpatialSum> sum_of_two(const SolidInput& p, const SolidInput& q, const SpatialOptions& options) {
  if (p.by_planes && q.by_planes) return minkowski_sum(*p.by_planes, *q.by_planes, options);
  if (p.result && q.result) return minkowski_sum(*p.result, *q.result, options);
  if (p.result) return minkowski_sum(*p.result, q.mesh, options);
  return q.result ? minkowski_sum(p.mesh, *q.result, options) : minkowski_sum(p.mesh, q.mesh, options);
}

/// All operands in their order.
Result<SpatialSum> sum_with_results(const SumVerb& verb, const std::vector<SolidInput>& inputs,
                                    const SpatialOptions& options) {
  if (!verb.is_sum) {
    const Result<SpatialSum> p = result_of(inputs[0], options), q = result_of(inputs[1], options);
    return !p ? p : !q ? q : verb.result(*p, *q, options);
  }
  SolidInput sum = inputs[0];
  for (std::size_t k = 1; k < inputs.size(); ++k) {
    Result<SpatialSum> next = sum_of_two(sum, term_of(verb, inputs[k], k == 1), options);
    if (!next) return next;
    sum.result = *std::move(next);
    if (sum.by_planes) sum.by_planes = sum.result;
  }
  return *std::move(sum.result);
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
  if (!verb.is_sum && !verb.result) refuse_fractions(inputs);
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
