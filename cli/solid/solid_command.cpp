#include "solid/solid_command.h"

#include <CLI/CLI.hpp>
#include <utility>

#include "options.h"
#include "outputs.h"
#include "solid/solid_limits.h"

namespace dymsum::cli {

void add_solid_options(CLI::App& verb, SolidCommand& command, OperandKind kind) {
  command.parser = &verb;
  const bool planar = kind == OperandKind::either;
  verb.add_option(
          "-o", command.files,
          std::string("Write the result; repeatable; by extension .off .obj .stl .ply .3mf (rounded), .glb (picture), "
                      ".json (exact, with provenance), .html (the viewer with the result)") +
              (planar ? "; of regions .wkt .poly .geojson .dxf .gpkg (rounded), .svg (picture), .json" : "") +
              "; - is standard output")
      ->type_name("FILE")
      ->allow_extra_args(false);
  std::vector<std::string> formats{"off", "obj", "stl", "ply", "3mf", "glb", "json"};
  if (planar) formats.insert(formats.end(), {"wkt", "poly", "geojson", "svg", "dxf", "gpkg"});
  verb.add_option("--to", command.to, planar ? "Format of -o -; of regions wkt if not given" : "Format of -o -")
      ->check(CLI::IsMember(formats))
      ->capture_default_str();
  one_of<SpatialEngine>(
      verb.add_option("--engine", command.engine, "How the boundary is found; both give the same result"))
      ->capture_default_str();
  one_of<Semantics>(
      verb.add_option(
          "--semantics", command.semantics,
          "closed; open: touching is allowed, and where it is tight is listed; regular: the closure of the interior"))
      ->capture_default_str();
  add_round_option(verb, command.round, kind);
  add_report_options(verb, command.report, "Compute N times and report the median and minimum time");
  add_exact_option(verb, command.report, kind);
  add_memory_option(verb, command.memory_mb, kind);
  add_solid_input_options(verb, command.input, kind);
}

SolidRun read_solid_run(const std::string& verb, const SolidCommand& command) {
  if (!writes_to_stdout(command.files)) refuse_options(*command.parser, {"--to"}, "is the format of -o -");
  report_stream(command.files, command.report.json);
  std::vector<std::string> files = command.files;
  ResultPages pages(*command.parser, files);
  const SolidOutput how{command.to, false, false, command.round};
  check_solid_outputs(files, how, ".html (the viewer), ");
  require_solid(verb, command.operands, command.input);
  SolidRun run{verb,
               command.engine,
               read_solids_and_results(command.operands, command.input),
               command.report,
               std::move(files),
               how,
               true};
  run.semantics = command.semantics;
  run.memory_mb = command.memory_mb;
  run.pages = std::move(pages);
  return run;
}

}  // namespace dymsum::cli
