// dymsum clearance ROBOT OBSTACLE --at x,y,theta
#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>

#include "dymsum/obstacle_queries.h"
#include "exact_number.h"
#include "exit_code.h"
#include "inputs.h"
#include "options.h"
#include "planar/configuration.h"
#include "planar/contact.h"
#include "planar/obstacle_input.h"
#include "planar/whole_places.h"
#include "progress_bar.h"
#include "report.h"
#include "timing.h"
#include "verbs/commands.h"

namespace dymsum::cli {
namespace {

struct ClearanceCommand {
  std::vector<std::string> at;
  std::string at_file, weight;
  bool strict = false;
  ReportOptions report;
  ObstacleInput source;
};

struct Answer {
  PlacedRobot at;
  Clearance clearance, translation;
  std::vector<FreeAngles> free;
  std::optional<Contact> contact;
};

/// The weight for an obstacle that is `times` as large.
double read_weight(const std::string& text, const ObstacleQueries& queries, double times) {
  if (text.empty()) return queries.gyration_radius();
  if (text == "inf") return std::numeric_limits<double>::infinity();
  const std::optional<double> weight = finite_number(text);
  if (!weight || !(*weight >= 0)) throw Stop(kUsage, "--weight wants a length per radian, or inf, not '" + text + "'");
  if (*weight * times > queries.largest_weight())
    throw Stop(kUsage, "--weight " + text +
                           " is more than 2^40 times the extent of the obstacle, where doubles of angles say nothing; "
                           "inf counts translations only");
  return *weight * times;
}

/// The clearance in the units of robot and obstacle as they were given. Weight and quotients are rounded.
Clearance divided(Clearance c, const Rational& times) {
  if (times == Rational(1)) return c;
  constexpr double kRoundings = 0x1p-50;
  const double by = times.to_double();
  if (c.distance != 0 || c.error != 0)
    c.error = c.error / by * (1 + kRoundings) + kRoundings * (std::abs(c.distance) / by);
  c.distance /= by;
  c.nearest.x /= by, c.nearest.y /= by;
  return c;
}

Answer query(const CspaceObstacle& obstacle, const ObstacleQueries& queries, const PlacedRobot& robot,
             const Rational& times, double weight, Touching touching) {
  Answer answer;
  answer.at = robot;
  const Point position = enlarged(robot.at, times);
  const Configuration at{position.x, position.y, robot.theta};
  answer.clearance = divided(queries.clearance(at, weight, touching), times);
  answer.translation = divided(queries.clearance(at, std::numeric_limits<double>::infinity(), touching), times);
  answer.free = queries.free_angles(at.x, at.y);
  if (answer.clearance.patch != Patch::kNone) answer.contact = obstacle.patches()[answer.clearance.patch].contact;
  return answer;
}

Json distance_json(const Clearance& c) {
  return {{"distance", c.distance}, {"error", c.error}, {"nearest", {c.nearest.x, c.nearest.y, c.nearest.theta}}};
}

Json answer_json(const Answer& a) {
  Json free = Json::array();
  for (const FreeAngles& f : a.free)
    free.push_back({{"begin", f.begin}, {"end", f.end}, {"error", std::max(f.begin_error, f.end_error)}});
  Json json = distance_json(a.clearance);
  json["at"] = {a.at.at.x.to_double(), a.at.at.y.to_double(), a.at.theta};
  if (!is_of_doubles(a.at.at)) json["exact"] = {a.at.at.x.to_string(), a.at.at.y.to_string()};
  json["free"] = !std::signbit(a.clearance.distance);
  json["contact"] = contact_json(a.contact);
  json["translation"] = distance_json(a.translation);
  json["free_angles"] = free;
  return json;
}

// The distance, with the error where digits that are printed are in doubt.
std::string distance_text(const Clearance& c) {
  std::ostringstream text;
  text << std::abs(c.distance);
  if (c.error > 1e-7 * std::abs(c.distance)) text << " +- " << c.error;
  return text.str();
}

void print_text(const Answer& a) {
  print_exact(std::cout << "(", a.at.at.x);
  print_exact(std::cout << ", ", a.at.at.y);
  std::cout << ", " << a.at.theta
            << "): " << (std::signbit(a.clearance.distance) ? "overlaps, depth " : "free, clearance ")
            << distance_text(a.clearance) << " (by translation alone " << distance_text(a.translation)
            << "), nearest contact at (" << a.clearance.nearest.x << ", " << a.clearance.nearest.y << ", "
            << a.clearance.nearest.theta << ")\n";
}

ExitCode run_clearance(const ClearanceCommand& command) {
  check_obstacle_input("clearance", command.source);
  std::vector<PlacedRobot> at;
  for (const std::string& text : command.at) at.push_back(read_placed_robot(text, "--at"));
  if (!command.at_file.empty()) {
    const std::vector<PlacedRobot> more = read_placed_robots(command.at_file);
    at.insert(at.end(), more.begin(), more.end());
  }
  if (at.empty()) throw Stop(kUsage, "clearance wants --at x,y,theta or --at-file FILE");
  std::vector<RationalPoint> positions;
  for (const PlacedRobot& robot : at) positions.push_back(robot.at);
  const Rational times = times_for(positions);
  const InterruptGuard guard;
  ObstacleSource source = read_source(command.source);
  enlarge(source, times);
  const CspaceObstacle obstacle = obstacle_of(source);
  const ObstacleQueries queries(obstacle);
  const double weight = read_weight(command.weight, queries, times.to_double());
  const auto [answers, timing] = timed(command.report.repeat, [&] {
    std::vector<Answer> all;
    for (const PlacedRobot& robot : at) {
      throw_if_interrupted();
      all.push_back(
          query(obstacle, queries, robot, times, weight, command.strict ? Touching::forbidden : Touching::allowed));
    }
    return all;
  });
  if (!command.report.json) {
    for (const Answer& a : answers) print_text(a);
    print_times(std::cout, timing);
    return kDone;
  }
  Json list = Json::array();
  for (const Answer& a : answers) list.push_back(answer_json(a));
  Json json = report_of_answers("clearance", source, obstacle, timing);
  json.update({{"weight", std::isfinite(weight) ? Json(weight / times.to_double()) : Json("inf")}, {"answers", list}});
  print_report(json);
  return kDone;
}

}  // namespace

void add_clearance(CLI::App& app, Action& action) {
  auto command = std::make_shared<ClearanceCommand>();
  CLI::App& verb = *app.add_subcommand(
      "clearance",
      "How far a robot that translates and turns is from touching an obstacle, or how deep it overlaps it");
  add_obstacle_input(verb, command->source);
  verb.add_option("--at", command->at,
                  "Where the robot is, x and y numbers or fractions 1/3, theta in radians or as 90deg; repeatable")
      ->type_name("x,y,theta")
      ->allow_extra_args(false);
  verb.add_option("--at-file", command->at_file, "A file of such, x,y,theta on a line; - for standard input")
      ->type_name("FILE");
  verb.add_option("--weight", command->weight,
                  "What a radian counts, as a length; inf: translations only. Default: the robot's radius of gyration")
      ->type_name("W");
  verb.add_flag("--strict", command->strict,
                "Touching counts as overlap: where the robot is jammed, how far it is from being loose");
  add_report_options(verb, command->report, "Ask N times and report the median and minimum time");
  add_input_options(verb, command->source.input);
  verb.footer("Example: dymsum clearance bar.wkt rooms.wkt --at 1,2,0.5 --json");
  verb.callback([command, &action] { action = [command] { return run_clearance(*command); }; });
}

}  // namespace dymsum::cli
