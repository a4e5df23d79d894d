// dymsum scale-range PART OBSTACLES --path ... | PART CONTAINER --inside [--place x,y]
#include "dymsum/scale_range.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <span>
#include <sstream>

#include "exact_number.h"
#include "exit_code.h"
#include "inputs.h"
#include "numbers.h"
#include "options.h"
#include "planar/tier.h"
#include "progress_bar.h"
#include "record_json.h"
#include "report.h"
#include "solid/solid_operands.h"
#include "solid/solid_scale_range.h"
#include "timing.h"
#include "verbs/commands.h"

namespace dymsum::cli {
namespace {

/// A waypoint or a position, whose coordinates may be fractions.
RationalPoint read_position(const std::string& text, const std::string& option) {
  const std::optional<RationalPoint> at = exact_position(text);
  if (!at) throw Stop(kUsage, option + " wants x,y, each a number or a fraction 1/3, not '" + text + "'");
  return *at;
}

RationalPoint exactly(const Point& p) { return {Rational::of(p.x).value(), Rational::of(p.y).value()}; }

/// "x,y x,y ..." or a file with one polyline.
std::vector<RationalPoint> read_path(const std::string& text) {
  std::vector<RationalPoint> path;
  if (text.find(',') != std::string::npos && !std::filesystem::exists(text)) {
    std::istringstream words(text);
    for (std::string word; words >> word;) path.push_back(read_position(word, "--path"));
    return path;
  }
  const RegionData data = require(read_region_data(text));
  const bool line = data.polylines.size() == 1 && data.parts.empty() && data.points.empty(),
             point = data.points.size() == 1 && data.parts.empty() && data.polylines.empty();
  if (line || point) {
    for (const Point& p : line ? data.polylines[0] : data.points) path.push_back(exactly(p));
    return path;
  }
  throw Stop(kBadInput, text + ": a path is one polyline or one point");
}

std::string contact_text(const ScaleContact& c, bool on_path) {
  const std::string part = std::to_string(c.part), obstacle = std::to_string(c.obstacle);
  const std::string text =
      c.kind == ScaleContact::Kind::vertex_on_edge   ? "vertex " + part + " of the part on edge " + obstacle
      : c.kind == ScaleContact::Kind::edge_on_vertex ? "edge " + part + " of the part on vertex " + obstacle
                                                     : "vertex " + part + " of the part on vertex " + obstacle;
  if (on_path) return text + ", leg " + std::to_string(c.leg) + " at " + shown(c.along);
  return text + ", part at (" + shown(c.at.x) + ", " + shown(c.at.y) + ")";
}

void print_json(const ScaleRange& range, const Timing& timing, const std::vector<Input>& inputs) {
  Json json = report_head("scale-range", inputs_json(inputs), tier_of(inputs[0].region, inputs[1].region), timing);
  json.update({{"free", json_of(range.free)},
               {"trap", json_of(range.trap())},
               {"critical", range.critical},
               {"tested", range.tested}});
  print_report(json);
}

void print_text(const ScaleRange& range, bool on_path) {
  std::cout << (range.free.empty() ? "never free\n" : "free scales:\n");
  for (const ScaleInterval& i : range.free) {
    std::cout << "  " << (i.low ? "[" + shown(*i.low) : std::string("(0")) << ", "
              << (i.high ? shown(*i.high) + "]" : std::string("unbounded)")) << "\n";
    for (const ScaleContact& c : i.at_low) std::cout << "    below: " << contact_text(c, on_path) << "\n";
    for (const ScaleContact& c : i.at_high) std::cout << "    above: " << contact_text(c, on_path) << "\n";
  }
  if (const auto trap = range.trap(); trap && on_path && !range.free.empty())
    std::cout << "  trapped just above " << shown(*trap) << "\n";
}

ExitCode run_range(const RangeCommand& command) {
  if (command.inside == !command.path.empty()) throw Stop(kUsage, "give either --path or --inside");
  if (!command.inside && !command.position.empty()) throw Stop(kUsage, "--place belongs to --inside");
  if (are_solid(command.operands, command.input)) return run_solid_scale_range(command);
  std::vector<RationalPoint> path;
  if (!command.path.empty()) path = read_path(command.path);
  std::optional<RationalPoint> position;
  if (!command.position.empty()) position = read_position(command.position, "--place");
  const std::vector<Input> inputs = read_inputs(command.operands, command.input);
  const Region &part = inputs[0].region, &other = inputs[1].region;
  const InterruptGuard guard;
  std::optional<ProgressBar> bar(std::in_place);
  const Progress progress = bar->callback();
  const auto compute = [&] {
    if (!command.inside)
      return require_of(inputs, scale_range(part, std::span<const RationalPoint>(path), other, progress));
    return require_of(inputs,
                      position ? fit_range(part, other, *position, progress) : fit_range(part, other, progress));
  };
  const auto [range, timing] = timed(command.report.repeat, compute);
  bar.reset();
  if (command.report.json) print_json(range, timing, inputs);
  else print_text(range, !command.inside);
  if (!command.report.json) print_times(std::cout, timing);
  return range.free.empty() ? kNo : kDone;
}

}  // namespace

void add_scale_range(CLI::App& app, Action& action) {
  auto command = std::make_shared<RangeCommand>();
  CLI::App& verb = *app.add_subcommand("scale-range",
                                       "The exact scales at which a part passes obstacles along a path, or fits into a "
                                       "container; ends with 4 when there are none");
  add_operands(verb, {"PART", "the shape that scales"}, {"OTHER", "obstacles, or with --inside the container"},
               command->operands);
  verb.add_option("--path", command->path,
                  "The translations of the part: \"x,y x,y ...\", of solids \"x,y,z x,y,z ...\", each a number or a "
                  "fraction 1/3, or a planar file with one polyline")
      ->type_name("PATH");
  verb.add_flag("--inside", command->inside, "OTHER is a container, anywhere inside which the part may lie");
  verb.add_option("--place", command->position, "With --inside: only at this translation, numbers or fractions 1/3")
      ->type_name("x,y[,z]");
  add_report_options(verb, command->report, "Compute N times and report the median and minimum time");
  add_solid_input_options(verb, command->input, OperandKind::either);
  verb.footer(
      "Examples: dymsum scale-range part.wkt walls.wkt --path \"0,0 10,0 10,5\" --json\n"
      "          dymsum scale-range peg.off block.off --path \"0,0,9 0,0,-9\"");
  verb.callback([command, &action] { action = [command] { return run_range(*command); }; });
}

}  // namespace dymsum::cli
