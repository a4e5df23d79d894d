// dymsum rotate P Q --steps N
#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <sstream>

#include "commands.h"
#include "options.h"
#include "solid_motion.h"

namespace dymsum::cli {
namespace {

struct RotateCommand {
  std::vector<std::string> operands{"", ""}, files;
  std::size_t steps = 0;
  double degrees = 360;
  std::string axis = "0,0,1";
  ReportOptions report;
  InputOptions input;
};

ExitCode run(const RotateCommand& command) {
  if (!are_solid(command.operands)) throw Stop(kUsage, "rotate wants convex solids so far: .off .obj .stl .ply");
  const Point3 axis = parse_point(command.axis, "--axis");
  const std::vector<SolidInput> inputs = read_convex_solids(command.operands, command.input);
  std::vector<SolidFramePose> poses;
  for (std::size_t k = 0; k < command.steps; ++k) {
    const double degrees = command.degrees * static_cast<double>(k) / static_cast<double>(command.steps);
    SolidFramePose pose;
    // Every angle by itself: nothing adds up.
    pose.p.rotation = require(Rotation::about(axis, degrees / 180 * std::acos(-1.0)));
    std::ostringstream label;
    label << degrees << " degrees";
    pose.label = label.str();
    poses.push_back(pose);
  }
  return run_solid_motion("rotate", inputs, poses, command.files, command.report);
}

}  // namespace

void add_rotate(CLI::App& app, Action& action) {
  auto command = std::make_shared<RotateCommand>();
  CLI::App& verb = *app.add_subcommand("rotate", "P turns and P (+) Q follows, frame by frame, exact at every frame (convex solids)");
  add_operands(verb, "P", "Q", command->operands);
  verb.add_option("--steps", command->steps, "Frames of the turn")->type_name("N")->required()->check(CLI::Range(std::size_t{1}, std::size_t{1000000}));
  verb.add_option("--axis", command->axis, "Axis through the origin")->type_name("X,Y,Z")->capture_default_str();
  verb.add_option("--degrees", command->degrees, "The whole turn; each frame's angle is met within 2^-28 and kept exactly from there")
      ->type_name("DEG")
      ->capture_default_str();
  verb.add_option("-o", command->files,
                  "Write .html (a page that plays, facets coloured by kind and by what changed) or the last frame as .off .obj .stl .ply .glb .json; repeatable")
      ->type_name("FILE")
      ->allow_extra_args(false);
  add_report_options(verb, command->report, "Turn N times and report the median and minimum frame");
  add_input_options(verb, command->input);
  verb.footer("Example: dymsum rotate rod.off box.off --steps 500 --axis 1,2,3 -o turn.html");
  verb.callback([command, &action] { action = [command] { return run(*command); }; });
}

}  // namespace dymsum::cli
