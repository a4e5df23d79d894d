// dymsum angles ROBOT OBSTACLE --at x,y
#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <memory>
#include <numbers>
#include <optional>

#include "dymsum/obstacle_queries.h"
#include "exact_number.h"
#include "exit_code.h"
#include "options.h"
#include "planar/contact.h"
#include "planar/obstacle_input.h"
#include "planar/query_file.h"
#include "planar/whole_places.h"
#include "progress_bar.h"
#include "report.h"
#include "timing.h"
#include "verbs/commands.h"

namespace dymsum::cli {
namespace {

struct AnglesCommand {
  std::vector<std::string> at;
  std::string at_file;
  ReportOptions report;
  ObstacleInput source;
};

struct AnglesAnswer {
  RationalPoint at;
  std::vector<FreeAngles> free;
};

std::vector<RationalPoint> read_positions(const AnglesCommand& command) {
  std::vector<RationalPoint> positions;
  for (const std::string& text : command.at) {
    const std::optional<RationalPoint> at = exact_position(text);
    if (!at) throw Stop(kUsage, "--at wants a place x,y, each a number or a fraction 1/3, not '" + text + "'");
    positions.push_back(*at);
  }
  if (!command.at_file.empty()) {
    const auto take = [&](const QueryLine& line, const Refuse& refuse) {
      if (line.theta) refuse("expected a place x,y: all angles are asked for");
      positions.push_back(line.at());
    };
    for_each_query(command.at_file, take, Fractions::taken);
  }
  if (positions.empty()) throw Stop(kUsage, "angles wants --at x,y or --at-file FILE");
  return positions;
}

/// What the robot would overlap beyond the end of an interval.
std::optional<Contact> contact_of(const CspaceObstacle& obstacle, std::uint32_t patch) {
  if (patch == Patch::kNone) return std::nullopt;
  return obstacle.patches()[patch].contact;
}

bool is_whole_circle(const FreeAngles& f) {
  return f.end - f.begin == 2 * std::numbers::pi && f.begin_patch == Patch::kNone && f.end_patch == Patch::kNone;
}

Json free_json(const CspaceObstacle& obstacle, const FreeAngles& f) {
  return {{"begin", f.begin},
          {"end", f.end},
          {"error", std::max(f.begin_error, f.end_error)},
          {"begin_contact", contact_json(contact_of(obstacle, f.begin_patch))},
          {"end_contact", contact_json(contact_of(obstacle, f.end_patch))}};
}

Json angles_json(const CspaceObstacle& obstacle, const std::vector<AnglesAnswer>& answers) {
  Json list = Json::array();
  for (const AnglesAnswer& answer : answers) {
    Json free = Json::array();
    for (const FreeAngles& f : answer.free) free.push_back(free_json(obstacle, f));
    Json one = {{"at", {answer.at.x.to_double(), answer.at.y.to_double()}}, {"free_angles", free}};
    if (!is_of_doubles(answer.at)) one["exact"] = {answer.at.x.to_string(), answer.at.y.to_string()};
    list.push_back(std::move(one));
  }
  return list;
}

void print_answer(const CspaceObstacle& obstacle, const AnglesAnswer& answer) {
  print_exact(std::cout << "(", answer.at.x);
  print_exact(std::cout << ", ", answer.at.y);
  std::cout << "):";
  if (answer.free.empty()) std::cout << " no angle";
  std::cout << "\n";
  const auto end_text = [&](std::uint32_t patch) {
    const std::optional<Contact> contact = contact_of(obstacle, patch);
    return contact ? " (" + contact_text(*contact) + ")" : std::string();
  };
  for (const FreeAngles& f : answer.free) {
    if (is_whole_circle(f)) std::cout << "  every angle\n";
    else if (f.single()) std::cout << "  " << f.begin << " alone\n";
    else std::cout << "  " << f.begin << end_text(f.begin_patch) << " to " << f.end << end_text(f.end_patch) << "\n";
  }
}

ExitCode run_angles(const AnglesCommand& command) {
  check_obstacle_input("angles", command.source);
  const std::vector<RationalPoint> positions = read_positions(command);
  const Rational times = times_for(positions);
  const InterruptGuard guard;
  ObstacleSource source = read_source(command.source);
  enlarge(source, times);
  const CspaceObstacle obstacle = obstacle_of(source);
  const ObstacleQueries queries(obstacle);
  const auto [answers, timing] = timed(command.report.repeat, [&] {
    std::vector<AnglesAnswer> all;
    for (const RationalPoint& at : positions) {
      throw_if_interrupted();
      const Point larger = enlarged(at, times);
      all.push_back({at, queries.free_angles(larger.x, larger.y)});
    }
    return all;
  });
  if (command.report.json) {
    Json json = report_of_answers("angles", source, obstacle, timing);
    json["answers"] = angles_json(obstacle, answers);
    print_report(json);
  } else {
    const auto precision = std::cout.precision(12);
    for (const AnglesAnswer& answer : answers) print_answer(obstacle, answer);
    std::cout.precision(precision);
    print_times(std::cout, timing);
  }
  return answers.size() == 1 && answers.front().free.empty() ? kNo : kDone;
}

}  // namespace

void add_angles(CLI::App& app, Action& action) {
  auto command = std::make_shared<AnglesCommand>();
  CLI::App& verb = *app.add_subcommand(
      "angles", "At which angles a shape that turns can stand at a place without overlapping one that stays");
  add_obstacle_input(verb, command->source);
  verb.add_option("--at", command->at,
                  "Where the reference point of the robot is, numbers or fractions 1/3; repeatable")
      ->type_name("x,y")
      ->allow_extra_args(false);
  verb.add_option("--at-file", command->at_file, "A file of such, x,y on a line; - for standard input")
      ->type_name("FILE");
  add_report_options(verb, command->report, "Ask N times and report the median and minimum time");
  add_input_options(verb, command->source.input);
  verb.footer(
      "Touching is allowed. In radians, counter-clockwise from each first angle to the second one. Exit code 4 when "
      "there is\n"
      "no angle at a single place.\nExample: dymsum angles 'swim.json#3' 'swim.json#0' --repair --at 2000,100");
  verb.callback([command, &action] { action = [command] { return run_angles(*command); }; });
}

}  // namespace dymsum::cli
