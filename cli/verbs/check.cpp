// dymsum check LAYOUT
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>

#include "dymsum/layout_check.h"
#include "dymsum/names.h"
#include "inputs.h"
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
  LayoutReadOptions read;
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
  const std::string &given = layout.parts[part].name, index = "part " + std::to_string(part);
  return given.empty() ? index : index + " (" + given + ")";
}

Json fault_json(const LayoutFault& fault) {
  const bool alone = fault.other == LayoutFault::kContainer, fits = std::isfinite(fault.distance);
  return {{"kind", name(fault.kind)},
          {"part", fault.part},
          {"other", alone ? Json() : Json(fault.other)},
          {"distance", !fault.measured ? Json()
                       : fits          ? Json(fault.distance)
                                       : Json("inf")},
          {"at_most", fits ? Json(fault.at_most) : Json("inf")},
          {"squared_exact", fits && fault.measured ? Json(fault.squared.to_string()) : Json()},
          {"move", fault.measured ? Json{fault.move.x.to_double(), fault.move.y.to_double()} : Json()},
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
  if (!fault.measured) std::cout << "no more than ";
  std::cout << fault.at_most << ", near (" << fault.at.x << ", " << fault.at.y << ")\n";
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
    if (const auto rough = std::count_if(check.faults.begin(), check.faults.end(),
                                         [](const LayoutFault& fault) { return !fault.measured; });
        rough > 0)
      std::cout << "  " << rough << " of the overlaps are no deeper than those measured (--faults)\n";
  }
}

template <class T>
T required(Result<T> result) {
  if (!result) throw Stop(kBadInput, result.error());
  return std::move(result).value();
}

/// FILE.svg, of several layouts FILE_0.svg, FILE_1.svg and so on.
void write_layout_pictures(const CheckCommand& command, const Checked& all) {
  for (const std::string& file : command.outputs)
    for (std::size_t k = 0; k < all.layouts.size(); ++k) {
      const std::string stem = file.substr(0, file.size() - std::string(".svg").size());
      const std::string name = all.layouts.size() == 1 ? file : stem + "_" + std::to_string(k) + ".svg";
      write_text(name, layout_picture(all.layouts[k], all.checks[k]));
    }
}

/// Without a container nothing sticks out: that is said, and a margin from it refused.
void check_layout_container(const CheckCommand& command, const Layout& layout) {
  if (layout.container) return;
  if (command.distances.margin > 0)
    throw Stop(kBadInput, shown_file(command.file) + ": --margin wants a container, and there is none");
  std::cerr << shown_file(command.file) << ": no container: whether parts stick out is not checked\n";
}

ExitCode run_layout_check(const CheckCommand& command) {
  for (const std::string& file : command.outputs)
    if (!file.ends_with(".svg")) throw Stop(kUsage, "check writes pictures (.svg), not '" + file + "'");
  if (!command.read.container.empty() && command.file.find(".json") != std::string::npos)
    throw Stop(kUsage, "--container is for drawings (.dxf, .svg): the file says what the container is");
  Checked all{required(read_layouts(command.file, command.read)), {}};
  if (!all.layouts.empty())
    for (const std::string& note : all.layouts[0].notes) std::cerr << shown_file(command.file) << ": " << note << "\n";
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
  verb.add_option(
          "LAYOUT", command->file,
          "A solution as jagua-rs and sparrow write it, with its instance (.json); a drawing of the parts where "
          "they stand: .dxf, or .svg as SVGnest writes it")
      ->required();
  verb.add_option("--container", command->read.container,
                  "Of drawings: largest (the largest shape; of SVG elements of the class bin, where there are some, if "
                  "not given), none, or the layer (DXF) or the id (SVG) that it has")
      ->type_name("WHICH");
  verb.add_flag("--repair", command->read.repair,
                "JSON: repair shapes, as rings that run clockwise, and say on standard error what changed");
  within(verb.add_option("--spacing", command->distances.spacing, "The required distance of two parts"), 0)
      ->type_name("D");
  within(verb.add_option("--margin", command->distances.margin, "The required distance from the container's outside"),
         0)
      ->type_name("D");
  whole_within(verb.add_option("--faults", command->distances.measured,
                               "Of how many overlaps the depth is measured: the deepest ones; others are listed with a "
                               "bound"),
               0, 1000000000)
      ->type_name("N")
      ->capture_default_str();
  verb.add_option("-o", command->outputs,
                  "A picture with the faults marked (.svg), of several bins one for each: FILE_0.svg and so "
                  "on; repeatable")
      ->type_name("FILE")
      ->allow_extra_args(false);
  add_report_options(verb, command->report, "Check N times and report the median and minimum time");
  verb.footer("Example: dymsum check layout.json --spacing 2 -o faults.svg\nExit 0: right; 4: wrong.");
  verb.callback([command, &action] { action = [command] { return run_layout_check(*command); }; });
}

}  // namespace dymsum::cli
