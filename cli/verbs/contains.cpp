// dymsum contains P Q --at x,y | ROBOT OBSTACLE --at x,y,theta | SOLID SOLID --at x,y,z
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <span>

#include "dymsum/motion.h"
#include "dymsum/obstacle_queries.h"
#include "dymsum/sum_locator.h"
#include "exact_number.h"
#include "options.h"
#include "planar/configuration.h"
#include "planar/query_file.h"
#include "planar/tier.h"
#include "planar/uncertain_operands.h"
#include "progress_bar.h"
#include "report.h"
#include "solid/solid_contains.h"
#include "verbs/commands.h"

namespace dymsum::cli {
namespace {

struct ContainsCommand {
  const CLI::App* parser = nullptr;
  std::vector<std::string> operands{"", ""}, at;
  std::string at_file, semantics;
  UncertainOptions uncertain;
  ReportOptions report;
  InputOptions input;
};

/// A position of the sum, or with an angle a configuration of a robot.
struct Query {
  double x = 0, y = 0;
  std::optional<Orientation> theta;
  std::optional<RationalPoint> exact;  ///< where it was given in fractions

  RationalPoint at() const { return exact ? *exact : RationalPoint{Rational::of(x).value(), Rational::of(y).value()}; }
};

bool in_fractions(const std::vector<Query>& queries) {
  return std::any_of(queries.begin(), queries.end(), [](const Query& query) { return query.exact.has_value(); });
}

std::vector<Query> read_queries(const ContainsCommand& command) {
  std::vector<Query> queries;
  const auto add = [&](const QueryLine& line, const auto& refuse) {
    Query query{line.x, line.y, std::nullopt, line.exact};
    if (line.theta) {
      const Result<Orientation> theta = Orientation::nearest(line.theta->radians());
      if (!theta) refuse(theta.error().message);
      query.theta = *theta;
    }
    if (!queries.empty() && queries.front().theta.has_value() != query.theta.has_value())
      refuse("all questions have an angle, or none");
    queries.push_back(query);
  };
  for (const std::string& text : command.at) {
    const auto refuse = [&](const std::string& why) { throw Stop(kUsage, "--at '" + text + "': " + why); };
    const std::optional<QueryLine> line = query_in(text, Fractions::taken);
    if (!line) refuse("wants x,y for a place or x,y,theta for a configuration");
    add(*line, refuse);
  }
  if (!command.at_file.empty()) for_each_query(command.at_file, add, Fractions::taken);
  if (queries.empty()) throw Stop(kUsage, "give --at or --at-file");
  return queries;
}

/// Touching is inside a closed sum, and free for a robot unless it is said otherwise.
bool is_closed(const ContainsCommand& command, bool robot) {
  return command.semantics.empty() ? !robot : command.semantics == "closed";
}

/// In the sum of operands of which some are results.
std::vector<bool> in_sum_of_results(const std::vector<Input>& inputs, const std::vector<Query>& queries, bool closed,
                                    const Progress& progress) {
  SumOptions options;
  options.semantics = closed ? Semantics::closed : Semantics::open;
  options.progress = progress;
  const PlanarSum sum = require_of(inputs, minkowski_sum(inputs[0].operand(), inputs[1].operand(), options));
  const SumLocator locator(sum, options.semantics);
  std::vector<bool> inside;
  for (const Query& query : queries) inside.push_back(locator.contains_rational(query.at()));
  return inside;
}

std::vector<bool> in_sum(const std::vector<Input>& inputs, const std::vector<Query>& queries, bool closed,
                         const Progress& progress) {
  const auto answers_at = [&](const auto& positions) -> std::vector<bool> {
    const std::vector<std::uint8_t> inside =
        require_of(inputs, contains_each(inputs[0].region, inputs[1].region, std::span(positions),
                                         closed ? Semantics::closed : Semantics::open, 0, progress));
    return {inside.begin(), inside.end()};
  };
  if (in_fractions(queries)) {
    std::vector<RationalPoint> positions;
    for (const Query& query : queries) positions.push_back(query.at());
    return answers_at(positions);
  }
  std::vector<Point> positions;
  for (const Query& query : queries) positions.push_back({query.x, query.y});
  return answers_at(positions);
}

/// The obstacle of all angles is worth its while for many questions; it knows interiors only.
std::vector<bool> in_obstacle(const std::vector<Input>& inputs, const std::vector<Query>& queries, bool closed,
                              const Progress& progress) {
  const Region &robot = inputs[0].region, &obstacle = inputs[1].region;
  constexpr std::size_t kMany = 256;
  std::vector<bool> inside;
  if (!closed && queries.size() >= kMany && !in_fractions(queries)) {
    ObstacleOptions options;
    options.progress = progress;
    const CspaceObstacle made = require_of(inputs, CspaceObstacle::create(robot, obstacle, options));
    const ObstacleQueries index(made);
    for (const Query& query : queries) inside.push_back(index.contains(query.x, query.y, *query.theta));
    return inside;
  }
  for (const Query& query : queries) {
    const RationalPoint at = query.at();
    inside.push_back(!require_of(inputs, check_translation(robot, obstacle, at, at, *query.theta,
                                                           closed ? Touching::forbidden : Touching::allowed))
                          .free);
  }
  return inside;
}

Json answers_json(const std::vector<Query>& queries, const std::vector<bool>& inside) {
  Json list = Json::array();
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const Query& q = queries[i];
    Json at = {q.x, q.y};
    if (q.theta) at.push_back(q.theta->radians());
    Json answer = {{"at", at}};
    if (q.exact) answer["exact"] = {q.exact->x.to_string(), q.exact->y.to_string()};
    if (q.theta) answer["tan_half"] = orientation_json(*q.theta)["tan_half"];
    answer["inside"] = bool{inside[i]};
    list.push_back(answer);
  }
  return list;
}

void print_text(const std::vector<Query>& queries, const std::vector<bool>& inside) {
  const auto precision = std::cout.precision(17);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const RationalPoint at = queries[i].at();
    print_exact(std::cout << "(", at.x);
    print_exact(std::cout << ", ", at.y);
    if (queries[i].theta) std::cout << ", " << queries[i].theta->radians();
    std::cout << "): " << (inside[i] ? "inside" : "outside") << "\n";
  }
  std::cout.precision(precision);
}

/// The query of one position, in the report of all.
Json at_json(const Query& q) {
  Json json = {{"at", {q.x, q.y}}};
  if (q.exact) json["exact"] = {q.exact->x.to_string(), q.exact->y.to_string()};
  return json;
}

ExitCode run_uncertain_contains(const ContainsCommand& command, const std::vector<Query>& queries) {
  if (queries.front().theta)
    refuse_options(*command.parser, kUncertainOptions, "is for places x,y, not for configurations x,y,theta");
  refuse_options(*command.parser, {"--lines"}, "goes without --tolerance, --fuzz and --variants");
  const Semantics semantics = is_closed(command, false) ? Semantics::closed : Semantics::open;
  const UncertainOperands operands = read_uncertain(command.operands, command.uncertain, command.input);
  const InterruptGuard guard;
  const auto [answers, timing] = timed(command.report.repeat, [&] {
    std::vector<UncertainAnswer> all;
    for (const Query& query : queries) {
      throw_if_interrupted();
      all.push_back(require_of(operands.inputs, contains(operands.p, operands.q, query.at(), semantics)));
    }
    return all;
  });
  Json list = Json::array();
  for (std::size_t i = 0; i < queries.size(); ++i) {
    list.push_back(at_json(queries[i]));
    list.back().update(holds_json(answers[i]));
  }
  if (command.report.json) {
    Json json = report_head("contains", inputs_json(operands.inputs),
                            tier_of(operands.inputs[0].region, operands.inputs[1].region), timing);
    json.update({{"semantics", name(semantics)},
                 {"uncertain", uncertain_json(command.uncertain, operands)},
                 {"answers", std::move(list)}});
    print_report(json);
  } else {
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const RationalPoint at = queries[i].at();
      print_exact(std::cout << "(", at.x);
      print_exact(std::cout << ", ", at.y);
      std::cout << "): inside " << holds_text(answers[i], operands) << "\n";
    }
    print_times(std::cout, timing);
  }
  return queries.size() == 1 ? exit_code_of(answers.front()) : kDone;
}

ExitCode run_contains(const ContainsCommand& command) {
  if (are_solid(command.operands, command.input)) {
    refuse_options(*command.parser, kUncertainOptions, "is for regions");
    return run_solid_contains(
        {command.operands, command.at, command.at_file, command.semantics, command.report, command.input});
  }
  refuse_options(*command.parser, {"--hull", "--thin"}, "is for solids");
  const std::vector<Query> queries = read_queries(command);
  if (command.uncertain.given()) return run_uncertain_contains(command, queries);
  const bool robot = queries.front().theta.has_value(), closed = is_closed(command, robot);
  const std::vector<Input> inputs =
      robot ? read_inputs(command.operands, command.input) : read_operands(command.operands, command.input);
  const bool results = inputs[0].result || inputs[1].result;
  const Region &first = inputs[0].region, &second = inputs[1].region;
  const InterruptGuard guard;
  std::optional<ProgressBar> bar(std::in_place);
  const auto [inside, timing] = timed(command.report.repeat, [&] {
    return robot     ? in_obstacle(inputs, queries, closed, bar->callback())
           : results ? in_sum_of_results(inputs, queries, closed, bar->callback())
                     : in_sum(inputs, queries, closed, bar->callback());
  });
  bar.reset();
  if (command.report.json) {
    Json json = report_head("contains", inputs_json(inputs), tier_of(first, second), timing);
    json.update({{"semantics", closed ? "closed" : "open"}, {"answers", answers_json(queries, inside)}});
    print_report(json);
  } else {
    print_text(queries, inside);
    print_times(std::cout, timing);
  }
  return queries.size() == 1 && !inside.front() ? kNo : kDone;
}

}  // namespace

void add_contains(CLI::App& app, Action& action) {
  auto command = std::make_shared<ContainsCommand>();
  CLI::App& verb = *app.add_subcommand(
      "contains",
      "Whether places lie in P (+) Q, planar or solid, or configurations in the obstacle of ROBOT P and OBSTACLE Q, "
      "exactly");
  command->parser = &verb;
  add_operands(verb, {"P", "The first operand, or the robot"}, {"Q", "The second operand, or the obstacle"},
               command->operands);
  verb.add_option(
          "--at", command->at,
          "A place x,y of the sum, or a configuration x,y,theta of the robot, theta in radians or as 90deg; of solids "
          "a place x,y,z; x, y and z may be fractions 1/3; repeatable")
      ->type_name("x,y[,theta|,z]")
      ->allow_extra_args(false);
  verb.add_option("--at-file", command->at_file,
                  "Such places or configurations, one a line; # begins a comment; - for standard input")
      ->type_name("FILE");
  one_of(verb.add_option("--semantics", command->semantics,
                         "closed: touching counts as inside (the default of places); open: it does not (the default of "
                         "configurations)"),
         std::span(names_of<Semantics>()).first<2>());
  add_report_options(verb, command->report, "Ask N times and report the median and minimum time");
  add_solid_input_options(verb, command->input);
  add_lines_option(verb, command->input);
  add_thin_option(verb, command->input);
  add_uncertain_options(verb, command->uncertain, "P", "Q");
  verb.footer(
      "Exit code 4 when the answer to a single question is no.\nExample: dymsum contains bar.wkt rooms.wkt --at "
      "1,2,90deg\n"
      "Example: dymsum contains part.off tool.off --at 1,2,1/3");
  verb.callback([command, &action] { action = [command] { return run_contains(*command); }; });
}

}  // namespace dymsum::cli
