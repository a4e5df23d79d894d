// dymsum decompose P
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dymsum/decomposition.h"
#include "dymsum/region_io.h"
#include "inputs.h"
#include "pictures/shape_pictures.h"
#include "planar/tier.h"
#include "progress_bar.h"
#include "record_json.h"
#include "timing.h"
#include "verbs/commands.h"
#include "verbs/features_command.h"
#include "viewer/viewer_pages.h"

namespace dymsum::cli {
namespace {

/// Pieces of doubles, a line each. Where rounding changes one, a Stop that names the file, or the repair and a note.
std::string rounded_text(const std::string& file, const Decomposition& made, bool with_repair) {
  std::vector<Region> pieces;
  if (with_repair) {
    std::vector<Repaired> repaired = require(rounded_with_repair(made));
    for (std::size_t i = 0; i < repaired.size(); ++i) {
      if (repaired[i].report.changed())
        std::cerr << file << ": rounding of piece " << i << ": " << repaired[i].report.to_string() << "\n";
      pieces.push_back(std::move(repaired[i].region));
    }
  } else {
    Result<std::vector<Region>> plain = rounded(made);
    if (!plain)
      throw Stop(
          kBadInput,
          file + ": " + plain.error().to_string() + " (--round-repair merges what collides; .json keeps it exact)",
          plain.error());
    pieces = std::move(plain).value();
  }
  std::string text;
  for (const Region& piece : pieces)
    if (!piece.empty()) text += format_region(piece, RegionFormat::wkt);
  return text;
}

void write_pieces(const FeaturesCommand& command, const Region& region, const Decomposition& made) {
  std::vector<std::string> texts;
  for (const std::string& file : command.output.files) {
    const RegionFormat format = output_format(file, command.output);
    if (format == RegionFormat::svg) texts.push_back(decomposition_picture(region, made));
    else if (format == RegionFormat::json) texts.push_back(json_of(made).dump() + "\n");
    else texts.push_back(rounded_text(file, made, command.output.round_repair));
  }
  throw_if_interrupted();
  for (std::size_t i = 0; i < texts.size(); ++i) write_text(command.output.files[i], texts[i]);
}

void check_decompose(const FeaturesCommand& command) {
  bool rounds = false;
  for (const std::string& file : command.output.files) {
    const RegionFormat f = output_format(file, command.output);
    if (f != RegionFormat::svg && f != RegionFormat::wkt && f != RegionFormat::json)
      throw Stop(kUsage, "-o writes .wkt (a polygon per line), .json (exact) and .svg: " + file);
    rounds = rounds || f == RegionFormat::wkt;
  }
  if (!rounds) refuse_options(*command.parser, {"--round-repair"}, "belongs to -o FILE.wkt");
}

ExitCode run_decompose(const FeaturesCommand& command) {
  const Selection selection = selection_of(command);
  std::ostream& out = report_stream(command.output.files, command.report.json);
  refuse_unused_format({command.operand}, command.input);
  check_decompose(command);
  const std::vector<Input> inputs{read_input(command.operand, command.input)};
  const InterruptGuard guard;
  std::optional<ProgressBar> bar(std::in_place);
  const DecomposeOptions options{selection.life, selection.from, selection.to, bar->callback()};
  const auto [made, timing] = timed(command.report.repeat, [&] {
    throw_if_interrupted();
    const ShapeFeatures features =
        require_of(inputs, ShapeFeatures::create(inputs[0].region, options_of(command, bar->callback())));
    return require_of(inputs, decompose(features, options));
  });
  bar.reset();
  write_pieces(command, inputs[0].region, made);
  if (!command.report.json) {
    out << counted(made.cuts.size(), "cut") << ", " << counted(made.pieces.size(), "piece") << "\n";
    print_times(out, timing);
    return kDone;
  }
  Json json = report_head("decompose", inputs_json(inputs), tier_of(inputs[0].region), timing);
  json.update(json_of(made));
  print_report(json);
  return kDone;
}

}  // namespace

void add_decompose(CLI::App& app, Action& action) {
  auto command = std::make_shared<FeaturesCommand>();
  CLI::App& verb = *app.add_subcommand("decompose", "Cuts a region into nearly convex pieces at its lasting pockets");
  command->parser = &verb;
  add_shared_options(verb, *command,
                     "Cut at what is at least this significant: lasts so long, in diameters, and is so deep");
  verb.add_option("-o", command->output.files,
                  "Pieces .wkt, a polygon per line, rounded; .json, exact; a picture .svg; or .html, the viewer; may "
                  "be given several times")
      ->type_name("FILE");
  verb.add_flag("--round-repair", command->output.round_repair,
                "Where rounding makes a piece of -o FILE.wkt no polygon, merge what collides instead of refusing");
  verb.footer("Example: dymsum decompose beetle.poly --repair --tau 10 -o pieces.wkt -o pieces.svg");
  verb.callback([command, &action] {
    action = [command] {
      return run_with_pages({command->parser, "discs", ""}, {command->operand}, command->input, command->output.files,
                            [command] { return run_decompose(*command); });
    };
  });
}

}  // namespace dymsum::cli
