// dymsum check offset A RESULT --radius R
#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>

#include "dymsum/set_check.h"
#include "options.h"
#include "outputs.h"
#include "pictures/set_picture.h"
#include "planar/excess.h"
#include "progress_bar.h"
#include "report.h"
#include "solid/solid_operands.h"
#include "verbs/commands.h"

namespace dymsum::cli {
namespace {

struct OffsetCheckCommand {
  const CLI::App* parser = nullptr;
  std::vector<std::string> operands{"", ""};
  std::string radius, within;
  std::vector<std::string> outputs;
  ReportOptions report;
  InputOptions input;
};

/// The distances that are requested.
struct Required {
  DiscSide side = DiscSide::outside;
  Rational least;
  std::optional<Rational> most;
};

Required required_of(const OffsetCheckCommand& command) {
  Rational radius = require_option(Rational::parse(command.radius), "--radius");
  Required required;
  if (radius.sign() < 0) required.side = DiscSide::inside, radius = -radius;
  if (!command.within.empty()) required.most = radius + read_tolerance(command.within, "--within");
  required.least = std::move(radius);
  return required;
}

struct OffsetVerdict {
  CheckVerdict at_least, at_most, all;
};

template <class Check>
OffsetVerdict verdict_of(const Check& check, const Required& required) {
  OffsetVerdict v{
      check.at_least(required.least), required.most ? check.at_most(*required.most) : CheckVerdict::right, {}};
  v.all = v.at_least == CheckVerdict::right ? v.at_most : CheckVerdict::wrong;
  return v;
}

Json rounded(const RationalPoint& p) { return {p.x.to_double(), p.y.to_double()}; }
Json rounded(const RationalPoint3& p) { return {p.x.to_double(), p.y.to_double(), p.z.to_double()}; }
std::string shown_position(const Json& position) {
  std::string text;
  for (const Json& v : position) {
    std::ostringstream number;
    number << v.get<double>();
    text += (text.empty() ? "(" : ", ") + number.str();
  }
  return text + ")";
}

template <class Check>
Json offset_check_json(const OffsetCheckCommand& command, const Required& required, Json inputs, const Check& check,
                       const Timing& timing) {
  const OffsetVerdict v = verdict_of(check, required);
  const bool finite = std::isfinite(check.least);
  Json json = report_head("check-offset", std::move(inputs), 0, timing);
  json.update({{"side", name(required.side)},
               {"at_least", required.least.to_string()},
               {"at_most", required.most ? Json(required.most->to_string()) : Json()},
               {"verdict", name(v.all)},
               {"keeps_least", v.at_least == CheckVerdict::right},
               {"keeps_most", required.most ? Json(name(v.at_most)) : Json()},
               {"least", distance_json(check.least)},
               {"least_squared_exact", finite ? Json(check.least_squared.to_string()) : Json()},
               {"least_at", finite ? rounded(check.least_at) : Json()},
               {"least_from", finite ? rounded(check.least_from) : Json()},
               {"beyond", excess_json(check.beyond, command.report.exact)},
               {"between", excess_json(check.between, command.report.exact)}});
  return json;
}

template <class Check>
void print_offset_check(const Required& required, const Check& check) {
  const OffsetVerdict v = verdict_of(check, required);
  std::cout << (v.all == CheckVerdict::right ? "right" : v.all == CheckVerdict::wrong ? "wrong" : "undecided");
  if (v.at_least == CheckVerdict::wrong) std::cout << ", nearer than " << shown(required.least);
  if (v.at_most == CheckVerdict::wrong) std::cout << ", further than " << shown(*required.most);
  std::cout << "\n  at least " << shown_distance(check.least, check.least, true);
  if (check.least > 0 && std::isfinite(check.least)) std::cout << ", at " << shown_position(rounded(check.least_at));
  std::cout << "; at most " << shown_distance(check.between.distance, check.between.at_most, check.between.exact);
  if (check.between.distance > 0) std::cout << ", at " << shown_position(rounded(check.between.at));
  std::cout << "\n";
  if (required.side == DiscSide::outside) print_excess(std::cout, check.beyond, "A sticks out", "RESULT");
  else print_excess(std::cout, check.beyond, "RESULT sticks out", "A");
}

template <class Check>
ExitCode report_offset_check(const OffsetCheckCommand& command, const Required& required, const Json& inputs,
                             const Check& check, const Timing& timing) {
  if (command.report.json) {
    print_report(offset_check_json(command, required, inputs, check, timing));
  } else {
    print_offset_check(required, check);
    print_times(std::cout, timing);
  }
  return exit_code_of(verdict_of(check, required).all);
}

ExitCode run_planar_offset_check(const OffsetCheckCommand& command, const Required& required) {
  const std::vector<Input> inputs = read_operands(command.operands, command.input);
  const InterruptGuard guard;
  std::optional<ProgressBar> bar;
  bar.emplace();
  const Progress progress = bar->callback();
  const auto [check, timing] = timed(command.report.repeat, [&] {
    return require_of(inputs, check_offset(inputs[0].operand(), inputs[1].operand(), required.side, progress));
  });
  bar.reset();
  for (const std::string& file : command.outputs)
    write_text(file, offset_picture(inputs[0].operand(), inputs[1].operand(), check));
  return report_offset_check(command, required, inputs_json(inputs), check, timing);
}

ExitCode run_solid_offset_check(const OffsetCheckCommand& command, const Required& required) {
  const std::vector<SolidInput> inputs = read_solids_and_results(command.operands, command.input);
  const InterruptGuard guard;
  std::optional<ProgressBar> bar;
  bar.emplace();
  SpatialOptions options;
  options.progress = bar->callback();
  const auto [check, timing] = timed(command.report.repeat, [&] {
    return require(check_offset(inputs[0].operand(), inputs[1].operand(), required.side, options));
  });
  bar.reset();
  return report_offset_check(command, required, solid_inputs_json(inputs), check, timing);
}

ExitCode run_offset_check(const OffsetCheckCommand& command) {
  for (const std::string& file : command.outputs)
    if (!file.ends_with(".svg")) throw Stop(kUsage, "check-offset writes pictures (.svg), not '" + file + "'");
  const Required required = required_of(command);
  const bool solid = are_solid(command.operands, command.input);
  if (solid) refuse_options(*command.parser, {"-o"}, "of check-offset is for planar operands");
  else refuse_options(*command.parser, {"--hull"}, "is for solids");
  return solid ? run_solid_offset_check(command, required) : run_planar_offset_check(command, required);
}

}  // namespace

void add_check_offset(CLI::App& app, Action& action) {
  auto command = std::make_shared<OffsetCheckCommand>();
  CLI::App& verb = *app.add_subcommand(
      "check-offset", "Whether RESULT, which any program made, is at least R and at most R + E from A, exactly");
  command->parser = &verb;
  add_operands(verb, {"A", "What was grown or shrunk"}, {"RESULT", "What was made of it"}, command->operands);
  verb.add_option(
          "--radius", command->radius,
          "The distance, exact: 3/2, 0.1; A grown by it lies in RESULT. Negative: RESULT lies in A shrunk by it")
      ->required()
      ->type_name("R");
  verb.add_option("--within", command->within,
                  "RESULT lies in A grown by R + E, or holds A shrunk by so much; without it only R is required")
      ->type_name("E");
  verb.add_option("-o", command->outputs,
                  "Planar operands: a picture with the least and the largest distance marked (.svg); repeatable")
      ->type_name("FILE")
      ->allow_extra_args(false);
  add_report_options(verb, command->report, "Check N times and report the median and minimum time");
  add_exact_option(verb, command->report, OperandKind::either);
  add_solid_input_options(verb, command->input);
  verb.footer(
      "Exit 0: right; 4: wrong; 5: undecided, as R + E lies between the bounds of a distance that is no "
      "fraction.\nExample: dymsum check offset part.wkt theirs.wkt --radius 2 --within 0.01 -o distances.svg");
  verb.callback([command, &action] { action = [command] { return run_offset_check(*command); }; });
}

}  // namespace dymsum::cli
