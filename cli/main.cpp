// dymsum VERB INPUTS [options]
#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

#include "commands.h"
#include "exit_code.h"

namespace {

using namespace dymsum::cli;

constexpr const char* kFooter =
    "Files: planar .poly .wkt .geojson .svg .json (nesting instances); FILE#NAME selects one shape of several; - is standard\n"
    "input or output; solid .off .obj .stl .ply, written also as .glb. Results go to standard output, messages to standard error.\n"
    "Exit: 0 done, 1 wrong usage, 2 bad input, 3 a defect of dymsum, 4 the answer is no, 130 interrupted.\n"
    "Example: dymsum sum gear.poly disc.wkt --json -o sum.svg -o stages.svg";

ExitCode run(int argc, char** argv) {
  CLI::App app("dymsum: exact Minkowski sums of planar regions and convex solids, and of both in motion", "dymsum");
  app.require_subcommand(1);
  app.set_version_flag("--version", DYMSUM_VERSION);
  app.footer(kFooter);
  Action action;
  add_sum(app, action);
  add_nfp(app, action);
  add_erode(app, action);
  add_scale(app, action);
  add_scale_range(app, action);
  add_rotate(app, action);
  add_slice(app, action);
  add_cspace(app, action);
  add_clearance(app, action);
  add_path(app, action);
  add_depth(app, action);
  add_info(app, action);
  add_convert(app, action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kUsage;
  }
  return action();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const ExitCode code = run(argc, argv);
    if (!std::cout.flush()) throw Stop(kBadInput, "cannot write to standard output");
    return code;
  } catch (const Stop& stop) {
    std::cout.flush();
    std::cerr << (stop.code() == kBadInput ? "" : "dymsum: ") << stop.what() << "\n";
    return stop.code();
  } catch (const std::exception& error) {
    std::cerr << "dymsum: this is a defect of dymsum: " << error.what() << "\n";
    return kDefect;
  }
}
