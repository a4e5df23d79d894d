// dymsum check LAYOUT
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>

#include "dymsum/layout_check.h"
#include "dymsum/names.h"
#include "options.h"
#include "outputs.h"
#include "pictures/layout_picture.h"
#include "progress_bar.h"
#include "report.h"
#include "verbs/commands.h"

namespace dymsum::cli {
namespace {

struct CheckCommand {
  std::string file;
  LayoutCheckOptions distances;
  std::vector<std::string> outputs;
  ReportOptions report;
};

/// The layouts of a file and what is wrong with each.
struct Checked {
  std::vector<Layout> layouts;
  std::vector<LayoutCheck> checks;
};

bool valid(const std::vector<LayoutCheck>& checks) {
  return std::all_of(checks.begin(), checks.end(), [](const LayoutCheck& check) { return check.valid(); });
}

std::string part_name(const Layout& layout, std::uint32_t part) {
  return "part " + std::to_string(part) + " (" + layout.parts[part].name + ")";
}

Json fault_json(const LayoutFault& fault) {
  const bool alone = fault.other == LayoutFault::kContainer, fits = std::isfinite(fault.distance);
  return {{"kind", name(fault.kind)},
          {"part", fault.part},
          {"other", alone ? Json() : Json(fault.other)},
          {"distance", fits ? Json(fault.distance) : Json("inf")},
          {"squared_exact", fits ? Json(fault.squared.to_string()) : Json()},
          {"move", {fault.move.x.to_double(), fault.move.y.to_double()}},
          {"at", {fault.at.x, fault.at.y}}};
}

Json layouts_json(const CheckCommand& command, const Checked& all, const Timing& timing) {
  Json layouts = Json::array();
  for (std::size_t k = 0; k < all.layouts.size(); ++k) {
    const LayoutCheck& check = all.checks[k];
    Json faults = Json::array();
    for (const LayoutFault& fault : check.faults) faults.push_back(fault_json(fault));
    layouts.push_back({{"parts", all.layouts[k].parts.size()},
                       {"pairs", check.pairs},
                       {"container", all.layouts[k].container.has_value()},
                       {"density", check.density},
                       {"valid", check.valid()},
                       {"faults", std::move(faults)}});
  }
  Json json = report_head("check", Json::array({{{"file", command.file}}}), 0, timing);
  json.update({{"valid", valid(all.checks)}, {"layouts", std::move(layouts)}});
  return json;
}

void print_fault(const Layout& layout, const LayoutFault& fault) {
  const bool alone = fault.other == LayoutFault::kContainer;
  std::cout << "  " << part_name(layout, fault.part);
  switch (fault.kind) {
    case LayoutFault::Kind::overlap:
      std::cout << " overlaps " << part_name(layout, fault.other) << " by ";
      break;
    case LayoutFault::Kind::too_near:
      std::cout << " is too near to " << (alone ? "the outside" : part_name(layout, fault.other)) << ": ";
      break;
    case LayoutFault::Kind::outside:
      std::cout << " is outside the container by ";
      break;
  }
  std::cout << fault.distance << ", near (" << fault.at.x << ", " << fault.at.y << ")\n";
}

void print_text(const Checked& all) {
  constexpr std::size_t kShown = 20;
  for (std::size_t k = 0; k < all.layouts.size(); ++k) {
    const LayoutCheck& check = all.checks[k];
    std::cout << counted(all.layouts[k].parts.size(), "part") << ", density " << check.density << ": "
              << (check.valid() ? "right" : counted(check.faults.size(), "fault")) << "\n";
    for (std::size_t i = 0; i < std::min(kShown, check.faults.size()); ++i)
      print_fault(all.layouts[k], check.faults[i]);
    if (check.faults.size() > kShown) std::cout << "  and " << check.faults.size() - kShown << " more\n";
  }
}

template <class T>
T required(Result<T> result) {
  if (!result) throw Stop(kBadInput, result.error());
  return std::move(result).value();
}

void write_layout_pictures(const CheckCommand& command, const Checked& all) {
  for (const std::string& file : command.outputs) write_text(file, layout_picture(all.layouts[0], all.checks[0]));
}

/// Without a container nothing sticks out: that is said, and a margin from it refused.
void check_layout_container(const CheckCommand& command, const Layout& layout) {
  if (layout.container) return;
  if (command.distances.margin > 0)
    throw Stop(kBadInput,
               command.file + ": --margin wants a container, and the file has neither strip_height nor bins");
  std::cerr << command.file
            << ": no container (neither strip_height nor bins): whether parts stick out is not checked\n";
}

ExitCode run_layout_check(const CheckCommand& command) {
  for (const std::string& file : command.outputs)
    if (!file.ends_with(".svg")) throw Stop(kUsage, "check writes pictures (.svg), not '" + file + "'");
  Checked all{required(read_layouts(command.file)), {}};
  if (all.layouts.size() != 1 && !command.outputs.empty())
    throw Stop(kUsage, "-o draws one layout, and " + command.file + " has " + std::to_string(all.layouts.size()));
  for (const Layout& layout : all.layouts) check_layout_container(command, layout);
  ProgressBar bar;
  LayoutCheckOptions options = command.distances;
  options.progress = bar.callback();
  auto [checks, timing] = timed(command.report.repeat, [&] {
    std::vector<LayoutCheck> each;
    for (const Layout& layout : all.layouts) each.push_back(required(check_layout(layout, options)));
    return each;
  });
  all.checks = std::move(checks);
  write_layout_pictures(command, all);
  if (command.report.json) print_report(layouts_json(command, all, timing));
  else {
    print_text(all);
    print_times(std::cout, timing);
  }
  return valid(all.checks) ? kDone : kNo;
}

}  // namespace

void add_check(CLI::App& app, Action& action) {
  auto command = std::make_shared<CheckCommand>();
  CLI::App& verb = *app.add_subcommand(
      "check", "Whether a layout is right: parts that overlap, are too near or stick out, exactly, the worst first");
  verb.add_option("LAYOUT", command->file, "A solution as jagua-rs and sparrow write it, with its instance (.json)")
      ->required();
  within(verb.add_option("--spacing", command->distances.spacing, "The required distance of two parts"), 0)
      ->type_name("D");
  within(verb.add_option("--margin", command->distances.margin, "The required distance from the container's outside"),
         0)
      ->type_name("D");
  verb.add_option("-o", command->outputs, "A picture with the faults marked (.svg); repeatable")
      ->type_name("FILE")
      ->allow_extra_args(false);
  add_report_options(verb, command->report, "Check N times and report the median and minimum time");
  verb.footer("Example: dymsum check layout.json --spacing 2 -o faults.svg\nExit 0: right; 4: wrong.");
  verb.callback([command, &action] { action = [command] { return run_layout_check(*command); }; });
}

}  // namespace dymsum::cli
