#include "solid_sum.h"

#include <iostream>

#include "dymsum/convex_sum.h"
#include "progress_bar.h"
#include "report.h"
#include "solid_operands.h"
#include "solid_outputs.h"
#include "timing.h"

namespace dymsum::cli {
namespace {

ConvexEngine engine_of(const SumCommand& command) {
  if (command.engine == "winding") throw Stop(kUsage, "solids have the engines fast and brute");
  return command.engine == "brute" ? ConvexEngine::brute : ConvexEngine::walk;
}

}  // namespace

ExitCode run_solid_sum(const SumVerb& verb, const SumCommand& command) {
  if (verb.name == "erode") throw Stop(kUsage, "erode is defined for planar regions so far");
  refuse_options(*command.parser, {"--semantics", "--round-repair"}, "is for planar operands");
  const ConvexEngine engine = engine_of(command);
  check_solid_outputs(command.output.files);
  const std::vector<SolidInput> inputs = read_convex_solids(command.operands, command.input);
  const InterruptGuard guard;
  const Mesh q = verb.reflects_second ? negated(inputs[1].mesh) : inputs[1].mesh;
  const auto [made, timing] = timed(command.report.repeat, [&] {
    ConvexSum sum = require(ConvexSum::create(inputs[0].mesh, q));
    if (engine == ConvexEngine::brute) sum.rebuild(engine);
    SolidSum result = sum.sum();
    throw_if_interrupted();
    return std::pair{sum.tier_bits(), std::move(result)};
  });
  const auto& [tier, sum] = made;
  std::vector<std::string> texts;
  for (const std::string& file : command.output.files) texts.push_back(solid_output(sum, file));
  for (std::size_t i = 0; i < texts.size(); ++i) write_text(command.output.files[i], texts[i]);
  if (command.report.json) {
    Json json = report_head(verb.name, solid_inputs_json(inputs), tier, timing);
    json["engine"] = command.engine;
    json.update(solid_sum_json(sum));
    print_report(json);
    return kDone;
  }
  const Json numbers = solid_sum_json(sum);
  std::cout << verb.name << " of " << inputs[0].file << " and " << inputs[1].file << "\n  " << counted(sum.facets.size(), "facet") << " ("
            << numbers["convolution"]["fv"] << " with a face, " << numbers["convolution"]["ee"] << " edge + edge), "
            << counted(sum.vertices.size(), "vertex", "vertices") << "\n  volume " << sum.volume() << ", area " << sum.area() << "\n  " << timing.median_ms
            << " ms, " << (tier == 0 ? "arbitrary precision" : std::to_string(tier) + "-bit") << " coordinates\n";
  return kDone;
}

}  // namespace dymsum::cli
