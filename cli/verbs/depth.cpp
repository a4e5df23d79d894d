// dymsum depth P Q
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "dymsum/convex_sum.h"
#include "options.h"
#include "planar/tier.h"
#include "solid/solid_operands.h"
#include "solid/solid_outputs.h"
#include "timing.h"
#include "verbs/commands.h"

namespace dymsum::cli {
namespace {

struct DepthCommand {
  std::vector<std::string> operands{"", ""};
  std::string moved, axis;
  AngleOptions angle;
  ReportOptions report;
  InputOptions input;
};

std::string feature_text(const SolidFeature& f) {
  if (f.kind == SolidFeature::Kind::vertex) return "vertex " + std::to_string(f.a);
  if (f.kind == SolidFeature::Kind::edge) return "edge " + std::to_string(f.a) + "-" + std::to_string(f.b);
  return "face " + std::to_string(f.a);
}

ExitCode run(const DepthCommand& command) {
  require_solid("depth", command.operands, command.input);
  if (command.axis.empty() == command.angle.given()) throw Stop(kUsage, "--axis and --angle or --degrees go together");
  const Point3 moved = command.moved.empty() ? Point3{} : parse_point(command.moved, "--move");
  SolidPose pose;
  if (!command.axis.empty())
    pose.rotation = require_option(
        Rotation::about(parse_point(command.axis, "--axis"), read_angle(command.angle).radians()), "--axis");
  const std::vector<SolidInput> inputs = read_convex_solids(command.operands, command.input);
  const auto [depth, timing] = timed(command.report.repeat, [&] {
    return require(penetration_depth(inputs[0].mesh, inputs[1].mesh, pose, {}, moved));
  });
  if (command.report.json) {
    Json json = report_head("depth", solid_inputs_json(inputs), tier_of(inputs[0].mesh, inputs[1].mesh), timing);
    json.update({{"inside", depth.inside},
                 {"depth", depth.depth},
                 {"depth_squared_exact", depth.depth_squared.to_string()},
                 {"direction", {depth.direction.x, depth.direction.y, depth.direction.z}},
                 {"p", feature_json(depth.p)},
                 {"q", feature_json(depth.q)}});
    print_report(json);
  } else if (depth.inside) {
    std::cout << "depth " << depth.depth << ": moving " << inputs[1].file << " by that along (" << depth.direction.x
              << ", " << depth.direction.y << ", " << depth.direction.z << ") separates them\n  "
              << feature_text(depth.p) << " of " << inputs[0].file << " and " << feature_text(depth.q) << " of "
              << inputs[1].file << " touch then\n  depth squared is exactly " << shown(depth.depth_squared) << "\n";
  } else {
    std::cout << "the interiors do not meet\n";
  }
  if (!command.report.json) print_times(std::cout, timing);
  return depth.inside ? kDone : kNo;
}

}  // namespace

void add_depth(CLI::App& app, Action& action) {
  auto command = std::make_shared<DepthCommand>();
  CLI::App& verb = *app.add_subcommand(
      "depth", "The penetration depth of convex solids: the shortest translation of Q that separates them");
  add_operands(verb, {"P", "A convex solid, which may turn"}, {"Q", "Another one, which may move"}, command->operands,
               OperandKind::solid);
  verb.add_option("--move", command->moved, "Move Q by this translation first")->type_name("X,Y,Z");
  verb.add_option("--axis", command->axis, "Turn P about this axis through the origin first")->type_name("X,Y,Z");
  add_angle_options(verb, command->angle, "by this angle,");
  add_report_options(verb, command->report, "Compute N times and report the median and minimum time");
  add_solid_input_options(verb, command->input, OperandKind::solid);
  verb.footer(
      "Exit code 4 when their interiors do not meet.\nExample: dymsum depth box.off rod.off --move 0.5,0,0 --json");
  verb.callback([command, &action] { action = [command] { return run(*command); }; });
}

}  // namespace dymsum::cli
