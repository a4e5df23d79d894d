#include "solid/solid_scale_range.h"

#include <iostream>
#include <optional>
#include <span>
#include <sstream>

#include "dymsum/solid_scale_range.h"
#include "exact_number.h"
#include "json_report.h"
#include "numbers.h"
#include "progress_bar.h"
#include "report.h"
#include "solid/solid_operands.h"
#include "solid/solid_outputs.h"
#include "timing.h"

namespace dymsum::cli {
namespace {

std::vector<RationalPoint3> positions_in(const std::string& text, const std::string& option) {
  std::vector<RationalPoint3> positions;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::optional<RationalPoint3> at = exact_position_in_space(word);
    if (!at) throw Stop(kUsage, option + " wants x,y,z, each a number or a fraction 1/3, not '" + word + "'");
    positions.push_back(*at);
  }
  return positions;
}

Json feature_json(const SolidFeature& f) {
  if (f.kind == SolidFeature::Kind::vertex) return {{"vertex", f.a}};
  if (f.kind == SolidFeature::Kind::face) return {{"face", f.a}};
  return {{"edge", {f.a, f.b}}};
}
std::string feature_text(const SolidFeature& f) {
  if (f.kind == SolidFeature::Kind::vertex) return "vertex " + std::to_string(f.a);
  if (f.kind == SolidFeature::Kind::face) return "face " + std::to_string(f.a);
  return "edge " + std::to_string(f.a) + "-" + std::to_string(f.b);
}

Json contacts_json(const std::vector<SolidScaleContact>& contacts) {
  Json list = Json::array();
  for (const SolidScaleContact& c : contacts)
    list.push_back({{"part", feature_json(c.part)},
                    {"obstacle", feature_json(c.obstacle)},
                    {"leg", c.leg},
                    {"along", c.along.to_string()},
                    {"at", {c.at.x.to_string(), c.at.y.to_string(), c.at.z.to_string()}}});
  return list;
}

void print_range_json(const SolidScaleRange& range, const Timing& timing, const std::vector<SolidInput>& inputs) {
  Json free = Json::array();
  for (const SolidScaleInterval& i : range.free)
    free.push_back({{"low", i.low ? Json(i.low->to_string()) : Json(nullptr)},
                    {"high", i.high ? Json(i.high->to_string()) : Json(nullptr)},
                    {"at_low", contacts_json(i.at_low)},
                    {"at_high", contacts_json(i.at_high)}});
  const auto trap = range.trap();
  Json json = report_head("scale-range", solid_inputs_json(inputs), 0, timing);
  json.update({{"free", free},
               {"trap", trap ? Json(trap->to_string()) : Json(nullptr)},
               {"critical", range.critical},
               {"tested", range.tested}});
  print_report(json);
}

void print_contacts(const std::vector<SolidScaleContact>& contacts, const char* where, bool on_path) {
  for (const SolidScaleContact& c : contacts) {
    std::cout << "    " << where << ": " << feature_text(c.part) << " of the part on " << feature_text(c.obstacle);
    if (on_path) std::cout << ", leg " << c.leg << " at " << shown(c.along) << "\n";
    else std::cout << ", part at (" << shown(c.at.x) << ", " << shown(c.at.y) << ", " << shown(c.at.z) << ")\n";
  }
}

void print_range_text(const SolidScaleRange& range, bool on_path) {
  std::cout << (range.free.empty() ? "never free\n" : "free scales:\n");
  for (const SolidScaleInterval& i : range.free) {
    std::cout << "  " << (i.low ? "[" + shown(*i.low) : std::string("(0")) << ", "
              << (i.high ? shown(*i.high) + "]" : std::string("unbounded)")) << "\n";
    print_contacts(i.at_low, "below", on_path), print_contacts(i.at_high, "above", on_path);
  }
  if (const auto trap = range.trap(); trap && on_path && !range.free.empty())
    std::cout << "  trapped just above " << shown(*trap) << "\n";
}

}  // namespace

ExitCode run_solid_scale_range(const RangeCommand& command) {
  const std::vector<RationalPoint3> path = positions_in(command.path, "--path");
  const std::vector<RationalPoint3> position = positions_in(command.position, "--place");
  if (!command.inside && path.empty()) throw Stop(kUsage, "--path wants a waypoint: \"x,y,z x,y,z ...\"");
  if (position.size() > 1) throw Stop(kUsage, "--place wants one translation, x,y,z");
  const std::vector<SolidInput> inputs = read_solids(command.operands, command.input);
  const Mesh &part = inputs[0].mesh, &other = inputs[1].mesh;
  const InterruptGuard guard;
  std::optional<ProgressBar> bar(std::in_place);
  const Progress progress = bar->callback();
  const auto compute = [&] {
    Result<SolidScaleRange> range = !command.inside    ? solid_scale_range(part, std::span(path), other, progress)
                                    : position.empty() ? solid_fit_range(part, other, progress)
                                                       : solid_fit_range(part, other, position[0], progress);
    if (!range) stop_with(in_solid_operand(range.error(), inputs));
    return *std::move(range);
  };
  const auto [range, timing] = timed(command.report.repeat, compute);
  bar.reset();
  if (command.report.json) print_range_json(range, timing, inputs);
  else print_range_text(range, !command.inside), print_times(std::cout, timing);
  return range.free.empty() ? kNo : kDone;
}

}  // namespace dymsum::cli
