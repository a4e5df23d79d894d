#include "planar/obstacle_input.h"

#include "dymsum/obstacle_file.h"
#include "progress_bar.h"
#include "solid/solid_operands.h"

namespace dymsum::cli {

void add_obstacle_input(CLI::App& verb, ObstacleInput& input) {
  const char* const file = ": a file, FILE#NAME for one shape of several, or - for standard input";
  verb.add_option("ROBOT", input.operands[0], std::string("The robot") + file)->type_name("");
  verb.add_option("OBSTACLE", input.operands[1], std::string("The obstacle") + file)->type_name("");
  verb.add_option("--obstacle", input.file, "Instead of ROBOT and OBSTACLE: a .obstacle file that dymsum cspace wrote")
      ->type_name("FILE");
}

void check_obstacle_input(const std::string& verb, const ObstacleInput& input) {
  const bool both = !input.operands[0].empty() && !input.operands[1].empty(), any = !input.operands[0].empty();
  if (input.file.empty() && !both) throw Stop(kUsage, verb + " wants ROBOT and OBSTACLE, or --obstacle FILE");
  if (!input.file.empty() && any) throw Stop(kUsage, "give ROBOT and OBSTACLE or --obstacle, not both");
  const InputOptions& reading = input.input;
  const bool changes = reading.repair() || !reading.fill.empty() || !reading.join.empty() || !reading.snap.empty();
  const bool reads = reading.drop_z || !reading.from.empty() || !reading.curve_error.empty() ||
                     !reading.curve_bound.empty() || !reading.nested.empty();
  if (!input.file.empty() && (changes || reads))
    throw Stop(kUsage,
               "--repair, --fill, --join, --snap, --curve-error, --curve-bound, --drop-z and --from do not apply to a "
               "file of an obstacle");
  if (input.file.empty()) require_planar(verb, input.operands);
}

ObstacleSource read_source(const ObstacleInput& input) {
  if (input.file.empty()) return {read_inputs(input.operands, input.input), std::nullopt};
  CspaceObstacle read = require(read_obstacle(input.file));
  return {{{input.file + "#robot", read.robot()}, {input.file + "#obstacle", read.obstacle()}}, std::move(read)};
}

CspaceObstacle obstacle_of(ObstacleSource& source, const Region& robot, const ObstacleOptions& options) {
  if (source.read) return std::move(*source.read);
  return require_of(source.inputs, CspaceObstacle::create(robot, source.inputs[1].region, options));
}

CspaceObstacle obstacle_of(ObstacleSource& source) {
  ProgressBar bar;
  ObstacleOptions options;
  options.progress = bar.callback();
  return obstacle_of(source, source.inputs[0].region, options);
}

Json report_of_answers(const std::string& verb, const ObstacleSource& source, const CspaceObstacle& obstacle,
                       const Timing& timing) {
  return report_head(verb, inputs_json(source.inputs), require(obstacle.slice({})).stats.tier_bits, timing,
                     {{"obstacle", obstacle.work().ms}, {"answers", timing.median_ms}});
}

}  // namespace dymsum::cli
