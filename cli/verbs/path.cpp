// dymsum path ROBOT OBSTACLE --from x,y,theta --to x,y,theta, or --check-path FILE
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>

#include "dymsum/grown_region.h"
#include "dymsum/planner.h"
#include "exact_number.h"
#include "exit_code.h"
#include "inputs.h"
#include "memory_limit.h"
#include "options.h"
#include "outputs.h"
#include "pictures/path_picture.h"
#include "planar/configuration.h"
#include "planar/contact.h"
#include "planar/obstacle_input.h"
#include "planar/tier.h"
#include "progress_bar.h"
#include "record_json.h"
#include "report.h"
#include "solid/solid_limits.h"
#include "timing.h"
#include "verbs/check_path.h"
#include "verbs/commands.h"
#include "viewer/viewer_pages.h"

namespace dymsum::cli {
namespace {

struct PathCommand {
  const CLI::App* parser = nullptr;  ///< which options were given
  std::vector<std::string> to, files;
  std::string from, given;
  bool strict = false;
  double margin = 0;
  double time_limit = PlanOptions{}.time_limit_seconds;
  double memory_mb = 0;  ///< 0: no limit
  ReportOptions report;
  ObstacleInput source;
};

Json waypoint_json(const Waypoint& w) {
  return {{"x", w.approx.x},
          {"y", w.approx.y},
          {"theta", w.approx.theta},
          {"tan_half", w.theta.is_half_turn() ? "inf" : w.theta.tan_half().to_string()},
          {"exact", {w.at.x.to_string(), w.at.y.to_string()}},
          {"move", name(w.move)}};
}

Json component_json(const FreeComponent& c) {
  return {{"component", c.index},
          {"unbounded", c.unbounded},
          {"shells", c.shells},
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
  Json start = Json::array(), goal = Json::array();
  for (const FreeComponent& c : reason.start) start.push_back(component_json(c));
  for (const FreeComponent& c : reason.goal) goal.push_back(component_json(c));
  return {{"kind", name(reason.kind)},
          {"text", reason.text},
          {"contact", contact_json(reason.contact)},
          {"start", start},
          {"goal", goal},
          {"unexamined_angles", reason.unexamined_angles},
          {"limit", reason.limit ? limit_json(*reason.limit) : Json(nullptr)}};
}

// What is kept, and from which distance on a path may have been missed.
Json margin_json(const GrownRegion& robot) { return {{"kept", robot.margin}, {"at_most", robot.at_most}}; }

Json plan_json(const Plan& plan) {
  Json waypoints = Json::array();
  for (const Waypoint& w : plan.path) waypoints.push_back(waypoint_json(w));
  return {{"found", plan.found()},
          {"waypoints", waypoints},
          {"reason", plan.found() ? Json(nullptr) : reason_json(*plan.reason)},
          {"work", json_without(plan.work, {"ms"})}};
}

// Adds the plan of one goal, or a list of those of several.
void add_plans(Json& json, const std::vector<Plan>& plans, const std::vector<PlacedRobot>& goals) {
  if (plans.size() == 1) {
    json.update(plan_json(plans[0]));
    return;
  }
  Json list = Json::array();
  for (std::size_t k = 0; k < plans.size(); ++k) {
    const PlacedRobot& to = goals[k];
    Json one = {{"to", {to.at.x.to_double(), to.at.y.to_double(), to.theta}}};
    if (!is_of_doubles(to.at)) one["to_exact"] = {to.at.x.to_string(), to.at.y.to_string()};
    one.update(plan_json(plans[k]));
    list.push_back(std::move(one));
  }
  json["found"] = std::all_of(plans.begin(), plans.end(), [](const Plan& p) { return p.found(); });
  json["paths"] = std::move(list);
}

// 4 where one has no path, else 5 where one is not decided.
ExitCode code_of(const std::vector<Plan>& plans) {
  ExitCode code = kDone;
  for (const Plan& p : plans) {
    if (p.found()) continue;
    if (p.reason->kind != NoPath::Kind::undecided) return kNo;
    code = kUndecided;
  }
  return code;
}

void print_margin(const GrownRegion& robot, bool kept) {
  if (robot.margin == 0) return;
  if (kept) std::cout << "keeps a distance of " << robot.margin << " from the obstacle everywhere\n";
  else
    std::cout << "this is said of the robot with a margin of " << robot.margin << " around it, at its corners "
              << robot.at_most << "\n";
}

void print_text(const Plan& plan, const GrownRegion& robot) {
  if (!plan.found()) std::cout << plan.reason->text << "\n";
  for (const Waypoint& w : plan.path)
    std::cout << name(w.move) << " (" << w.approx.x << ", " << w.approx.y << "), theta = " << w.approx.theta << "\n";
  print_margin(robot, plan.found());
}

ExitCode run_check(const PathCommand& command, const std::vector<Input>& inputs, const GrownRegion& robot) {
  const GivenPath path = read_path_file(command.given);
  const Touching touching = command.strict ? Touching::forbidden : Touching::allowed;
  const InterruptGuard guard;
  const auto [check, timing] =
      timed(command.report.repeat, [&] { return checked(robot.region, inputs, path, touching, command.given); });
  Json json = report_head("path", inputs_json(inputs), tier_of(inputs[0].region, inputs[1].region), timing);
  json.update({{"checked", check_json(check, path)}, {"margin", margin_json(robot)}});
  if (command.report.json) print_report(json);
  else std::cout << check_text(check) << "\n";
  if (!command.report.json) {
    print_margin(robot, check.outcome == MotionCheck::Outcome::free);
    print_times(std::cout, timing);
  }
  if (check.outcome == MotionCheck::Outcome::free) return kDone;
  return check.outcome == MotionCheck::Outcome::blocked ? kNo : kUndecided;
}

ExactConfiguration configuration_of(const PlacedRobot& robot) {
  return {robot.at, require(Orientation::nearest(robot.theta))};
}

/// Plans past one obstacle: directly where that does, else in the obstacle of all angles, made when it is first needed.
class Planning {
 public:
  Planning(ObstacleSource& source, const Region& robot, const PlanOptions& options)
      : source_(source), robot_(robot), options_(options) {
    if (source.read) obstacle_ = std::move(*source.read);
  }

  /// The time limit holds for making the obstacle and the search together.
  Plan plan_to(const ExactConfiguration& from, const ExactConfiguration& to) {
    const Clock::time_point began = Clock::now();
    const auto direct = obstacle_ ? Result<std::optional<Plan>>(std::optional<Plan>())
                                  : direct_plan(robot_, source_.inputs[1].region, from, to, options_);
    if (std::optional<Plan> plan = require_of(source_.inputs, direct)) return *std::move(plan);
    if (!obstacle_ && !make(began)) return out_of_time();
    PlanOptions rest = options_;
    rest.time_limit_seconds = std::max(0.0, options_.time_limit_seconds - seconds_since(began));
    return require(plan(*obstacle_, from, to, rest));
  }
  double obstacle_ms() const { return obstacle_ ? obstacle_->work().ms : 0; }

 private:
  using Clock = std::chrono::steady_clock;
  static double seconds_since(Clock::time_point t) { return std::chrono::duration<double>(Clock::now() - t).count(); }

  bool make(Clock::time_point began) {
    bool late = false;
    ObstacleOptions options;
    options.memory = options_.memory;
    options.progress = [&](std::string_view stage, double fraction) {
      late = late || seconds_since(began) > options_.time_limit_seconds;
      return !late && (!options_.progress || options_.progress(stage, fraction));
    };
    Result<CspaceObstacle> made = CspaceObstacle::create(robot_, source_.inputs[1].region, options);
    if (late) return false;
    obstacle_ = require_of(source_.inputs, std::move(made));
    return true;
  }
  Plan out_of_time() const {
    Plan plan;
    NoPath& reason = plan.reason.emplace();
    reason.kind = NoPath::Kind::undecided;
    reason.limit = SearchLimit{true, options_.time_limit_seconds, std::nullopt};
    std::ostringstream text;
    text << "undecided: the time limit of " << options_.time_limit_seconds
         << " s was reached while the obstacle of all angles was made";
    reason.text = text.str();
    return plan;
  }

  ObstacleSource& source_;
  const Region& robot_;
  const PlanOptions& options_;
  std::optional<CspaceObstacle> obstacle_;
};

ExitCode run_plan(const PathCommand& command, ObstacleSource source, const GrownRegion& robot) {
  const ExactConfiguration from = configuration_of(read_placed_robot(command.from, "--from"));
  std::vector<PlacedRobot> goals;
  for (const std::string& text : command.to) goals.push_back(read_placed_robot(text, "--to"));
  const InterruptGuard guard;
  std::optional<ProgressBar> bar(std::in_place);
  PlanOptions options;
  options.progress = bar->callback();
  options.time_limit_seconds = command.time_limit;
  options.memory = memory_bytes(command.memory_mb);
  options.touching = command.strict ? Touching::forbidden : Touching::allowed;
  Planning planning(source, robot.region, options);
  std::vector<double> ms;  // without the obstacle
  const auto [plans, whole] = timed(command.report.repeat, [&] {
    std::vector<Plan> all;
    ms.push_back(0);
    for (const PlacedRobot& to : goals) {
      all.push_back(planning.plan_to(from, configuration_of(to)));
      ms.back() += all.back().work.ms;
    }
    return all;
  });
  const Timing timing = timing_of(std::move(ms));
  bar.reset();
  Json json = report_head("path", inputs_json(source.inputs),
                          require(cspace_slice(robot.region, source.inputs[1].region, {})).stats.tier_bits, timing,
                          {{"obstacle", planning.obstacle_ms()}, {"path", timing.median_ms}});
  json["margin"] = margin_json(robot);
  add_plans(json, plans, goals);
  std::vector<std::string> texts;
  for (const std::string& file : command.files)
    texts.push_back(file.ends_with(".json")
                        ? report_text(json)
                        : path_picture(source.inputs[0].region, source.inputs[1].region, plans[0].path));
  for (std::size_t i = 0; i < texts.size(); ++i) write_text(command.files[i], texts[i]);
  if (command.report.json) print_report(json);
  for (std::size_t k = 0; k < plans.size() && !command.report.json; ++k) {
    if (plans.size() > 1) std::cout << "to " << command.to[k] << ":\n";
    print_text(plans[k], robot);
  }
  if (!command.report.json) print_times(std::cout, timing);
  return code_of(plans);
}

void check_options(const PathCommand& command) {
  for (const std::string& file : command.files) {
    if (!file.ends_with(".json") && !file.ends_with(".svg") && !is_page(file))
      throw Stop(kUsage, "-o wants a .json, a .svg or a .html file, not " + file);
    if (!file.ends_with(".json") && command.to.size() > 1)
      throw Stop(kUsage, "a .svg or .html file shows one path: give one --to");
  }
  const bool ends = !command.from.empty() || !command.to.empty();
  if (!command.given.empty() && ends) throw Stop(kUsage, "--from and --to do not apply to --check-path");
  if (region_format("." + command.from))
    throw Stop(kUsage,
               "--from is where the robot starts, x,y,theta: what standard input is written in is told by its "
               "first characters");
  if (command.given.empty() && (command.from.empty() || command.to.empty()))
    throw Stop(kUsage, "path wants --from x,y,theta and --to x,y,theta, or --check-path FILE: " +
                           std::string(command.from.empty() ? "--from" : "--to") + " is missing");
  if (!command.given.empty()) refuse_options(*command.parser, {"-o", "--time-limit"}, "does not apply to --check-path");
  check_obstacle_input("path", command.source);
  if (command.margin > 0 && !command.source.file.empty())
    throw Stop(kUsage, "--margin wants ROBOT and OBSTACLE: the obstacle of a file is that of the robot as it is");
}

/// Robot and obstacle as a page takes them. Those of a file of an obstacle are regions that nothing else holds, and a
/// robot with a margin is handed over as it is planned for: the page then finds the same path.
std::vector<ViewerInput> shown_inputs(const PathCommand& command, const ObstacleSource& source, const Region& robot) {
  const auto made = [](const std::string& name, const Region& region) {
    return ViewerInput{name + ".wkt", format_region(region, RegionFormat::wkt)};
  };
  if (!command.source.file.empty()) {
    const std::string name = shape_name(command.source.file);
    return {made(name + " robot", robot), made(name + " obstacle", source.inputs[1].region)};
  }
  std::vector<ViewerInput> inputs;
  for (const std::string& operand : command.source.operands)
    inputs.push_back(viewer_input(operand, command.source.input));
  if (command.margin > 0) inputs[0] = made(shape_name(command.source.operands[0]) + " with margin", robot);
  return inputs;
}

ExitCode run_path(PathCommand& command) {
  check_options(command);
  limit_memory(command.memory_mb);
  ObstacleSource source = read_source(command.source);
  const GrownRegion robot = require_of({source.inputs[0]}, grown(source.inputs[0].region, command.margin));
  return run_with_pages(
      *command.parser, "obstacle", [&] { return shown_inputs(command, source, robot.region); }, command.files,
      [&] {
        return command.given.empty() ? run_plan(command, std::move(source), robot)
                                     : run_check(command, source.inputs, robot);
      });
}

}  // namespace

void add_path(CLI::App& app, Action& action) {
  auto command = std::make_shared<PathCommand>();
  CLI::App& verb = *app.add_subcommand(
      "path",
      "A motion of a robot that translates and turns past an obstacle, or the proof that there is none: "
      "ends with 4 then, and with 5 if it is not decided within the time limit; or a path that is given, checked");
  command->parser = &verb;
  add_obstacle_input(verb, command->source);
  verb.add_option("--from", command->from,
                  "Where the robot starts: numbers or fractions 1/3, theta in radians or as 90deg")
      ->type_name("x,y,theta");
  verb.add_option("--to", command->to, "Where it is to go; repeatable: several goals of one obstacle")
      ->type_name("x,y,theta")
      ->allow_extra_args(false);
  verb.add_option("--check-path", command->given,
                  "Check a path instead: lines x,y,theta, [[x,y,theta],...] or the .json that path writes; says the "
                  "first piece that is "
                  "blocked; - for standard input")
      ->type_name("FILE");
  const char* const margin =
      "Keep this distance from the obstacle in every point: the robot grows by a polygon around that disc, 2 % wider "
      "at "
      "its corners";
  within(verb.add_option("--margin", command->margin, margin), 0)->type_name("DISTANCE");
  verb.add_flag("--strict", command->strict, "Touching the obstacle is forbidden");
  const char* const limit = "Seconds after which it stops without a decision, 60 unless told";
  within(verb.add_option("--time-limit", command->time_limit, limit), 0)->type_name("SECONDS");
  add_memory_limit(verb, command->memory_mb);
  verb.add_option("-o", command->files, "Write the path as .json, as a picture .svg, or .html (the viewer); repeatable")
      ->type_name("FILE")
      ->allow_extra_args(false);
  add_report_options(verb, command->report, "Compute N times and report the median and minimum time");
  add_repair_option(verb, command->source.input, OperandKind::planar);
  verb.footer("Example: dymsum path bar.wkt rooms.wkt --from -6,0,1.5708 --to 6,0,0 -o path.svg");
  verb.callback([command, &action] { action = [command] { return run_path(*command); }; });
}

}  // namespace dymsum::cli
