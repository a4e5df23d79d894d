#include "verbs/sum_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "dymsum/planar_boolean.h"
#include "dymsum/snap_rounding.h"
#include "memory_limit.h"
#include "progress_bar.h"
#include "report.h"
#include "solid/solid_limits.h"
#include "solid/solid_operands.h"
#include "solid/solid_sum.h"
#include "verbs/uncertain_sum.h"
#include "viewer/viewer_pages.h"

namespace dymsum::cli {
namespace {

SumOptions sum_options(const SumCommand& command) {
  SumOptions options;
  options.engine = named<Engine>(command.engine);
  options.semantics = named<Semantics>(command.semantics);
  options.memory = memory_bytes(command.memory_mb);
  for (const std::string& file : command.output.files) options.trace |= is_stage_picture(file);
  return options;
}

void check(const SumCommand& command) {
  if (!writes_to_stdout(command.output.files)) refuse_options(*command.parser, {"--to"}, "is the format of -o -");
  check_outputs(command.output);
  if (!writes_rounded(command.output))
    refuse_options(*command.parser, {"--round-repair"}, "belongs to -o FILE.wkt, .poly or .geojson");
}

std::vector<PlanarOperand> operands_of(const std::vector<Input>& inputs) {
  std::vector<PlanarOperand> operands;
  for (const Input& input : inputs) operands.push_back(input.operand());
  return operands;
}

/// Exact fits of the open semantics are tight features alone; of a Boolean operation of open sets these are no part.
bool is_empty(const PlanarSum& sum, const SumVerb& verb) {
  return sum.parts.empty() && sum.segments.empty() && sum.points.empty() &&
         (verb.boolean || (sum.tight_segments.empty() && sum.tight_points.empty()));
}

/// What pictures show beside the first operand: the second one, or all others.
Region second_shown(const std::vector<Input>& inputs) {
  if (inputs.size() == 2) return inputs[1].region;
  std::vector<PlanarOperand> others;
  for (std::size_t k = 1; k < inputs.size(); ++k) others.push_back(inputs[k].region);
  SumOptions regular;
  regular.semantics = Semantics::regular;
  return require(snap_rounded(require(united(others, regular)))).region;
}

/// The names of the operands in pictures: the second shown stands for all but the first.
SumNames names_of(const SumVerb& verb, std::size_t operands) {
  SumNames names = verb.names;
  const std::string sign = verb.name == "intersect"  ? " ∩ "
                           : verb.name == "subtract" ? " ∖ "
                           : verb.boolean            ? " ∪ "
                                                     : " ⊕ ";
  const char first = verb.boolean ? 'A' : 'P';
  for (std::size_t k = 2; k < operands; ++k) {
    const std::string name(1, static_cast<char>(std::min<std::size_t>(first + k, 'Z')));
    names.q += " ∪ " + name;
    names.sum += sign + name;
  }
  return names;
}

void add_output_options(CLI::App& verb, SumCommand& command, bool planar_result) {
  const std::string
      planar = "by extension .poly .wkt .geojson .dxf .gpkg (rounded), .json (exact, with provenance), .svg (picture)",
      stages = planar_result ? ", of planar operands stages.svg (the stages)" : ", stages.svg (the stages)",
      solid = planar_result ? "" : "; of solids .off .obj .stl .ply .3mf (rounded), .json, .glb, stages.glb";
  verb.add_option(
          "-o", command.output.files,
          "Write the result; repeatable; " + planar + stages + solid + ", .html (the viewer); - is standard output")
      ->type_name("FILE")
      ->allow_extra_args(false);
  one_of(verb.add_option("--to", command.output.to,
                         planar_result ? "Format of -o -" : "Format of -o -; of solids off if not given"),
         file_formats(planar_result ? OperandKind::planar : OperandKind::either))
      ->capture_default_str();
  verb.add_flag("--round-repair", command.output.round_repair,
                std::string(planar_result ? "Where" : "Planar: where") +
                    " rounding would change the topology, merge what collides before edges are bent");
}

void add_sum_options(CLI::App& verb, SumCommand& command, const SumVerb& of) {
  const bool planar_result = of.planar_result;
  add_output_options(verb, command, planar_result);
  if (!of.boolean)
    one_of<Engine>(verb.add_option("--engine", command.engine,
                                   planar_result
                                       ? "Planar operands: how the boundary is found; all give the same result"
                                       : "How the boundary is found; all give the same set; of solids fast or brute"))
        ->capture_default_str();
  one_of<Semantics>(
      verb.add_option(
          "--semantics", command.semantics,
          of.boolean ? "regular: parts with area or volume alone; closed: with what only touches, and what is tight in "
                       "results; open: of open sets; tight features are listed with both"
                     : std::string(planar_result ? "Planar operands: " : "") +
                           "closed: sum of closed sets; open: touching is allowed; regular: no tight features"))
      ->capture_default_str();
  add_report_options(verb, command.report, "Compute N times and report the median and minimum time");
  add_exact_option(verb, command.report, planar_result ? OperandKind::planar : OperandKind::either);
}

}  // namespace

CLI::App& declare_sum_verb(CLI::App& app, const SumVerb& verb, SumCommand& command) {
  command.semantics = verb.semantics;
  CLI::App& parser = *app.add_subcommand(verb.name, verb.description);
  add_operands(parser, verb.first, verb.second, command.operands);
  if (verb.several) parser.add_option("MORE", command.more, "More of them")->type_name("");
  add_sum_options(parser, command, verb);
  add_solid_input_options(parser, command.input, OperandKind::either,
                          verb.is_sum ? Hulls::of_results_too : Hulls::of_operands);
  if (!verb.planar_result) add_lines_option(parser, command.input);
  add_memory_option(parser, command.memory_mb, OperandKind::either);
  if (!verb.planar_result) add_round_option(parser, command.round, OperandKind::either);
  if (verb.is_sum) {
    parser.add_flag("--triangulate", command.triangulate, "Solids: write triangles, for programs that take no others");
    add_thin_option(parser, command.input);
  }
  if (verb.uncertain) {
    add_uncertain_options(parser, command.uncertain, verb.first.name, verb.second.name);
    parser
        .add_option("--set", command.set,
                    "With one of these: which set -o writes, but for pictures, which show both: outer or inner")
        ->check(CLI::IsMember({"outer", "inner"}))
        ->capture_default_str();
  }
  parser.footer(verb.footer);
  command.parser = &parser;
  return parser;
}

void add_sum_verb(CLI::App& app, const SumVerb& verb, Action& action) {
  auto command = std::make_shared<SumCommand>();
  CLI::App& parser = declare_sum_verb(app, verb, *command);
  parser.callback([verb, command, &action] {
    action = with_viewer(verb, *command, [verb, command] { return run_sum(verb, *command); });
  });
}

Action with_viewer(const SumVerb& verb, SumCommand& command, const Action& action) {
  ViewerPage page{command.parser, verb.page, verb.solid_page, Json::object()};
  if (verb.orientation) {
    const Orientation& theta = *verb.orientation;
    page.instead = {{"tan-half", theta.is_half_turn() ? "inf" : theta.tan_half().to_string()},
                    {"angle", nullptr},
                    {"degrees", nullptr},
                    {"error", nullptr}};
  }
  return [page, &command, action] {
    std::vector<std::string> operands = command.operands;
    operands.insert(operands.end(), command.more.begin(), command.more.end());
    refuse_pages(command.uncertain, command.output.files);
    return run_with_pages(page, operands, command.input, command.output.files, action);
  };
}

ExitCode run_sum(const SumVerb& verb, const SumCommand& command) {
  if (are_solid(command.operands, command.input)) {
    if (verb.uncertain) {
      refuse_options(*command.parser, kUncertainOptions, "is for regions");
      refuse_options(*command.parser, {"--set"}, "is for regions");
    }
    return run_solid_sum(verb, command);
  }
  refuse_options(*command.parser, {"--triangulate", "--thin", "--round"}, "is for solids");
  if (command.uncertain.given()) return run_uncertain_sum(verb, command);
  if (verb.uncertain) refuse_options(*command.parser, {"--set"}, "belongs to --tolerance, --fuzz or --variants");
  std::ostream& out = report_stream(command.output.files, command.report.json);
  check(command);
  for (const std::string& file : command.output.files)
    if ((verb.boolean || verb.two_steps || !command.more.empty()) && is_stage_picture(file))
      throw Stop(kUsage, file + ": " + verb.name + (verb.is_sum ? " of more than two operands" : "") +
                             " has no stages to draw");
  limit_memory(command.memory_mb);
  SumReport report;
  report.verb = verb.name;
  if (!verb.boolean) report.engine = command.engine;
  report.semantics = command.semantics;
  report.orientation = verb.orientation;
  report.exact = command.report.exact;
  std::vector<std::string> files = command.operands;
  files.insert(files.end(), command.more.begin(), command.more.end());
  report.inputs = verb.orientation ? read_inputs(files, command.input) : read_operands(files, command.input);
  const Region& p = report.inputs[0].region;
  const Region& q = report.inputs[1].region;

  const InterruptGuard guard;
  SumOptions options = sum_options(command);
  std::optional<ProgressBar> bar(std::in_place);
  options.progress = bar->callback();
  const auto compute = [&] {
    PlanarSum sum = require_of(report.inputs, verb.planar(operands_of(report.inputs), options));
    throw_if_interrupted();
    return sum;
  };
  const auto [sum, timing] = timed(command.report.repeat, compute);
  bar.reset();
  report.sum = &sum;
  report.timing = timing;
  const std::array<Region, 2> operands = verb.shown ? verb.shown(p, q) : std::array{p, second_shown(report.inputs)};
  const bool regions =
      std::none_of(report.inputs.begin(), report.inputs.end(), [](const Input& i) { return i.result; });
  if (!verb.boolean && !verb.two_steps && regions && report.inputs.size() == 2)
    report.convolution = convolution_sizes(operands[0], verb.reflects_second ? negated(operands[1]) : operands[1]);

  report.rounding = write_sum(operands[0], operands[1], sum, names_of(verb, report.inputs.size()), command.output);
  if (command.report.json) {
    print_report(sum_json(report));
  } else {
    print_sum(out, report);
  }
  return verb.empty_is_no && is_empty(sum, verb) ? kNo : kDone;
}

}  // namespace dymsum::cli
