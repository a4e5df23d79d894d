// dymsum features P
#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>

#include "dymsum/growing_disc.h"
#include "dymsum/region_io.h"
#include "dymsum/shape_features.h"
#include "inputs.h"
#include "options.h"
#include "outputs.h"
#include "pictures/shape_pictures.h"
#include "planar/tier.h"
#include "progress_bar.h"
#include "report.h"
#include "timing.h"
#include "verbs/commands.h"
#include "verbs/features_command.h"
#include "viewer/viewer_pages.h"

namespace dymsum::cli {
namespace {

Json point_json(Point p) { return {p.x, p.y}; }
Json optional_json(const std::optional<std::uint32_t>& v) { return v ? Json(*v) : Json(nullptr); }

Json bar_json(const ShapeFeatures& features, std::uint32_t index, bool exact) {
  const FeatureBar& bar = features.bars()[index];
  Json json{{"bar", index},
            {"born", name(bar.born)},
            {"died", name(bar.died)},
            {"birth", bar.birth_alpha},
            {"death", bar.death ? Json(bar.death_alpha) : Json(nullptr)},
            {"birth_event", bar.birth},
            {"death_event", optional_json(bar.death)},
            {"parent", optional_json(bar.parent)},
            {"vertex", optional_json(bar.vertex)},
            {"minimum", optional_json(bar.minimum)},
            {"concavity", bar.concavity},
            {"counts_from", bar.counts_from},
            {"significance", std::isinf(bar.significance) ? Json(nullptr) : Json(bar.significance)},
            {"in_hole", bar.in_hole}};
  if (!exact) return json;
  json["birth_exact"] = features.event_text(bar.birth);
  json["death_exact"] = bar.death ? Json(features.event_text(*bar.death)) : Json(nullptr);
  return json;
}

Json bridge_json(const AlphaBridge& b) {
  const auto contact = [](const BridgeContact& c) {
    return Json{{"on", c.at_vertex ? "vertex" : "edge"}, {"index", c.index}, {"at", point_json(c.at)}};
  };
  return {{"from", contact(b.from)},
          {"to", contact(b.to)},
          {"centre", point_json(b.centre)},
          {"gap", b.gap},
          {"length", b.length},
          {"bar", b.bar},
          {"pocket", b.pocket_size},
          {"minimum", optional_json(b.minimum)},
          {"concavity", b.concavity}};
}

void print_bars(const ShapeFeatures& features, const std::vector<std::uint32_t>& kept,
                const std::vector<AlphaBridge>* bridges) {
  std::cout << counted(features.bars().size(), "bar") << ", " << counted(features.event_count(), "event") << ", "
            << kept.size() << " kept\n     birth      death  ends    minimum  concavity\n";
  for (const std::uint32_t i : kept) {
    const FeatureBar& bar = features.bars()[i];
    char line[160];
    std::snprintf(line, sizeof line, "%10.6g %10.6g  %-6s  %7s %10.6g\n", bar.birth_alpha, bar.death_alpha,
                  std::string(name(bar.died)).c_str(), bar.minimum ? std::to_string(*bar.minimum).c_str() : "gap",
                  bar.concavity);
    std::cout << line;
  }
  if (bridges != nullptr) std::cout << counted(bridges->size(), "bridge") << "\n";
}

void check_pictures(const FeaturesCommand& command) {
  for (const std::string& file : command.output.files)
    if (!file.ends_with(".svg")) throw Stop(kUsage, "-o writes .svg and .html: " + file);
}

void write_pictures(const FeaturesCommand& command, const ShapeFeatures& features, const std::vector<AlphaBridge>& at,
                    const std::vector<std::uint32_t>& kept) {
  if (command.output.files.empty()) return;
  Region sum;
  double alpha = 0;
  if (!command.alpha.empty()) {
    const Rational r = read_number(command.alpha, "--alpha") / Rational(2);
    alpha = 2 * r.to_double();
    const DiscSet set = require(GrowingDisc(features.region()).sum_at(r));
    if (alpha > 0) sum = require(to_region(set, alpha / 2000)).region;
  }
  const std::string picture = features_picture(features, sum, at, alpha, kept);
  for (const std::string& file : command.output.files) write_text(file, picture);
}

ExitCode run_features(const FeaturesCommand& command) {
  const Selection selection = selection_of(command);
  if (command.exact && !command.report.json) throw Stop(kUsage, "--exact is for --json");
  std::optional<Rational> alpha;
  if (!command.alpha.empty()) alpha = read_number(command.alpha, "--alpha");
  check_pictures(command);
  report_stream(command.output.files, command.report.json);
  refuse_unused_format({command.operand}, command.input);
  const std::vector<Input> inputs{read_input(command.operand, command.input)};
  const InterruptGuard guard;
  std::optional<ProgressBar> bar(std::in_place);
  const FeatureOptions options = options_of(command, bar->callback());
  const auto [features, timing] = timed(command.report.repeat, [&] {
    throw_if_interrupted();
    return require_of(inputs, ShapeFeatures::create(inputs[0].region, options));
  });
  const std::vector<std::uint32_t> kept = features.lasting(selection.life, selection.from, selection.to);
  std::vector<AlphaBridge> bridges;
  if (alpha) bridges = require_of(inputs, features.bridges(*alpha));
  write_pictures(command, features, bridges, kept);
  bar.reset();
  if (!command.report.json) {
    print_bars(features, kept, alpha ? &bridges : nullptr);
    print_times(std::cout, timing);
    return kDone;
  }
  Json json = report_head("features", inputs_json(inputs), tier_of(inputs[0].region), timing);
  Json bars = Json::array(), list = Json::array();
  for (const std::uint32_t i : kept) bars.push_back(bar_json(features, i, command.exact));
  for (const AlphaBridge& b : bridges) list.push_back(bridge_json(b));
  json.update({{"event_count", features.event_count()}, {"bar_count", features.bars().size()}, {"bars", bars}});
  json["bridges"] = alpha ? list : Json(nullptr);
  print_report(json);
  return kDone;
}

}  // namespace

void add_features(CLI::App& app, Action& action) {
  auto command = std::make_shared<FeaturesCommand>();
  CLI::App& verb = *app.add_subcommand("features", "What a growing disc sees: bridges, pockets and how long they last");
  command->parser = &verb;
  add_shared_options(verb, *command, "Keep what lasts at least this long, in diameters");
  verb.add_option("--alpha", command->alpha, "Also the bridges of the disc of this diameter")->type_name("A");
  verb.add_flag("--exact", command->exact, "With --json: births and deaths as formulas of roots, too");
  verb.add_option("-o", command->output.files, "A picture .svg, or .html, the viewer; repeatable")->type_name("FILE");
  verb.footer("Example: dymsum features beetle.poly --repair --alpha 20 --tau 10 -o beetle.svg --json");
  verb.callback([command, &action] {
    action = [command] {
      return run_with_pages({command->parser, "discs", ""}, {command->operand}, command->input, command->output.files,
                            [command] { return run_features(*command); });
    };
  });
}

}  // namespace dymsum::cli
