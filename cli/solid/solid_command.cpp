#include "solid/solid_command.h"

#include <CLI/CLI.hpp>

#include "options.h"
#include "outputs.h"

namespace dymsum::cli {

void add_solid_options(CLI::App& verb, SolidCommand& command) {
  command.parser = &verb;
  verb.add_option("-o", command.files,
                  "Write the result; repeatable; by extension .off .obj .stl .ply .glb (rounded), .json (exact, with "
                  "provenance); - is standard output")
      ->type_name("FILE")
      ->allow_extra_args(false);
  verb.add_option("--to", command.to, "Format of -o -")
      ->check(CLI::IsMember({"off", "obj", "stl", "ply", "glb", "json"}))
      ->capture_default_str();
  verb.add_option("--engine", command.engine, "How the boundary is found; both give the same result")
      ->check(CLI::IsMember({"fast", "brute"}))
      ->capture_default_str();
  add_report_options(verb, command.report, "Compute N times and report the median and minimum time");
  add_exact_option(verb, command.report);
  add_solid_input_options(verb, command.input);
}

SolidRun read_solid_run(const std::string& verb, const SolidCommand& command) {
  if (!writes_to_stdout(command.files)) refuse_options(*command.parser, {"--to"}, "is the format of -o -");
  report_stream(command.files, command.report.json);
  const SolidOutput how{command.to, false, false};
  check_solid_outputs(command.files, how);
  if (!are_solid(command.operands, command.input)) throw Stop(kUsage, verb + " is for solids");
  return {verb, command.engine, read_solids(command.operands, command.input), command.report, command.files, how, true};
}

}  // namespace dymsum::cli
