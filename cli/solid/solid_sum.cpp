#include "solid/solid_sum.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

#include "dymsum/convex_memory.h"
#include "progress_bar.h"
#include "report.h"
#include "solid/any_solid_sum.h"
#include "solid/solid_limits.h"
#include "solid/solid_operands.h"
#include "solid/solid_outputs.h"
#include "timing.h"

namespace dymsum::cli {
namespace {

ConvexEngine engine_of(const SumCommand& command) {
  if (command.engine == "winding")
    throw Stop(kUsage, "--engine winding is for planar operands; for solids there are fast and brute");
  return command.engine == "brute" ? ConvexEngine::brute : ConvexEngine::walk;
}

/// The tier and the sum, of more than two solids one after the other, exactly.
std::pair<int, SolidSum> sum_of(const std::vector<SolidInput>& inputs, const Mesh& q, ConvexEngine engine,
                                std::uint64_t memory) {
  ConvexSum sum = require(convex_sum_within(inputs[0].mesh, q, memory));
  for (std::size_t k = 2;; ++k) {
    if (engine == ConvexEngine::brute) sum.rebuild(engine);
    SolidSum result = sum.sum();
    throw_if_interrupted();
    if (k >= inputs.size()) return {sum.tier_bits(), std::move(result)};
    sum = require(convex_sum_within(result, inputs[k].mesh, memory));
  }
}

void print_text(std::ostream& out, const std::string& verb, const std::vector<SolidInput>& inputs, const SolidSum& sum,
                int tier, const Timing& timing) {
  const FacetKinds kinds = facet_kinds(sum);
  out << verb << " of ";
  for (std::size_t i = 0; i < inputs.size(); ++i)
    out << (i == 0 ? "" : i + 1 < inputs.size() ? ", " : " and ") << inputs[i].file;
  out << "\n  " << counted(sum.facets.size(), "facet") << " (" << kinds.with_face << " with a face, " << kinds.of_edges
      << " edge + edge), " << counted(sum.vertices.size(), "vertex", "vertices") << "\n  volume "
      << shown(volume_of(sum)) << ", area " << shown(surface_of(sum)) << "\n  " << shown(timing) << ", "
      << tier_name(tier) << " coordinates\n";
}

/// Of solids that need not be convex.
ExitCode run_general(const SumVerb& verb, const SumCommand& command, const std::vector<SolidInput>& inputs,
                     const SolidOutput& how) {
  if (verb.is_sum && inputs.size() == 2) announce_cost(inputs[0].mesh, inputs[1].mesh);
  const SolidRun run{verb.name,        command.engine,    inputs,           command.report, command.output.files, how,
                     verb.empty_is_no, command.semantics, command.memory_mb};
  return run_any_solid(run, [&](const SpatialOptions& options) -> Result<SolidOutcome> {
    std::vector<Mesh> operands;
    if (inputs.size() > 2)
      for (const SolidInput& input : inputs) operands.push_back(input.mesh);
    Result<SpatialSum> sum =
        operands.empty() ? verb.solid(inputs[0].mesh, inputs[1].mesh, options) : minkowski_sum(operands, options);
    if (!sum) return sum.error();
    return SolidOutcome{*std::move(sum), Json::object(), ""};
  });
}

}  // namespace

ExitCode run_solid_sum(const SumVerb& verb, const SumCommand& command) {
  refuse_options(*command.parser, {"--round-repair"}, "is for planar operands");
  const ConvexEngine engine = engine_of(command);
  std::ostream& out = report_stream(command.output.files, command.report.json);
  if (!writes_to_stdout(command.output.files)) refuse_options(*command.parser, {"--to"}, "is the format of -o -");
  const SolidOutput how{command.parser->count("--to") > 0 ? command.output.to : "off", command.input.hull,
                        command.triangulate, command.round};
  check_solid_outputs(command.output.files, how);
  if (!writes_mesh(command.output.files, how))
    refuse_options(*command.parser, {"--triangulate"}, "belongs to -o FILE.off and other meshes");
  std::vector<std::string> operands = command.operands;
  operands.insert(operands.end(), command.more.begin(), command.more.end());
  are_solid(operands, command.input);
  const std::vector<SolidInput> inputs = read_solids(operands, command.input);
  const auto convex = [](const SolidInput& input) { return !convexity_error(input.mesh); };
  const std::vector<std::string>& files = command.output.files;
  if (!verb.is_sum || std::any_of(files.begin(), files.end(), is_stage_mesh) ||
      !std::all_of(inputs.begin(), inputs.end(), convex))
    return run_general(verb, command, inputs, how);
  const InterruptGuard guard;
  const Mesh q = verb.reflects_second ? negated(inputs[1].mesh) : inputs[1].mesh;
  const std::uint64_t memory = memory_bytes(command.memory_mb);
  const auto [made, timing] = timed(command.report.repeat, [&] { return sum_of(inputs, q, engine, memory); });
  const auto& [tier, sum] = made;
  std::vector<std::string> texts;
  for (const std::string& file : command.output.files) texts.push_back(solid_output(sum, file, how));
  for (std::size_t i = 0; i < texts.size(); ++i) write_text(command.output.files[i], texts[i]);
  if (command.report.json) {
    Json json = report_head(verb.name, solid_inputs_json(inputs), tier, timing);
    json["engine"] = command.engine;
    json["semantics"] = command.semantics;
    json.update(solid_sum_json(sum));
    print_report(json);
    return kDone;
  }
  print_text(out, verb.name, inputs, sum, tier, timing);
  return kDone;
}

}  // namespace dymsum::cli
