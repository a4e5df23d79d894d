// dymsum convert IN OUT
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "planar/tier.h"
#include "progress_bar.h"
#include "report.h"
#include "solid/solid_convert.h"
#include "solid/solid_inputs.h"
#include "verbs/commands.h"
#include "verbs/sum_command.h"
#include "viewer/viewer_pages.h"

namespace dymsum::cli {
namespace {

struct ConvertCommand {
  const CLI::App* parser = nullptr;  ///< which options were given
  std::string in, out;
  bool json = false, canonical = false, triangulate = false;
  InputOptions input;
  OutputOptions output;
};

/// An exact result as the verb writes it that it is the result of; a picture shows it alone.
std::string result_text(const Input& input, RegionFormat format) {
  if (format == RegionFormat::json) return sum_to_json(*input.result);
  if (format == RegionFormat::svg) return draw_section(*input.result);
  return format_sum(*input.result, input.region, format);
}

ExitCode run_regions(const ConvertCommand& command) {
  refuse_options(*command.parser, {"--triangulate"}, "is for solids");
  OutputOptions output = command.output;
  output.files = {command.out};
  const ResultPages pages(*command.parser, output.files);
  check_outputs(output);
  auto [input, timing] = timed(1, [&] { return read_operand(command.in, command.input); });
  if (command.canonical) input.region = input.region.canonical();
  if (pages.any() && input.region.empty()) pages.stop_with_nothing_to_show();
  const InterruptGuard guard;
  for (const std::string& file : output.files) {
    const RegionFormat format = output_format(file, output);
    write_text(file, input.result ? result_text(input, format) : format_region(input.region, format));
  }
  if (pages.any()) pages.write({shape_name(command.in) + ".wkt", format_region(input.region, RegionFormat::wkt)});
  if (!command.json) return kDone;
  Json report = report_head("convert", inputs_json({input}), tier_of(input.region), timing);
  report.update({{"output", command.out},
                 {"outer", input.region.parts().size()},
                 {"holes", input.region.hole_count()},
                 {"vertices", input.region.vertex_count()}});
  print_report(report);
  return kDone;
}

ExitCode run(const ConvertCommand& command) {
  report_stream({command.out}, command.json);
  refuse_unused_format({command.in}, command.input);
  refuse_unknown_extension(command.in);
  if (command.out != "-") refuse_options(*command.parser, {"--to"}, "is the format of the output -");
  if (!names_solid(command.in, command.input)) return run_regions(command);
  const std::string to = command.parser->count("--to") > 0 ? command.output.to : "off";
  return run_solid_convert({command.parser, "convert", command.in, command.out, to, command.json, command.canonical,
                            command.triangulate, command.input});
}

}  // namespace

void add_convert(CLI::App& app, Action& action) {
  auto command = std::make_shared<ConvertCommand>();
  CLI::App* verb =
      app.add_subcommand("convert", "Read a region or a solid and write it in another format, coordinates unchanged");
  command->parser = verb;
  verb->add_option("IN", command->in, "File, FILE#NAME for one shape of several, or - for standard input")->required();
  verb->add_option(
          "OUT", command->out,
          "File .poly .wkt .geojson .svg .json .dxf .gpkg, of solids .off .obj .stl .ply .glb .3mf, .html (the "
          "viewer), or - for "
          "standard output")
      ->required();
  one_of(verb->add_option("--to", command->output.to, "Format of the output -; of solids off if not given"),
         file_formats(OperandKind::either))
      ->capture_default_str();
  verb->add_flag("--canonical", command->canonical, "Write the canonical form: equal sets become equal files");
  verb->add_flag("--triangulate", command->triangulate,
                 "Solids: split faces into triangles, for programs that take no others");
  verb->add_flag("--json", command->json, "Print one JSON object that says what was converted");
  add_solid_input_options(*verb, command->input);
  add_lines_option(*verb, command->input);
  verb->footer(
      "Example: dymsum convert monkey.poly monkey.geojson --repair\n"
      "         dymsum convert plate.dxf plate.svg --curve-error 0.01 --join 0.001 --snap 2^-20\n"
      "         dymsum convert towns.gpkg#harbours harbours.geojson\n"
      "         dymsum convert part.stl part.3mf --repair=t-junctions,holes");
  verb->callback([command, &action] { action = [command] { return run(*command); }; });
}

}  // namespace dymsum::cli
