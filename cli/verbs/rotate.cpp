// dymsum rotate P Q --steps N
#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <sstream>

#include "memory_limit.h"
#include "options.h"
#include "planar/planar_turn.h"
#include "progress_bar.h"
#include "solid/solid_motion.h"
#include "solid/solid_turns.h"
#include "verbs/commands.h"
#include "viewer/viewer_pages.h"

namespace dymsum::cli {
namespace {

struct RotateCommand {
  const CLI::App* parser = nullptr;  ///< which options were given
  PlanarRotation planar;
  std::size_t steps = 0;
  AngleOptions angle;
  std::optional<double> error;
  std::optional<std::string> axis, semantics;
  std::optional<std::size_t> frame;
  bool events = false, next = false, next_topology = false;
  std::string range;
};

Angle whole_angle(const RotateCommand& command) {
  return command.angle.given() ? read_angle(command.angle) : Angle{Rational(360), true};
}

/// The angles of frames, from zero to the end of the rotation in equal steps. The end of a whole one is its beginning,
/// and shown once.
std::vector<Angle> frame_angles(const RotateCommand& command) {
  const Angle whole = whole_angle(command);
  std::vector<Angle> angles;
  for (std::size_t k = 0; k < command.steps + (whole.whole_turns() ? 0 : 1); ++k)
    angles.push_back(whole.fraction(k, command.steps));
  return angles;
}

ExitCode run_events(const RotateCommand& command) {
  refuse_options(*command.parser, {"--frame", "--angle", "--degrees", "-o"}, "wants --steps");
  const SolidTurns turns{read_solids(command.planar.operands, command.planar.input), command.axis.value_or("0,0,1"),
                         command.range, command.next, command.next_topology};
  return run_solid_turns(turns, command.planar.report);
}

ExitCode run_solids(const RotateCommand& command) {
  refuse_options(*command.parser, {"--error", "--semantics", "--exact", "--threads"}, "is for planar operands");
  if (command.steps == 0 && (command.events || command.next || command.next_topology)) return run_events(command);
  refuse_options(*command.parser, {"--range", "--next", "--next-topology"}, "goes with --events, and without --steps");
  if (command.steps == 0) throw Stop(kUsage, "give --steps N, or --events");
  const Point3 axis = parse_point(command.axis.value_or("0,0,1"), "--axis");
  const std::vector<SolidInput> inputs = read_solids(command.planar.operands, command.planar.input);
  SolidMotion motion{"rotate", inputs, {}, command.planar.files, {}, "", command.frame};
  for (const Angle& angle : frame_angles(command))  // every angle by itself: nothing adds up
    motion.frames.push_back(
        turned_frame(require_option(Rotation::about(axis, angle.radians()), "--axis"), axis, angle.label()));
  motion.has_events = command.events;
  if (command.events) motion.events = rotation_events(inputs, command.axis.value_or("0,0,1"), whole_angle(command));
  motion.requested = {{"axis", {axis.x, axis.y, axis.z}}, {"angle_error", Rotation::kAngularError}};
  std::ostringstream note;
  note << ", each exact at an orientation within " << Rotation::kAngularError << " of its angle";
  motion.note = note.str();
  return run_solid_motion(motion, command.planar.report);
}

ExitCode run(const RotateCommand& command) {
  limit_memory(command.planar.memory_mb);
  if (are_solid(command.planar.operands, command.planar.input)) return run_solids(command);
  refuse_options(*command.parser, {"--axis", "--frame", "--events", "--range", "--next", "--next-topology"},
                 "is for solid operands");
  if (command.steps == 0) throw Stop(kUsage, "give --steps N");
  PlanarRotation rotation = command.planar;
  rotation.angles = frame_angles(command);
  rotation.error = command.error.value_or(rotation.error);
  rotation.semantics = command.semantics.value_or(rotation.semantics);
  return run_planar_rotation(rotation);
}

}  // namespace

void add_rotate(CLI::App& app, Action& action) {
  auto command = std::make_shared<RotateCommand>();
  CLI::App& verb = *app.add_subcommand("rotate", "P turns and P (+) Q follows, frame by frame, exact at every frame");
  command->parser = &verb;
  add_operands(verb, {"P", "The region or solid that turns about the origin of its coordinates"},
               {"Q", "The one that stays"}, command->planar.operands);
  const char* const steps =
      "Steps of the turn: a frame at the beginning of each, and one at the end unless it is the first again";
  whole_within(verb.add_option("--steps", command->steps, steps), 1, 1000000)->type_name("N");
  verb.add_flag("--events", command->events,
                "Of solids: list the exact angles at which the sum changes; with --steps those of its turn");
  verb.add_option("--range", command->range,
                  "Of events: from an angle counter-clockwise to another one [a whole turn from 0]")
      ->type_name("FROM:TO");
  verb.add_flag(
      "--next", command->next,
      "Only the first event behind FROM at which the sum is another one behind; exit code 4 if there is none");
  verb.add_flag("--next-topology", command->next_topology,
                "Only the first event behind FROM that changes shells, tunnels or what is tight; likewise");
  verb.add_option("--axis", command->axis, "Of solids: axis through the origin [0,0,1]")->type_name("X,Y,Z");
  whole_within(verb.add_option("--frame", command->frame, "Of solids: the frame that meshes are of, from 0 [the last]"),
               0, 1000000000)
      ->type_name("N");
  add_angle_options(verb, command->angle,
                    "The whole turn [360 degrees], its frames met within 2^-28 (solids) or --error (planar),");
  add_error_option(verb, command->error, "Planar: largest error of a frame's angle in radians [1e-6]");
  one_of<Semantics>(verb.add_option("--semantics", command->semantics, "Planar: closed, open or regular [closed]"));
  add_threads_option(verb, command->planar.threads);
  add_memory_limit(verb, command->planar.memory_mb);
  verb.add_option("-o", command->planar.files,
                  "Write .html (the viewer); planar also .svg (a film strip) and anim.svg (an animation), solid a "
                  "frame as .off "
                  ".obj .stl .ply .3mf .glb .json; repeatable")
      ->type_name("FILE")
      ->allow_extra_args(false);
  add_report_options(verb, command->planar.report, "Turn N times and report the median and minimum frame");
  add_exact_option(verb, command->planar.report, OperandKind::planar);
  add_solid_input_options(verb, command->planar.input, OperandKind::either, Hulls::of_results_too);
  verb.footer(
      "Examples: dymsum rotate rod.off box.off --steps 500 --axis 1,2,3 -o turn.html\n"
      "          dymsum rotate gear.off housing.off --events --range 0deg:30deg --axis 0,0,1\n"
      "          dymsum rotate star.wkt plate.wkt --steps 500 --threads 2");
  verb.callback([command, &action] {
    action = [command] {
      const InterruptGuard guard;
      return run_with_pages({command->parser, "sum", "solids"}, command->planar.operands, command->planar.input,
                            command->planar.files, [command] { return run(*command); });
    };
  });
}

}  // namespace dymsum::cli
