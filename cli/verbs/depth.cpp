// dymsum depth P Q
#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <span>
#include <sstream>
#include <utility>

#include "dymsum/convex_sum.h"
#include "dymsum/penetration_depth.h"
#include "exact_number.h"
#include "line_file.h"
#include "options.h"
#include "planar/tier.h"
#include "planar/uncertain_operands.h"
#include "progress_bar.h"
#include "solid/depth_report.h"
#include "solid/depth_track.h"
#include "solid/solid_operands.h"
#include "solid/solid_outputs.h"
#include "timing.h"
#include "verbs/commands.h"
#include "viewer/viewer_pages.h"

namespace dymsum::cli {
namespace {

struct DepthCommand {
  const CLI::App* parser = nullptr;
  std::vector<std::string> operands{"", ""};
  std::string moved, axis, along, at_file;
  AngleOptions angle;
  double time_limit = 0;
  std::size_t threads = 0;
  TrackOptions track;
  UncertainOptions uncertain;
  ReportOptions report;
  InputOptions input;
};

RationalPoint3 vector_of_option(const std::string& text, const std::string& option) {
  const std::optional<RationalPoint3> v = text.empty() ? RationalPoint3{} : exact_position_in_space(text);
  if (!v) throw Stop(kUsage, option + " wants 3 numbers or fractions x,y,z, not '" + text + "'");
  return *v;
}

std::vector<RationalPoint3> read_moves(const std::string& file) {
  std::vector<RationalPoint3> moves;
  const bool any = for_each_line(file_text(file), [&](const std::string& text, std::int64_t line) {
    const std::optional<RationalPoint3> v = exact_position_in_space(text);
    if (!v)
      refuse_line({ErrorCode::malformed, "a translation is x,y,z, each a number or a fraction 1/3", {}}, file, line);
    moves.push_back(*v);
  });
  if (!any) refuse_line({ErrorCode::malformed, "the file holds no translations", {}}, file, std::nullopt);
  return moves;
}

void print_depth(const DepthCommand& command, Json inputs, int tier, const Timing& timing, const Json& found,
                 const std::string& text) {
  if (command.report.json) {
    Json json = report_head("depth", std::move(inputs), tier, timing);
    json.update(found);
    print_report(json);
  } else {
    std::cout << text;
    print_times(std::cout, timing);
  }
}

/// Convex solids may turn.
ExitCode run_turned(const DepthCommand& command) {
  const RationalPoint3 given = vector_of_option(command.moved, "--move");
  const Point3 moved{given.x.to_double(), given.y.to_double(), given.z.to_double()};
  if (!is_of_doubles(given))
    throw Stop(kUsage, "--move with --axis wants three numbers, X,Y,Z, not '" + command.moved + "'" +
                           no_double_in(command.moved));
  SolidPose pose;
  pose.rotation = require_option(
      Rotation::about(parse_point(command.axis, "--axis"), read_angle(command.angle).radians()), "--axis");
  const std::vector<SolidInput> inputs = read_convex_solids(command.operands, command.input);
  const InterruptGuard guard;
  const Mesh &p = inputs[0].mesh, &q = inputs[1].mesh;
  const auto [depth, timing] =
      timed(command.report.repeat, [&] { return require(penetration_depth(p, q, pose, {}, moved)); });
  const Json found = depth_json(depth);
  std::ostringstream text;
  if (depth.inside)
    text << "depth " << depth.depth << ": moving " << inputs[1].file << " by that along (" << depth.direction.x << ", "
         << depth.direction.y << ", " << depth.direction.z << ") separates them\n  depth squared is exactly "
         << shown(depth.depth_squared) << "\n";
  else text << "the interiors do not meet\n";
  print_depth(command, solid_inputs_json(inputs), tier_of(p, q), timing, found, text.str());
  return depth.inside ? kDone : kNo;
}

std::string bounds_text(const SolidDistance& d) {
  const std::string what =
      d.meeting == Meeting::overlapping ? "they overlap, and the depth" : "they are apart, and the gap";
  return "the time was over: " + what + " is at least " + Json(d.at_least).dump() + "\n";
}

/// None of fractions.
int tier_of_solids(const std::vector<SolidInput>& inputs) {
  const bool fractions = inputs[0].fractions || inputs[1].fractions;
  return fractions ? 0 : tier_of(inputs[0].mesh, inputs[1].mesh);
}

SolidDepth depth_of(const std::vector<SolidInput>& inputs) {
  Result<SolidDepth> made = SolidDepth::create(inputs[0].operand(), inputs[1].operand());
  if (made) return *std::move(made);
  Error error = made.error();
  const bool convex = !convexity_error(inputs[0].mesh) && !convexity_error(inputs[1].mesh);
  if (error.code == ErrorCode::unsupported_operand && convex && !inputs[0].mesh.faces().empty())
    error.message += "; with --axis 0,0,1 --degrees 0 convex solids of any sizes are taken";
  stop_with(in_solid_operand(error, inputs));
}

ExitCode run_rows(const DepthCommand& command, const std::vector<SolidInput>& inputs) {
  const std::vector<RationalPoint3> moves = read_moves(command.at_file);
  const InterruptGuard guard;
  DepthBatchOptions options;
  options.threads = static_cast<int>(command.threads), options.time_limit = command.time_limit;
  std::optional<ProgressBar> bar(std::in_place);
  options.progress = bar->callback();
  const auto [rows, timing] = timed(command.report.repeat, [&] {
    return require(depth_batch(depth_of(inputs), std::span<const RationalPoint3>(moves), options));
  });
  bar.reset();
  Json list = Json::array();
  std::ostringstream text;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const RationalPoint3& at = moves[k];
    Json row = {{"at", {at.x.to_double(), at.y.to_double(), at.z.to_double()}}};
    if (!is_of_doubles(at)) row["exact"] = {at.x.to_string(), at.y.to_string(), at.z.to_string()};
    row.update(depth_json(rows[k]));
    list.push_back(std::move(row));
    print_exact(text << "(", at.x);
    print_exact(text << ", ", at.y);
    print_exact(text << ", ", at.z);
    text << "): ";
    text << (rows[k].complete ? depth_text(rows[k], inputs[0].file, inputs[1].file) : bounds_text(rows[k]));
  }
  print_depth(command, solid_inputs_json(inputs), tier_of_solids(inputs), timing, {{"rows", std::move(list)}},
              text.str());
  return kDone;
}

ExitCode run_solids(const DepthCommand& command) {
  refuse_options(*command.parser, kUncertainOptions, "is for regions");
  if (!command.axis.empty()) return run_turned(command);
  const RationalPoint3 moved = vector_of_option(command.moved, "--move"),
                       along = vector_of_option(command.along, "--along");
  if (!command.along.empty() && along == RationalPoint3{}) throw Stop(kUsage, "--along wants a direction, not 0,0,0");
  const std::vector<SolidInput> inputs = read_solids_and_results(command.operands, command.input);
  if (!command.at_file.empty()) return run_rows(command, inputs);
  const InterruptGuard guard;
  std::optional<Rational> exit;
  const auto [distance, timing] = timed(command.report.repeat, [&] {
    SolidDepth pair = depth_of(inputs);
    if (!command.along.empty()) exit = pair.along(moved, along);
    return pair.at(moved, command.time_limit);
  });
  Json found = depth_json(distance);
  std::string text = distance.complete ? depth_text(distance, inputs[0].file, inputs[1].file) : bounds_text(distance);
  if (exit) {
    found["along"] = exit->to_double(), found["along_exact"] = exit->to_string();
    text += "  free after " + Json(exit->to_double()).dump() + " times (" + command.along + ")\n";
  }
  print_depth(command, solid_inputs_json(inputs), tier_of_solids(inputs), timing, found, text);
  if (!distance.complete) return kUndecided;
  return distance.meeting == Meeting::overlapping ? kDone : kNo;
}

/// The pair that has a distance, in words.
std::string bound_text(const ClearanceBound& bound) {
  const PlanarDistance& d = bound.distance;
  if (d.meeting == Meeting::touching) return "they touch";
  return (d.meeting == Meeting::overlapping ? "depth " : "gap ") + Json(d.distance).dump();
}

Json bound_json(const ClearanceBound& bound) {
  Json json = {{"of", pair_json(bound.of)}};
  if (std::isinf(bound.distance.distance)) json["meeting"] = name(bound.distance.meeting), json["distance"] = "inf";
  else json.update(depth_json(bound.distance));
  return json;
}

ExitCode run_uncertain_depth(const DepthCommand& command, const RationalPoint& moved) {
  const UncertainOperands operands = read_uncertain(command.operands, command.uncertain, command.input);
  const InterruptGuard guard;
  const auto [found, timing] = timed(command.report.repeat, [&] {
    return std::pair(require_of(operands.inputs, clearance(operands.p, operands.q, moved)),
                     require_of(operands.inputs, collides(operands.p, operands.q, moved)));
  });
  const auto& [distance, overlap] = found;
  const std::string least = bound_text(distance.least), most = bound_text(distance.most);
  print_depth(command, inputs_json(operands.inputs), tier_of(operands.inputs[0].region, operands.inputs[1].region),
              timing,
              {{"uncertain", uncertain_json(command.uncertain, operands)},
               {"overlap", holds_json(overlap)},
               {"least", bound_json(distance.least)},
               {"most", bound_json(distance.most)}},
              "overlap " + holds_text(overlap, operands) + "\n  nearest: " + least + "\n  furthest: " + most + "\n");
  return exit_code_of(overlap);
}

ExitCode run_regions(const DepthCommand& command) {
  refuse_options(*command.parser, {"--axis", "--along", "--at-file", "--time", "--threads", "--hull", "--thin"},
                 "is for solids");
  const std::optional<RationalPoint> moved = command.moved.empty() ? RationalPoint{} : exact_position(command.moved);
  if (!moved) throw Stop(kUsage, "--move wants 2 numbers or fractions x,y, not '" + command.moved + "'");
  if (command.uncertain.given()) return run_uncertain_depth(command, *moved);
  const std::vector<Input> inputs = read_inputs(command.operands, command.input);
  const InterruptGuard guard;
  const Region &p = inputs[0].region, &q = inputs[1].region;
  const auto [distance, timing] =
      timed(command.report.repeat, [&] { return require_of(inputs, PlanarDepth::create(p, q)).at(*moved); });
  print_depth(command, inputs_json(inputs), tier_of(p, q), timing, depth_json(distance),
              depth_text(distance, inputs[0].file, inputs[1].file));
  return distance.meeting == Meeting::overlapping ? kDone : kNo;
}

ExitCode run(const DepthCommand& command) {
  if (command.axis.empty() == command.angle.given()) throw Stop(kUsage, "--axis and --angle or --degrees go together");
  if (!command.track.motion.empty()) {
    require_solid("depth --track", command.operands, command.input);
    refuse_options(*command.parser, kUncertainOptions, "is for regions");
    return run_track(command.operands, command.track, command.report, command.input);
  }
  if (!command.track.files.empty())
    throw Stop(kUsage, "-o without --track writes .html, the viewer, not " + command.track.files.front());
  return are_solid(command.operands, command.input) ? run_solids(command) : run_regions(command);
}

}  // namespace

void add_depth(CLI::App& app, Action& action) {
  auto command = std::make_shared<DepthCommand>();
  CLI::App& verb = *app.add_subcommand(
      "depth",
      "The penetration depth of two solids or regions of any shape, exactly: the shortest translations of Q that "
      "separate them; how far apart they are where they do not overlap");
  command->parser = &verb;
  add_operands(verb, {"P", "A solid or a region"}, {"Q", "Another one, which may move"}, command->operands);
  CLI::Option* move =
      verb.add_option("--move", command->moved, "Move Q by this translation first, numbers or fractions 1/3");
  move->type_name("X,Y[,Z]");
  CLI::Option* along = verb.add_option("--along", command->along,
                                       "Of solids: also how far Q has to go in this direction, in multiples of it");
  along->type_name("X,Y,Z");
  CLI::Option* at_file =
      verb.add_option("--at-file", command->at_file,
                      "Of solids: many translations x,y,z of Q, one a line; # begins a comment; - for standard input");
  at_file->type_name("FILE")->excludes(move)->excludes(along);
  CLI::Option* time = within(
      verb.add_option("--time", command->time_limit, "Of solids: give up after so many seconds, for every translation"),
      0);
  time->type_name("SECONDS");
  whole_within(verb.add_option("--threads", command->threads, "Of solids: threads for --at-file, 0: all cores"), 0,
               1024)
      ->type_name("N")
      ->needs(at_file);
  CLI::Option* axis =
      verb.add_option("--axis", command->axis, "Turn P about this axis through the origin first; convex solids");
  axis->type_name("X,Y,Z")->excludes(along)->excludes(at_file)->excludes(time);
  CLI::Option* track = verb.add_option(
      "--track", command->track.motion,
      "Of solids: exact and continuous depth along a motion of Q, a pose a line, x,y,z or x,y,z and a quaternion "
      "w,x,y,z; # begins a comment; - for standard input");
  track->type_name("FILE");
  for (CLI::Option* other : {move, along, at_file, time, axis}) track->excludes(other);
  within(verb.add_option("--smoothing", command->track.smoothing,
                         "With --track: average normals over this distance; 0 gives the exact depth alone"),
         0)
      ->type_name("LENGTH")
      ->needs(track);
  within(verb.add_option("--inflation", command->track.inflation,
                         "With --track: jump where the continuous depth would be more than N times the exact one"),
         1)
      ->type_name("N")
      ->needs(track)
      ->capture_default_str();
  verb.add_option(
          "-o", command->track.files,
          "Write .html (the viewer); with --track instead the rows: .csv, .json or .svg (a plot, jumps marked), - is "
          "standard output, as .csv; repeatable")
      ->type_name("FILE")
      ->allow_extra_args(false);
  add_angle_options(verb, command->angle, "by this angle,");
  add_report_options(verb, command->report, "Compute N times and report the median and minimum time");
  add_solid_input_options(verb, command->input);
  add_thin_option(verb, command->input);
  add_uncertain_options(verb, command->uncertain, "P", "Q");
  verb.footer(
      "Exit code 4 when their interiors do not meet, 5 when the time was over.\nExample: dymsum depth cup.off "
      "spoon.off --move 0.5,0,0 --json\n         dymsum depth cup.off spoon.off --track motion.csv -o trace.svg");
  verb.callback([command, &action] {
    action = [command]() -> ExitCode {
      if (!command->track.motion.empty()) return run(*command);
      refuse_pages(command->uncertain, command->track.files);
      return run_with_pages({command->parser, "sum", "solids"}, command->operands, command->input, command->track.files,
                            [command] { return run(*command); });
    };
  });
}

}  // namespace dymsum::cli
