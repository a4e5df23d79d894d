// dymsum slice ROBOT OBSTACLE --tan-half N/D | --angle RAD | --degrees DEG
#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "dymsum/cspace_obstacle.h"
#include "planar/turned_region.h"
#include "solid/solid_operands.h"
#include "solid/solid_slice.h"
#include "verbs/commands.h"
#include "verbs/sum_command.h"

namespace dymsum::cli {
namespace {

struct SliceCommand {
  SumCommand sum;
  std::string tan_half;
  AngleOptions angle;
  std::optional<double> error, z;
  bool reflect = false;
};

Orientation requested_orientation(const SliceCommand& command) {
  if (command.tan_half.empty() != command.angle.given())
    throw Stop(kUsage, "give one of --tan-half, --angle and --degrees");
  if (!command.angle.given()) {
    refuse_options(*command.sum.parser, {"--error"}, "belongs to --angle and --degrees");
    return require_option(Orientation::parse(command.tan_half), "--tan-half");
  }
  const double radians = read_angle(command.angle).radians();
  return require_option(command.error ? Orientation::nearest(radians, *command.error) : Orientation::nearest(radians),
                        "--angle");
}

SumVerb slice_verb() {
  SumVerb verb;
  verb.name = "slice";
  verb.first = {"ROBOT", "The shape that turns about the origin of its coordinates, and moves; or the solid P"};
  verb.second = {"OBSTACLE", "The shape that stays; or the solid Q"};
  verb.description =
      "One orientation of a configuration-space obstacle: OBSTACLE (+) -ROBOT, the robot turned exactly; of solids one "
      "height of the sum P + Q";
  verb.footer =
      "The robot comes first, as for cspace, clearance and path; nfp takes the shape that stays first. Of solids only\n"
      "what meets the height --z is computed; --reflect takes P + -Q, the places of a tool Q that hit the part P.\n"
      "Example: dymsum slice peg.wkt slot.wkt --tan-half 1/3 -o slice.svg\n"
      "Example: dymsum slice part.off tool.off --z 1.5 --reflect -o slice.svg";
  verb.planar_result = true;
  verb.reflects_second = true;
  verb.names = {"O", "R(θ)", "O ⊕ −R(θ)"};
  verb.page = "obstacle";
  verb.solid_page = "solids";
  return verb;
}

ExitCode run_slice(const SliceCommand& command) {
  if (are_solid(command.sum.operands, command.sum.input)) {
    refuse_options(*command.sum.parser, {"--tan-half", "--angle", "--degrees", "--error"}, "is for planar operands");
    if (!command.z) throw Stop(kUsage, "slice of solids wants the height --z");
    return run_solid_slice(command.sum, *command.z, command.reflect);
  }
  refuse_options(*command.sum.parser, {"--z", "--reflect", "--hull"}, "is for solids");
  SumVerb verb = slice_verb();
  const Orientation theta = requested_orientation(command);
  verb.orientation = theta;
  verb.planar = [theta](std::span<const PlanarOperand> sets, const SumOptions& options) {
    const auto region = [&](std::size_t k) -> const Region& { return *std::get<const Region*>(sets[k].set()); };
    return cspace_slice(region(0), region(1), theta, options);
  };
  verb.shown = [theta](const Region& robot, const Region& obstacle) {
    return std::array{obstacle, turned(robot, theta).value_or(robot)};
  };
  return run_sum(verb, command.sum);
}

}  // namespace

void add_slice(CLI::App& app, Action& action) {
  auto command = std::make_shared<SliceCommand>();
  CLI::App& verb = declare_sum_verb(app, slice_verb(), command->sum);
  verb.add_option("--tan-half", command->tan_half,
                  "Planar operands: tangent of half the angle, exact: 3/7, 0.25; inf is half a turn")
      ->type_name("N/D");
  add_angle_options(verb, command->angle, "Planar operands: the angle, met within 2^-50 or --error,");
  add_error_option(verb, command->error,
                   "Planar operands: largest error of the angle in radians: a simpler tangent is taken");
  within(verb.add_option("--z", command->z, "Solids: the height, a number taken at face value"), -1e300, 1e300)
      ->type_name("Z");
  verb.add_flag("--reflect", command->reflect, "Solids: of P + -Q instead of P + Q");
  verb.callback([command, &action] {
    action = [command] {
      SumVerb shown = slice_verb();
      // The tangent that was taken for its simplicity; others the page finds by itself.
      if (command->error && !are_solid(command->sum.operands, command->sum.input))
        shown.orientation = requested_orientation(*command);
      return with_viewer(shown, command->sum, [command] { return run_slice(*command); })();
    };
  });
}

}  // namespace dymsum::cli
