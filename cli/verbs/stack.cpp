// dymsum stack CONTAINER PART
#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>

#include "dymsum/names.h"
#include "dymsum/robustness.h"
#include "exact_number.h"
#include "inputs.h"
#include "line_file.h"
#include "options.h"
#include "outputs.h"
#include "pictures/fit_picture.h"
#include "planar/tier.h"
#include "planar/uncertain_operands.h"
#include "progress_bar.h"
#include "report.h"
#include "timing.h"
#include "verbs/commands.h"

namespace dymsum::cli {
namespace {

struct StackCommand {
  std::vector<std::string> operands{"", ""};
  std::string at, tolerance, container_file, part_file;
  std::vector<std::string> files;
  ReportOptions report;
  InputOptions input;
};

struct StackTolerances {
  std::vector<Tolerance> container, part;
};

StackTolerances tolerances_of(const StackCommand& command) {
  std::array<Tolerance, 2> all{};
  if (!command.tolerance.empty()) all = read_tolerances(command.tolerance);
  for (const Tolerance& tolerance : all)
    if (tolerance.lower > tolerance.upper)
      throw Stop(kUsage, "--tolerance: the lower deviation is larger than the upper one: write +A/-B");
  StackTolerances tolerances{{all[0]}, {all[1]}};
  if (!command.container_file.empty()) tolerances.container = read_tolerance_file(command.container_file);
  if (!command.part_file.empty()) tolerances.part = read_tolerance_file(command.part_file);
  return tolerances;
}

/// Stops where a file has neither one tolerance nor one for each vertex.
void check_count(const std::vector<Tolerance>& tolerances, const std::string& file, const Input& shape) {
  const std::size_t vertices = shape.region.vertex_count();
  if (file.empty() || tolerances.size() == 1 || tolerances.size() == vertices) return;
  refuse_line({ErrorCode::out_of_range,
               "the file holds " + std::to_string(tolerances.size()) + " tolerances for the " +
                   std::to_string(vertices) + " vertices of " + shown_file(shape.file) + ": give one, or one for each",
               {}},
              file, std::nullopt);
}

/// The stack, and the position of the part: the one that was given, or the most robust one.
struct StackFound {
  std::optional<RationalPoint> at;  ///< nothing where the part fits nowhere
  FitStack stack;
};

StackFound found_for(const std::vector<Input>& inputs, const StackTolerances& tolerances,
                     std::optional<RationalPoint> at) {
  const Region &container = inputs[0].region, &part = inputs[1].region;
  if (!at) {
    const RobustFit best = require_of(inputs, most_robust_fit(container, part));
    if (!best.fits) return {};
    at = best.at;
  }
  return {at, require_of(inputs, fit_stack(container, tolerances.container, part, tolerances.part, *at))};
}

Json feature_json(const PlanarFeature& f) { return {{std::string(name(f.kind)), f.index}}; }

Json stack_row_json(const FitStackRow& row) {
  return {{"container", feature_json(row.container)},
          {"part", feature_json(row.part)},
          {"nominal", row.nominal},
          {"nominal_squared_exact", row.squared.to_string()},
          {"least", row.least},
          {"most", row.most},
          {"of_container", row.of_container},
          {"of_part", row.of_part}};
}

Json stack_json(const StackFound& found) {
  const FitStack& stack = found.stack;
  Json rows = Json::array();
  for (const FitStackRow& row : stack.rows) rows.push_back(stack_row_json(row));
  Json json = {{"fits", stack.fits}};
  json["at"] = found.at ? Json({found.at->x.to_double(), found.at->y.to_double()}) : Json();
  json["at_exact"] = found.at ? Json({found.at->x.to_string(), found.at->y.to_string()}) : Json();
  json["least"] = stack.rows.empty() ? Json() : Json(stack.rows.front().least);
  json["rows"] = std::move(rows);
  return json;
}

std::string feature_text(const PlanarFeature& f) { return std::string(name(f.kind)) + " " + std::to_string(f.index); }

void print_stack(std::ostream& out, const std::vector<Input>& inputs, const StackFound& found) {
  if (!found.stack.fits) {
    out << inputs[1].file << " does not fit into " << inputs[0].file << (found.at ? " there\n" : "\n");
    return;
  }
  print_exact(out << inputs[1].file << " in " << inputs[0].file << " at (", found.at->x);
  print_exact(out << ", ", found.at->y);
  out << "): clearance " << Json(found.stack.rows.front().least).dump() << " at the least\n"
      << "  container  part            nominal        least         most    container         part\n";
  for (const FitStackRow& row : found.stack.rows) {
    std::array<char, 160> line{};
    std::snprintf(line.data(), line.size(), "  %-9s  %-10s %12.7g %12.7g %12.7g %12.7g %12.7g\n",
                  feature_text(row.container).c_str(), feature_text(row.part).c_str(), row.nominal, row.least, row.most,
                  row.of_container, row.of_part);
    out << line.data();
  }
}

std::string stack_csv(const FitStack& stack) {
  std::ostringstream out;
  out << "container,part,nominal,least,most,of_container,of_part\n";
  for (const FitStackRow& row : stack.rows) {
    out << feature_text(row.container) << ',' << feature_text(row.part);
    for (const double value : {row.nominal, row.least, row.most, row.of_container, row.of_part})
      out << ',' << Json(value).dump();
    out << '\n';
  }
  return out.str();
}

ExitCode run_stack(const StackCommand& command) {
  std::optional<RationalPoint> at;
  if (!command.at.empty()) {
    at = exact_position(command.at);
    if (!at) throw Stop(kUsage, "--at wants 2 numbers or fractions x,y, not '" + command.at + "'");
  }
  for (const std::string& file : command.files)
    if (!file.ends_with(".csv")) check_fit_pictures({file});
  const StackTolerances tolerances = tolerances_of(command);
  std::ostream& out = report_stream(command.files, command.report.json);
  const std::vector<Input> inputs = read_inputs(command.operands, command.input);
  check_count(tolerances.container, command.container_file, inputs[0]);
  check_count(tolerances.part, command.part_file, inputs[1]);
  const InterruptGuard guard;
  const auto [found, timing] = timed(command.report.repeat, [&] { return found_for(inputs, tolerances, at); });
  const RationalPoint shown_at = found.at.value_or(RationalPoint{});
  for (const std::string& file : command.files)
    write_text(file, file.ends_with(".csv") ? stack_csv(found.stack)
                                            : stack_picture(inputs[0].region, inputs[1].region, shown_at, found.stack));
  if (command.report.json) {
    Json json = report_head("stack", inputs_json(inputs), tier_of(inputs[0].region, inputs[1].region), timing);
    json.update(stack_json(found));
    print_report(json);
  } else {
    print_stack(out, inputs, found);
    print_times(out, timing);
  }
  return found.stack.fits ? kDone : kNo;
}

}  // namespace

void add_stack(CLI::App& app, Action& action) {
  auto command = std::make_shared<StackCommand>();
  CLI::App& verb = *app.add_subcommand(
      "stack",
      "The tolerance stack of a fit: for each edge of a container the clearance of a part, the least and the most that "
      "tolerances leave, and what of it is the container's and the part's");
  add_operands(verb, {"CONTAINER", "The region around the part"}, {"PART", "The region in it"}, command->operands,
               OperandKind::planar);
  verb.add_option(
          "--at", command->at,
          "Where the part's reference point is, numbers or fractions 1/3; not given: the position with the most "
          "clearance")
      ->type_name("X,Y");
  verb.add_option("--tolerance", command->tolerance,
                  "Boundaries are off by +A outside to -B inside, each with its sign, or by A both ways; with a comma "
                  "one for CONTAINER and one for PART")
      ->type_name("+A/-B");
  verb.add_option("--container-tolerances", command->container_file,
                  "A file of such, one a line: for each edge of CONTAINER, by the vertex that it starts at")
      ->type_name("FILE");
  verb.add_option("--part-tolerances", command->part_file, "The same for PART")->type_name("FILE");
  verb.add_option("-o", command->files,
                  "Write the table, .csv, or a picture, .svg: the features of the least clearance marked; repeatable")
      ->type_name("FILE")
      ->allow_extra_args(false);
  add_report_options(verb, command->report, "Compute N times and report the median and minimum time");
  add_input_options(verb, command->input);
  verb.footer(
      "A negative clearance is an overlap. Exit code 4 when the part does not fit as it is given.\n"
      "Example: dymsum stack hole.wkt shaft.wkt --tolerance +0.0105/0,-0.0035/-0.01 -o stack.csv");
  verb.callback([command, &action] { action = [command] { return run_stack(*command); }; });
}

}  // namespace dymsum::cli
