// dymsum robustness P Q
#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>

#include "dymsum/robustness.h"
#include "exact_number.h"
#include "inputs.h"
#include "options.h"
#include "outputs.h"
#include "pictures/fit_picture.h"
#include "planar/tier.h"
#include "progress_bar.h"
#include "report.h"
#include "solid/depth_report.h"
#include "timing.h"
#include "verbs/commands.h"

namespace dymsum::cli {
namespace {

struct RobustnessCommand {
  std::vector<std::string> operands{"", ""};
  std::string at;
  bool fit = false;
  std::vector<std::string> files;
  ReportOptions report;
  InputOptions input;
};

/// What was found at a position: the one that was given, or the most robust one.
struct Found {
  std::optional<RationalPoint> at;  ///< nothing where the part fits nowhere
  Robustness robustness;
  std::optional<RobustFit> best;
};

Found found_for(const RobustnessCommand& command, const std::vector<Input>& inputs,
                const std::optional<RationalPoint>& at) {
  const Region &p = inputs[0].region, &q = inputs[1].region;
  if (!command.fit) return {at, require_of(inputs, robustness_of_free(p, q, *at)), std::nullopt};
  if (at) return {at, require_of(inputs, robustness_of_fit(p, q, *at)), std::nullopt};
  const RobustFit best = require_of(inputs, most_robust_fit(p, q));
  if (!best.fits) return {std::nullopt, {}, best};
  return {best.at, require_of(inputs, robustness_of_fit(p, q, best.at)), best};
}

Json number_json(double value) { return std::isinf(value) ? Json("inf") : Json(value); }

Json found_json(const RobustnessCommand& command, const Found& found) {
  const Robustness& robustness = found.robustness;
  Json json = {{"question", command.fit ? "fit" : "free"}};
  json["at"] = found.at ? Json({found.at->x.to_double(), found.at->y.to_double()}) : Json();
  json["at_exact"] = found.at ? Json({found.at->x.to_string(), found.at->y.to_string()}) : Json();
  json["holds"] = robustness.holds;
  json["radius"] = number_json(robustness.radius);
  json["squared_exact"] = std::isinf(robustness.radius) ? Json() : Json(robustness.squared.to_string());
  if (found.best) json["at_most"] = found.best->at_most, json["exact"] = found.best->exact;
  json["ways"] = moves_json(robustness.ways);
  return json;
}

void print_found(std::ostream& out, const RobustnessCommand& command, const std::vector<Input>& inputs,
                 const Found& found) {
  const std::string &p = inputs[0].file, &q = inputs[1].file;
  const Robustness& robustness = found.robustness;
  if (!found.at) {
    out << q << " fits into " << p << " nowhere\n";
    return;
  }
  print_exact(out << q << " at (", found.at->x);
  print_exact(out << ", ", found.at->y);
  out << (command.fit ? ") lies in " : ") is clear of ") << p;
  if (!robustness.holds) out << ": no\n";
  else if (std::isinf(robustness.radius)) out << ", whatever its size\n";
  else
    out << " while every point of both moves by at most " << Json(robustness.radius).dump() << "\n  squared exactly "
        << shown(robustness.squared) << "\n";
  if (found.best) {
    out << "  no position has more";
    if (!found.best->exact) out << " than " << Json(found.best->at_most).dump();
    out << "\n";
  }
  out << moves_text(robustness.ways, p, q);
}

ExitCode run_robustness(const RobustnessCommand& command) {
  std::optional<RationalPoint> at;
  if (command.at.empty() && !command.fit) at = RationalPoint{};
  else if (!command.at.empty()) {
    at = exact_position(command.at);
    if (!at) throw Stop(kUsage, "--at wants 2 numbers or fractions x,y, not '" + command.at + "'");
  }
  check_fit_pictures(command.files);
  std::ostream& out = report_stream(command.files, command.report.json);
  const std::vector<Input> inputs = read_inputs(command.operands, command.input);
  const InterruptGuard guard;
  const auto [found, timing] = timed(command.report.repeat, [&] { return found_for(command, inputs, at); });
  const RationalPoint shown_at = found.at.value_or(RationalPoint{});
  for (const std::string& file : command.files)
    write_text(file, robustness_picture(inputs[0].region, inputs[1].region, shown_at, found.robustness));
  if (command.report.json) {
    Json json = report_head("robustness", inputs_json(inputs), tier_of(inputs[0].region, inputs[1].region), timing);
    json.update(found_json(command, found));
    print_report(json);
  } else {
    print_found(out, command, inputs, found);
    print_times(out, timing);
  }
  return found.robustness.holds ? kDone : kNo;
}

}  // namespace

void add_robustness(CLI::App& app, Action& action) {
  auto command = std::make_shared<RobustnessCommand>();
  CLI::App& verb = *app.add_subcommand("robustness",
                                       "By how much every point of two regions may be off before they overlap, or "
                                       "before a part no longer fits: exactly, "
                                       "with the features that meet then");
  add_operands(verb, {"P", "A region, or the container"}, {"Q", "The one that is moved, or the part"},
               command->operands, OperandKind::planar);
  verb.add_option("--at", command->at,
                  "Where Q's reference point is, numbers or fractions 1/3. Not given: the origin, and with --fit the "
                  "position at which the answer is largest")
      ->type_name("X,Y");
  verb.add_flag("--fit", command->fit, "Q is to lie in P; else they are to be clear of each other");
  verb.add_option("-o", command->files, "Write a picture, .svg: both shapes and what meets; repeatable")
      ->type_name("FILE")
      ->allow_extra_args(false);
  add_report_options(verb, command->report, "Compute N times and report the median and minimum time");
  add_input_options(verb, command->input);
  verb.footer(
      "Touching is allowed. Exit code 4 when the answer is no for the shapes as they are.\n"
      "Example: dymsum robustness slot.wkt peg.wkt --fit --at 1/3,1 -o fit.svg");
  verb.callback([command, &action] { action = [command] { return run_robustness(*command); }; });
}

}  // namespace dymsum::cli
