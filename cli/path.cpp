// dymsum path ROBOT OBSTACLE --from x,y,theta --to x,y,theta
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <optional>

#include "commands.h"
#include "configuration.h"
#include "dymsum/planner.h"
#include "exit_code.h"
#include "inputs.h"
#include "options.h"
#include "outputs.h"
#include "path_picture.h"
#include "progress_bar.h"
#include "report.h"
#include "solid_operands.h"
#include "timing.h"

namespace dymsum::cli {
namespace {

struct PathCommand {
  std::vector<std::string> operands{"", ""}, files;
  std::string from, to;
  bool strict = false;
  double time_limit = PlanOptions{}.time_limit_seconds;
  ReportOptions report;
  InputOptions input;
};

struct PlannedPath {
  Plan plan;
  int tier_bits = 0;
};

const char* name_of(Waypoint::Move move) {
  switch (move) {
    case Waypoint::Move::start: return "start";
    case Waypoint::Move::translation: return "translation";
    case Waypoint::Move::counter_clockwise: return "counter_clockwise";
    case Waypoint::Move::clockwise: return "clockwise";
  }
  return "";
}

const char* name_of(NoPath::Kind kind) {
  switch (kind) {
    case NoPath::Kind::start_not_free: return "start_not_free";
    case NoPath::Kind::goal_not_free: return "goal_not_free";
    case NoPath::Kind::separated: return "separated";
    case NoPath::Kind::undecided: return "undecided";
  }
  return "";
}

Json waypoint_json(const Waypoint& w) {
  return {{"x", w.approx.x}, {"y", w.approx.y}, {"theta", w.approx.theta},
          {"tan_half", w.theta.is_half_turn() ? "inf" : w.theta.tan_half().to_string()},
          {"exact", {w.at.x.to_string(), w.at.y.to_string()}}, {"move", name_of(w.move)}};
}

Json component_json(const FreeComponent& c) {
  return {{"component", c.number}, {"unbounded", c.unbounded}, {"shells", c.shells},
          {"angles", c.all_angles ? Json("all") : Json{c.from, c.to}}};
}

Json limit_json(const SearchLimit& limit) {
  Json passage = nullptr;
  if (const auto& p = limit.passage)
    passage = {{"angles", {p->from, p->to}},
               {"reached", {p->reached.x, p->reached.y}},
               {"beyond", {p->beyond.x, p->beyond.y}}};
  return {{"out_of_time", limit.out_of_time}, {"seconds", limit.seconds}, {"passage", passage}};
}

Json reason_json(const NoPath& reason) {
  Json start = Json::array(), goal = Json::array(), contact = nullptr;
  for (const FreeComponent& c : reason.start) start.push_back(component_json(c));
  for (const FreeComponent& c : reason.goal) goal.push_back(component_json(c));
  if (reason.contact) {
    const bool fixed = reason.contact->kind == Contact::Kind::edge_of_p;
    contact = {{"kind", fixed ? "vertex_on_edge" : "edge_on_vertex"},
               {"obstacle", reason.contact->p},
               {"robot", reason.contact->q}};
  }
  return {{"kind", name_of(reason.kind)}, {"text", reason.text}, {"contact", contact}, {"start", start}, {"goal", goal},
          {"unexamined_angles", reason.unexamined_angles},
          {"limit", reason.limit ? limit_json(*reason.limit) : Json(nullptr)}};
}

Json path_json(const PlannedPath& planned, const Timing& timing, const std::vector<Input>& inputs) {
  Json waypoints = Json::array();
  for (const Waypoint& w : planned.plan.path) waypoints.push_back(waypoint_json(w));
  const PlanWork& work = planned.plan.work;
  Json json = report_head("path", inputs_json(inputs), planned.tier_bits, timing);
  json.update({{"found", planned.plan.found()},
               {"waypoints", waypoints},
               {"reason", planned.plan.found() ? Json(nullptr) : reason_json(*planned.plan.reason)},
               {"work",
                {{"levels", work.levels},
                 {"slices", work.slices},
                 {"rotations", work.rotations},
                 {"refinements", work.refinements}}}});
  return json;
}

void print_text(const Plan& plan) {
  if (!plan.found()) {
    std::cout << plan.reason->text << "\n";
    return;
  }
  for (const Waypoint& w : plan.path)
    std::cout << name_of(w.move) << " (" << w.approx.x << ", " << w.approx.y << "), theta = " << w.approx.theta << "\n";
}

ExitCode run_path(const PathCommand& command) {
  const Configuration from = read_configuration(command.from, "--from"), to = read_configuration(command.to, "--to");
  for (const std::string& file : command.files)
    if (!file.ends_with(".json") && !file.ends_with(".svg"))
      throw Stop(kUsage, "-o wants a .json or a .svg file, not " + file);
  require_planar("path", command.operands);
  const std::vector<Input> inputs = read_inputs(command.operands, command.input);
  const InterruptGuard guard;
  std::optional<ProgressBar> bar(std::in_place);
  ObstacleOptions obstacle_options;
  obstacle_options.progress = bar->callback();
  PlanOptions options;
  options.progress = bar->callback();
  options.time_limit_seconds = command.time_limit;
  options.touching = command.strict ? Touching::forbidden : Touching::allowed;
  const auto compute = [&] {
    const CspaceObstacle obstacle =
        require(CspaceObstacle::create(inputs[0].region, inputs[1].region, obstacle_options));
    return PlannedPath{require(plan(obstacle, from, to, options)), require(obstacle.slice({})).stats.tier_bits};
  };
  const auto [planned, timing] = timed(command.report.repeat, compute);
  bar.reset();
  const Json json = path_json(planned, timing, inputs);
  for (const std::string& file : command.files)
    write_text(file, file.ends_with(".json") ? report_text(json)
                                             : path_picture(inputs[0].region, inputs[1].region, planned.plan.path));
  if (command.report.json) print_report(json);
  else print_text(planned.plan);
  if (planned.plan.found()) return kDone;
  return planned.plan.reason->kind == NoPath::Kind::undecided ? kUndecided : kNo;
}

}  // namespace

void add_path(CLI::App& app, Action& action) {
  auto command = std::make_shared<PathCommand>();
  CLI::App& verb = *app.add_subcommand("path",
      "A motion of a robot that translates and turns past an obstacle, or the proof that there is none: "
      "ends with 4 then, and with 5 if it is not decided within the time limit");
  add_operands(verb, kRobot, kObstacle, command->operands);
  verb.add_option("--from", command->from,
      "Where the robot starts, theta in radians or as 90deg")->type_name("x,y,theta")->required();
  verb.add_option("--to", command->to, "Where it is to go")->type_name("x,y,theta")->required();
  verb.add_flag("--strict", command->strict, "Touching the obstacle is forbidden");
  verb.add_option("--time-limit", command->time_limit,
      "Seconds after which the search stops without a decision, 60 unless told")
      ->type_name("SECONDS")->check(CLI::NonNegativeNumber);
  verb.add_option("-o", command->files,
      "Write the path as .json, or as a picture .svg; repeatable")->type_name("FILE")->allow_extra_args(false);
  add_report_options(verb, command->report, "Compute N times and report the median and minimum time");
  add_repair_option(verb, command->input);
  verb.footer("Example: dymsum path bar.wkt rooms.wkt --from -6,0,1.5708 --to 6,0,0 -o path.svg");
  verb.callback([command, &action] { action = [command] { return run_path(*command); }; });
}

}  // namespace dymsum::cli
