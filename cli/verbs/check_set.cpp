// dymsum check sum P Q RESULT, check nfp, check fit
#include <CLI/CLI.hpp>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <variant>

#include "dymsum/set_check.h"
#include "dymsum/solid_erosion.h"
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

/// What the result should be.
struct CheckedSet {
  std::string name;
  Operand first, second;
  std::string what;
  std::function<Result<PlanarSum>(const PlanarOperand&, const PlanarOperand&, const SumOptions&)> planar;
  std::function<Result<SpatialSum>(const SpatialOperand&, const SpatialOperand&, const SpatialOptions&)> solid;
};

struct SetCheckCommand {
  const CLI::App* parser = nullptr;
  std::vector<std::string> operands{"", "", ""};
  std::string within, semantics = "regular";
  std::vector<std::string> outputs;
  ReportOptions report;
  InputOptions input;
};

template <class Check>
Json set_check_json(const SetCheckCommand& command, const CheckedSet& of, Json inputs, const Check& check,
                    CheckVerdict verdict, const Timing& timing) {
  Json json = report_head(of.name, std::move(inputs), 0, timing);
  json.update(
      {{"semantics", command.semantics},
       {"within", command.within.empty() ? Json() : Json(read_tolerance(command.within, "--within").to_string())},
       {"verdict", name(verdict)},
       {"contains", check.contains()},
       {"contained", check.contained()},
       {"missing", excess_json(check.missing, command.report.exact)},
       {"surplus", excess_json(check.surplus, command.report.exact)}});
  return json;
}

template <class Check>
void print_set_check(const SetCheckCommand& command, const Check& check, CheckVerdict verdict) {
  std::cout << (check.equal()                    ? "right: equal"
                : verdict == CheckVerdict::right ? "right: within " + command.within
                : verdict == CheckVerdict::wrong ? "wrong"
                                                 : "undecided");
  if (!check.equal())
    std::cout << (check.contains()    ? ", never too small"
                  : check.contained() ? ", never too large"
                                      : ", too small here and too large there");
  std::cout << "\n";
  print_excess(std::cout, check.missing, "missing", "RESULT");
  print_excess(std::cout, check.surplus, "too much", "the right set");
}

template <class Check>
ExitCode report_set_check(const SetCheckCommand& command, const CheckedSet& of, const Json& inputs, const Check& check,
                          const Timing& timing) {
  const CheckVerdict verdict =
      check.within(command.within.empty() ? Rational() : read_tolerance(command.within, "--within"));
  if (command.report.json) {
    print_report(set_check_json(command, of, inputs, check, verdict, timing));
  } else {
    print_set_check(command, check, verdict);
    print_times(std::cout, timing);
  }
  return exit_code_of(verdict);
}

ExitCode run_planar_set_check(const SetCheckCommand& command, const CheckedSet& of) {
  refuse_options(*command.parser, {"--hull"}, "is for solids");
  const std::vector<Input> inputs = read_operands(command.operands, command.input);
  const InterruptGuard guard;
  SumOptions sums;
  SetCheckOptions options;
  sums.semantics = options.semantics = named<Semantics>(command.semantics);
  std::optional<ProgressBar> bar;
  bar.emplace();
  sums.progress = options.progress = bar->callback();
  const std::vector<Input> operands(inputs.begin(), inputs.begin() + 2);
  std::optional<PlanarSum> right;
  const auto [check, timing] = timed(command.report.repeat, [&] {
    right = require_of(operands, of.planar(inputs[0].operand(), inputs[1].operand(), sums));
    return require_of(inputs, check_set(*right, inputs[2].operand(), options));
  });
  bar.reset();
  for (const std::string& file : command.outputs) write_text(file, set_picture(*right, inputs[2].operand(), check));
  return report_set_check(command, of, inputs_json(inputs), check, timing);
}

ExitCode run_solid_set_check(const SetCheckCommand& command, const CheckedSet& of) {
  refuse_options(*command.parser, {"--semantics", "-o"}, "of " + of.name + " is for planar operands");
  const std::vector<SolidInput> inputs = read_solids_and_results(command.operands, command.input);
  const InterruptGuard guard;
  SpatialOptions options;
  options.semantics = Semantics::regular;
  std::optional<ProgressBar> bar;
  bar.emplace();
  options.progress = bar->callback();
  const auto [check, timing] = timed(command.report.repeat, [&] {
    const SpatialSum right = require(of.solid(inputs[0].operand(), inputs[1].operand(), options));
    return require(check_set(right, inputs[2].operand(), options));
  });
  bar.reset();
  return report_set_check(command, of, solid_inputs_json(inputs), check, timing);
}

ExitCode run_set_check(const SetCheckCommand& command, const CheckedSet& of) {
  for (const std::string& file : command.outputs)
    if (!file.ends_with(".svg")) throw Stop(kUsage, of.name + " writes pictures (.svg), not '" + file + "'");
  if (!command.within.empty()) read_tolerance(command.within, "--within");
  return are_solid(command.operands, command.input) ? run_solid_set_check(command, of)
                                                    : run_planar_set_check(command, of);
}

void add_checked_set(CLI::App& app, Action& action, const CheckedSet& of) {
  auto command = std::make_shared<SetCheckCommand>();
  CLI::App& verb = *app.add_subcommand(of.name, "Whether RESULT, which any program made, is " + of.what +
                                                    ", exactly; else what is missing, what is too much, and where it "
                                                    "is furthest from right");
  command->parser = &verb;
  add_operands(verb, of.first, of.second, command->operands);
  verb.add_option("RESULT", command->operands[2], "What was made of them: a file, FILE#NAME, or -")
      ->required()
      ->type_name("");
  verb.add_option("--within", command->within,
                  "Right where no position of either set is further than T from the other one, exactly: 0.1, 1/3; "
                  "without it sets have to be equal")
      ->type_name("T");
  verb.add_option("--semantics", command->semantics,
                  "Planar operands: regular: what has area is compared; closed: segments and points, as exact "
                  "fits, as well")
      ->check(CLI::IsMember({"regular", "closed"}))
      ->capture_default_str();
  verb.add_option("-o", command->outputs, "Planar operands: a picture with the differences marked (.svg); repeatable")
      ->type_name("FILE")
      ->allow_extra_args(false);
  add_report_options(verb, command->report, "Check N times and report the median and minimum time");
  add_exact_option(verb, command->report, OperandKind::either);
  add_solid_input_options(verb, command->input);
  std::string words = of.name;
  words[words.find('-')] = ' ';
  verb.footer(
      "Exit 0: right; 4: wrong; 5: undecided, as T lies between the bounds of a distance that is no fraction.\n"
      "Example: dymsum " +
      words + " " + (of.name == "check-fit" ? "sheet.wkt part.wkt" : "a.wkt b.wkt") +
      " theirs.wkt --within 1e-6 -o differences.svg");
  verb.callback([command, of, &action] { action = [command, of] { return run_set_check(*command, of); }; });
}

}  // namespace

void add_check_sum(CLI::App& app, Action& action) {
  add_checked_set(app, action,
                  {"check-sum",
                   {"P", "One operand"},
                   {"Q", "The other one"},
                   "the sum of P and Q",
                   [](const PlanarOperand& p, const PlanarOperand& q, const SumOptions& options) {
                     return minkowski_sum(p, q, options);
                   },
                   [](const SpatialOperand& p, const SpatialOperand& q, const SpatialOptions& options) {
                     return minkowski_sum(p, q, options);
                   }});
}

void add_check_nfp(CLI::App& app, Action& action) {
  add_checked_set(
      app, action,
      {"check-nfp",
       {"FIXED", "The shape that stays"},
       {"MOVING", "The shape that moves"},
       "the no-fit polygon of MOVING around FIXED, for the origin of MOVING's coordinates",
       [](const PlanarOperand& a, const PlanarOperand& b, const SumOptions& options) { return nfp(a, b, options); },
       [](const SpatialOperand& a, const SpatialOperand& b, const SpatialOptions& options) {
         return std::visit([&](const auto* set) { return minkowski_sum(a, negated(*set), options); }, b.set());
       }});
}

void add_check_fit(CLI::App& app, Action& action) {
  add_checked_set(
      app, action,
      {"check-fit",
       {"CONTAINER", "The region to stay inside of"},
       {"PART", "The one that is to fit"},
       "the inner fit of PART in CONTAINER, for the origin of PART's coordinates",
       [](const PlanarOperand& p, const PlanarOperand& q, const SumOptions& options) { return erode(p, q, options); },
       [](const SpatialOperand& p, const SpatialOperand& q, const SpatialOptions& options) {
         return erode(p, q, options);
       }});
}

}  // namespace dymsum::cli
