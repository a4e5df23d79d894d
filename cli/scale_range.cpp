// dymsum scale-range PART OBSTACLES --path ... | PART CONTAINER --inside [--place x,y]
#include "dymsum/scale_range.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>

#include "commands.h"
#include "inputs.h"
#include "progress_bar.h"
#include "report.h"
#include "sum_command.h"
#include "timing.h"

namespace dymsum::cli {
namespace {

struct RangeCommand {
  std::vector<std::string> operands{"", ""};
  std::string path, place;
  bool inside = false, json = false;
  std::size_t repeat = 1;
  InputOptions input;
};

/// "x,y x,y ..." or a file with one polyline.
std::vector<Point> read_path(const std::string& text) {
  std::vector<Point> points;
  std::istringstream words(text);
  std::string word;
  while (words >> word) {
    std::istringstream pair(word);
    Point p;
    char comma = 0, rest = 0;
    if (!(pair >> p.x >> comma >> p.y) || comma != ',' || (pair >> rest)) {
      points.clear();
      break;
    }
    points.push_back(p);
  }
  if (!points.empty()) return points;
  const RegionData data = require(read_region_data(text));
  if (data.polylines.size() == 1 && data.parts.empty() && data.points.empty()) return data.polylines[0];
  if (data.points.size() == 1 && data.parts.empty() && data.polylines.empty()) return data.points;
  throw Stop(kBadInput, text + ": a path is one polyline or one point");
}

Json contact_json(const ScaleContact& c) {
  const char* kind = c.kind == ScaleContact::Kind::vertex_on_edge ? "vertex_on_edge" : c.kind == ScaleContact::Kind::edge_on_vertex ? "edge_on_vertex" : "vertex_on_vertex";
  return {{"kind", kind}, {"part", c.part}, {"obstacle", c.obstacle}, {"leg", c.leg}, {"along", c.along.to_string()},
          {"at", {c.at.x.to_string(), c.at.y.to_string()}}};
}

std::string contact_text(const ScaleContact& c) {
  const std::string part = std::to_string(c.part), obstacle = std::to_string(c.obstacle);
  std::string text = c.kind == ScaleContact::Kind::vertex_on_edge   ? "vertex " + part + " of the part on edge " + obstacle
                     : c.kind == ScaleContact::Kind::edge_on_vertex ? "edge " + part + " of the part on vertex " + obstacle
                                                                    : "vertex " + part + " of the part on vertex " + obstacle;
  return text + ", leg " + std::to_string(c.leg) + " at " + c.along.to_string();
}

ExitCode run_range(const RangeCommand& command) {
  if (command.inside == !command.path.empty()) throw Stop(kUsage, "give either --path or --inside");
  if (!command.inside && !command.place.empty()) throw Stop(kUsage, "--place belongs to --inside");
  std::vector<Point> path;
  if (!command.path.empty()) path = read_path(command.path);
  if (!command.place.empty()) path = read_path(command.place);
  const std::vector<Input> inputs = read_inputs(command.operands, command.input);
  const Region &part = inputs[0].region, &other = inputs[1].region;
  const InterruptGuard guard;
  std::optional<ProgressBar> bar(std::in_place);
  const Progress progress = bar->callback();
  const auto compute = [&] {
    if (!command.inside) return require(scale_range(part, path, other, progress));
    return require(path.empty() ? fit_range(part, other, progress) : fit_range(part, other, path[0], progress));
  };
  const auto [range, timing] = timed(command.repeat, compute);
  bar.reset();
  if (command.json) {
    Json free = Json::array();
    for (const ScaleInterval& i : range.free) {
      Json low = Json::array(), high = Json::array();
      for (const ScaleContact& c : i.at_low) low.push_back(contact_json(c));
      for (const ScaleContact& c : i.at_high) high.push_back(contact_json(c));
      free.push_back({{"low", i.low ? Json(i.low->to_string()) : Json(nullptr)},
                      {"high", i.high ? Json(i.high->to_string()) : Json(nullptr)},
                      {"at_low", low},
                      {"at_high", high}});
    }
    const auto trap = range.trap();
    const Json out = {{"inputs", inputs_json(inputs)},
                      {"time_ms", {{"median", timing.median_ms}, {"min", timing.min_ms}, {"stages", Json::object()}}},
                      {"free", free},
                      {"trap", trap ? Json(trap->to_string()) : Json(nullptr)},
                      {"critical", range.critical},
                      {"tested", range.tested}};
    std::cout << out.dump(2) << "\n";
  } else {
    std::cout << (range.free.empty() ? "never free\n" : "free scales:\n");
    for (const ScaleInterval& i : range.free) {
      std::cout << "  " << (i.low ? "[" + i.low->to_string() : std::string("(0")) << ", " << (i.high ? i.high->to_string() + "]" : std::string("unbounded)")) << "\n";
      for (const ScaleContact& c : i.at_low) std::cout << "    below: " << contact_text(c) << "\n";
      for (const ScaleContact& c : i.at_high) std::cout << "    above: " << contact_text(c) << "\n";
    }
    if (const auto trap = range.trap(); trap && !command.inside && !range.free.empty()) std::cout << "  trapped just above " << trap->to_string() << "\n";
  }
  return range.free.empty() ? kNo : kDone;
}

}  // namespace

void add_scale_range(CLI::App& app, Action& action) {
  auto command = std::make_shared<RangeCommand>();
  CLI::App& verb = *app.add_subcommand("scale-range", "The exact scales at which a part passes obstacles along a path, or fits into a container; ends with 4 when there are none");
  const char* const operand = "File, FILE#NAME for one shape of several, or - for standard input";
  verb.add_option("PART", command->operands[0], operand)->required();
  verb.add_option("OTHER", command->operands[1], operand)->required();
  verb.add_option("--path", command->path, "The translations of the part: \"x,y x,y ...\" or a file with one polyline")->type_name("PATH");
  verb.add_flag("--inside", command->inside, "OTHER is a container, anywhere inside which the part may lie");
  verb.add_option("--place", command->place, "With --inside: only at this translation")->type_name("x,y");
  verb.add_flag("--json", command->json, "Print one JSON object with the result's summary");
  verb.add_option("--repeat", command->repeat, "Compute N times and report the median and minimum time")
      ->type_name("N")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1000000}))
      ->capture_default_str();
  add_input_options(verb, command->input);
  verb.footer("Example: dymsum scale-range part.wkt walls.wkt --path \"0,0 10,0 10,5\" --json");
  verb.callback([command, &action] { action = [command] { return run_range(*command); }; });
}

}  // namespace dymsum::cli
