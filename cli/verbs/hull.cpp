// dymsum hull IN OUT
#include <CLI/CLI.hpp>
#include <memory>

#include "inputs.h"
#include "options.h"
#include "outputs.h"
#include "solid/solid_convert.h"
#include "verbs/commands.h"

namespace dymsum::cli {
namespace {

ExitCode run(const SolidConvert& command) {
  report_stream({command.out}, command.json);
  refuse_unused_format({command.in}, command.input);
  if (command.out != "-") refuse_options(*command.parser, {"--to"}, "is the format of the output -");
  return run_solid_convert(command);
}

}  // namespace

void add_hull(CLI::App& app, Action& action) {
  auto command = std::make_shared<SolidConvert>();
  command->verb = "hull";
  command->to = "off";
  command->input.hull = true;
  CLI::App& verb =
      *app.add_subcommand("hull", "The exact convex hull of a mesh or of points, and how far the surface was from it");
  command->parser = &verb;
  verb.add_option("IN", command->in,
                  "File .off .obj .stl .ply .glb .3mf, or - for standard input; faces need not fit together, or be "
                  "there at all")
      ->required();
  verb.add_option("OUT", command->out,
                  "File .off .obj .stl .ply .glb .3mf, .html (the viewer), or - for standard output")
      ->required();
  verb.add_option("--to", command->to, "Format of the output -")
      ->check(CLI::IsMember({"off", "obj", "stl", "ply", "glb", "3mf"}))
      ->capture_default_str();
  add_from_option(verb, command->input, OperandKind::solid);
  verb.add_flag("--triangulate", command->triangulate, "Split faces into triangles, for programs that take no others");
  verb.add_flag("--json", command->json, "Print one JSON object with the deviation");
  verb.footer("Example: dymsum hull scanned.stl convex.off --json");
  verb.callback([command, &action] { action = [command] { return run(*command); }; });
}

}  // namespace dymsum::cli
