// dymsum rotate P Q --steps N
#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <optional>
#include <sstream>

#include "commands.h"
#include "options.h"
#include "planar_turn.h"
#include "solid_motion.h"

namespace dymsum::cli {
namespace {

struct RotateCommand {
  PlanarTurn planar;
  std::size_t steps = 0;
  double degrees = 360;
  std::optional<double> error;
  std::optional<std::string> axis, semantics;
};

std::vector<double> frame_degrees(const RotateCommand& command) {
  std::vector<double> degrees;
  for (std::size_t k = 0; k < command.steps; ++k)
    degrees.push_back(command.degrees * static_cast<double>(k) / static_cast<double>(command.steps));
  return degrees;
}

ExitCode run_solids(const RotateCommand& command) {
  if (command.error || command.semantics) throw Stop(kUsage, "--error and --semantics are for planar operands");
  const Point3 axis = parse_point(command.axis.value_or("0,0,1"), "--axis");
  const std::vector<SolidInput> inputs = read_convex_solids(command.planar.operands, command.planar.input);
  std::vector<SolidFramePose> poses;
  for (const double degrees : frame_degrees(command)) {
    SolidFramePose pose;
    // Every angle by itself: nothing adds up.
    pose.p.rotation = require(Rotation::about(axis, degrees / 180 * std::acos(-1.0)));
    std::ostringstream label;
    label << degrees << " degrees";
    pose.label = label.str();
    poses.push_back(pose);
  }
  return run_solid_motion("rotate", inputs, poses, command.planar.files, command.planar.report);
}

ExitCode run(const RotateCommand& command) {
  if (are_solid(command.planar.operands)) return run_solids(command);
  if (command.axis) throw Stop(kUsage, "--axis is for solid operands");
  PlanarTurn turn = command.planar;
  turn.degrees = frame_degrees(command);
  turn.error = command.error.value_or(turn.error);
  turn.semantics = command.semantics.value_or(turn.semantics);
  return run_planar_turn(turn);
}

}  // namespace

void add_rotate(CLI::App& app, Action& action) {
  auto command = std::make_shared<RotateCommand>();
  CLI::App& verb = *app.add_subcommand(
      "rotate", "P turns and P (+) Q follows, frame by frame, exact at every frame (planar, or convex solids)");
  add_operands(verb, "P", "Q", command->planar.operands);
  verb.add_option("--steps", command->steps, "Frames of the turn")
      ->type_name("N")
      ->required()
      ->check(CLI::Range(std::size_t{1}, std::size_t{1000000}));
  verb.add_option("--axis", command->axis, "Of solids: axis through the origin [0,0,1]")->type_name("X,Y,Z");
  verb.add_option("--degrees", command->degrees, "The whole turn; each frame's angle is met within 2^-28 (solids) or "
                                                 "--error (planar) and kept exactly from there")
      ->type_name("DEG")
      ->capture_default_str();
  verb.add_option("--error", command->error, "Planar: largest error of a frame's angle in radians [1e-6]")
      ->type_name("E");
  verb.add_option("--semantics", command->semantics, "Planar: closed, open or regular [closed]")
      ->check(CLI::IsMember({"closed", "open", "regular"}));
  verb.add_option("-o", command->planar.files,
                  "Write .html (a page that plays, or with a slider); planar also .svg (a film strip) and anim.svg (an "
                  "animation), solid the last frame as .off .obj .stl .ply .glb .json; repeatable")
      ->type_name("FILE")
      ->allow_extra_args(false);
  add_report_options(verb, command->planar.report, "Turn N times and report the median and minimum frame");
  add_input_options(verb, command->planar.input);
  verb.footer("Example: dymsum rotate rod.off box.off --steps 500 --axis 1,2,3 -o turn.html");
  verb.callback([command, &action] { action = [command] { return run(*command); }; });
}

}  // namespace dymsum::cli
