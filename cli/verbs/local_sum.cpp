// dymsum local-sum P Q --box ... | --ball ...
#include "dymsum/local_sum.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>

#include "dymsum/solid_sum_io.h"
#include "memory_limit.h"
#include "options.h"
#include "outputs.h"
#include "planar/planar_local.h"
#include "progress_bar.h"
#include "solid/solid_operands.h"
#include "solid/solid_outputs.h"
#include "timing.h"
#include "verbs/commands.h"
#include "viewer/viewer_pages.h"

namespace dymsum::cli {
namespace {

struct LocalCommand {
  const CLI::App* parser = nullptr;
  std::vector<std::string> operands{"", ""}, files;
  std::string box, ball, disc, axis, to = "json", engine = "updated";
  AngleOptions angle;
  double memory_mb = 0;  ///< 0: no limit
  ReportOptions report;
  InputOptions input;
};

/// A box, or a ball with its box.
struct Position {
  ClipBox box;
  std::optional<ClipBall> ball;
};

Position read_position(const LocalCommand& command) {
  Position position;
  if (command.ball.empty()) {
    const std::vector<double> v = numbers_of(command.box, 6, "--box wants two corners X,Y,Z,X,Y,Z");
    position.box = {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
    if (!(v[0] < v[3] && v[1] < v[4] && v[2] < v[5]))
      throw Stop(kUsage, "--box wants the lower corner first, and an extent along every axis");
    return position;
  }
  const std::vector<double> v = numbers_of(command.ball, 4, "--ball wants a place and a radius X,Y,Z,R");
  if (!(v[3] > 0)) throw Stop(kUsage, "--ball wants a positive radius");
  position.ball = ClipBall{{v[0], v[1], v[2]}, v[3]};
  position.box = bounding_box(*position.ball);
  return position;
}

Json summary_of(const LocalPart& part) {
  const SpatialSum& sum = part.boundary;
  const ClipBox& b = part.box;
  return {{"where", name(part.where)},
          {"box", {b.low.x, b.low.y, b.low.z, b.high.x, b.high.y, b.high.z}},
          {"pieces", sum.shells},
          {"vertices", sum.vertices.size()},
          {"faces", sum.faces.size()},
          {"tight",
           {{"points", sum.tight_points.size()},
            {"segments", sum.tight_segments.size()},
            {"faces", sum.tight_faces.size()}}},
          {"near_facets", part.work.facets},
          {"contacts", part.work.contacts}};
}

std::string text_of(const LocalPart& part) {
  const SpatialSum& sum = part.boundary;
  std::ostringstream out;
  if (part.where == LocalPart::Where::crossed)
    out << "  " << counted(sum.faces.size(), "face") << " in " << counted(sum.shells, "piece") << ", "
        << counted(sum.vertices.size(), "vertex", "vertices") << "; tight: " << counted(sum.tight_faces.size(), "face")
        << ", " << counted(sum.tight_segments.size(), "segment") << ", " << counted(sum.tight_points.size(), "point")
        << "\n";
  else out << "  nothing bounds the sum there: it lies " << name(part.where) << "\n";
  return out.str();
}

/// The summary, and then the lists of an exact result.
std::string exact_part(const LocalPart& part) {
  Json json = summary_of(part);
  const Json exact = Json::parse(solid_sum_to_json(part.boundary));
  for (const char* list : {"vertex_list", "edge_list", "face_list", "tight_list"}) json[list] = exact[list];
  return json.dump(1) + "\n";
}

std::string output_of(const LocalCommand& command, const LocalPart& part, const std::string& file) {
  const SolidOutput how{command.to, false, false};
  if (!format_name(file, command.to).ends_with(".json")) return solid_output(part.boundary, file, how);
  return exact_part(part);
}

SolidPose pose_of(const LocalCommand& command) {
  SolidPose pose;
  if (command.axis.empty() == command.angle.given()) throw Stop(kUsage, "--axis and --angle or --degrees go together");
  if (!command.axis.empty())
    pose.rotation = require_option(
        Rotation::about(parse_point(command.axis, "--axis"), read_angle(command.angle).radians()), "--axis");
  return pose;
}

ExitCode run_regions(const LocalCommand& command) {
  refuse_options(*command.parser, {"--ball", "--axis", "--hull"}, "is for solid operands");
  PlanarLocal local;
  local.operands = command.operands, local.files = command.files;
  local.box = command.box, local.disc = command.disc, local.to = command.to;
  local.memory_mb = command.memory_mb;
  local.engine = named<LocalEngine>(command.engine), local.engine_name = command.engine;
  local.angle = command.angle, local.report = command.report, local.input = command.input;
  if (!writes_to_stdout(command.files)) refuse_options(*command.parser, {"--to"}, "is the format of -o -");
  return run_planar_local(local);
}

ExitCode run_solid_parts(const LocalCommand& command) {
  refuse_options(*command.parser, {"--disc"}, "is for planar operands");
  const Position position = read_position(command);
  const SolidPose pose = pose_of(command);
  if (!writes_to_stdout(command.files)) refuse_options(*command.parser, {"--to"}, "is the format of -o -");
  for (const std::string& file : command.files)
    if (const std::string name = format_name(file, command.to); !name.ends_with(".json") && !name.ends_with(".glb"))
      throw Stop(kUsage, "-o writes a part of a sum as .json, .glb or .html: " + file);
  std::ostream& out = report_stream(command.files, command.report.json);
  const std::vector<SolidInput> inputs = read_solids(command.operands, command.input);
  LocalOptions options;
  options.engine = named<LocalEngine>(command.engine);
  options.threads = 0;
  const InterruptGuard guard;
  std::optional<ProgressBar> bar(std::in_place);
  options.progress = bar->callback();
  const auto [part, timing] = timed(command.report.repeat, [&] {
    Result<LocalSum> sum = LocalSum::create(inputs[0].mesh, inputs[1].mesh, options);
    throw_if_interrupted();
    LocalSum made = require(std::move(sum));
    Result<LocalPart> found = position.ball ? made.in(*position.ball, pose) : made.in(position.box, pose);
    throw_if_interrupted();
    return require(std::move(found));
  });
  bar.reset();
  std::vector<std::string> texts;
  for (const std::string& file : command.files) texts.push_back(output_of(command, part, file));
  for (std::size_t i = 0; i < texts.size(); ++i) write_text(command.files[i], texts[i]);
  if (command.report.json) {
    Json stages = Json::object();
    for (const SpatialStats::Stage& stage : part.boundary.stats.stages) stages[std::string(stage.name)] = stage.ms;
    Json json = report_head("local-sum", solid_inputs_json(inputs), solid_tier(part.boundary.stats.bits), timing,
                            std::move(stages));
    json["engine"] = command.engine;
    json.update(summary_of(part));
    print_report(json);
  } else {
    out << "local-sum of " << inputs[0].file << " and " << inputs[1].file << "\n" << text_of(part);
    print_times(out, timing);
  }
  return kDone;
}

ExitCode run(const LocalCommand& command) {
  limit_memory(command.memory_mb);
  return are_solid(command.operands, command.input) ? run_solid_parts(command) : run_regions(command);
}

}  // namespace

void add_local_sum(CLI::App& app, Action& action) {
  auto command = std::make_shared<LocalCommand>();
  CLI::App& verb = *app.add_subcommand(
      "local-sum",
      "The part of the sum of two regions or solids that lies in a box or meets a disc or ball, exactly, without the "
      "rest");
  command->parser = &verb;
  add_operands(verb, {"P", "A region or a solid"}, {"Q", "Another one"}, command->operands);
  CLI::Option* box = verb.add_option("--box", command->box,
                                     "The closed box between two corners, the lower one first: X,Y,Z,X,Y,Z or X,Y,X,Y");
  CLI::Option* ball =
      verb.add_option("--ball", command->ball, "The faces that meet this closed ball, cut to its bounding box");
  CLI::Option* disc =
      verb.add_option("--disc", command->disc, "The edges that meet this closed disc, cut to its bounding box");
  box->type_name("CORNERS"), ball->type_name("X,Y,Z,R")->excludes(box);
  disc->type_name("X,Y,R")->excludes(box)->excludes(ball);
  verb.add_option("--axis", command->axis, "Turn a solid P about this axis through the origin first")
      ->type_name("X,Y,Z");
  add_angle_options(verb, command->angle, "Turn P first; with --axis, a solid, by this angle,");
  verb.add_option("-o", command->files,
                  "Write the part; repeatable; .json (exact, with provenance), a picture: .svg of regions, .glb of "
                  "solids, or .html (the viewer); - is standard output")
      ->type_name("FILE")
      ->allow_extra_args(false);
  verb.add_option("--to", command->to, "Format of -o -")
      ->check(CLI::IsMember({"json", "svg", "glb"}))
      ->capture_default_str();
  one_of<LocalEngine>(
      verb.add_option("--engine", command->engine, "How the facets near the place are found; all give the same part"))
      ->capture_default_str();
  add_memory_limit(verb, command->memory_mb);
  add_report_options(verb, command->report, "Compute N times and report the median and minimum time");
  add_solid_input_options(verb, command->input);
  verb.footer(
      "Example: dymsum local-sum cup.off spoon.off --ball 2,0,1,0.5 -o near.glb\n"
      "         dymsum local-sum gear.wkt star.wkt --disc 0,3,1 -o near.svg");
  verb.callback([command, &action] {
    if (command->box.empty() && command->ball.empty() && command->disc.empty())
      throw Stop(kUsage, "local-sum wants --box, or --ball of solids, or --disc of regions");
    action = [command] {
      return run_with_pages({command->parser, "sum", "solids"}, command->operands, command->input, command->files,
                            [command] { return run(*command); });
    };
  });
}

}  // namespace dymsum::cli
