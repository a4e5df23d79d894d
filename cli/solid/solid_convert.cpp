#include "solid/solid_convert.h"

#include <iostream>

#include "outputs.h"
#include "planar/tier.h"
#include "progress_bar.h"
#include "report.h"
#include "solid/solid_inputs.h"
#include "solid/solid_outputs.h"
#include "timing.h"
#include "viewer/viewer_pages.h"

namespace dymsum::cli {
namespace {

/// What a page calls the solid: a hull is another one than what was read.
std::string result_name(const SolidConvert& command) {
  return (command.verb == "hull" ? "hull of " : "") + shape_name(command.in) + ".off";
}

}  // namespace

ExitCode run_solid_convert(const SolidConvert& command) {
  std::vector<std::string> files{command.out};
  const ResultPages pages(*command.parser, files);
  for (const std::string& file : files) mesh_output_format(file, command.to);  // before anything is read
  auto [input, timing] = timed(1, [&] { return read_solid(command.in, command.input); });
  if (command.canonical) input.mesh = input.mesh.canonical();
  if (command.triangulate) input.mesh = triangulated(input.mesh).mesh;
  if (pages.any() && input.mesh.empty()) pages.stop_with_nothing_to_show();
  const InterruptGuard guard;
  for (const std::string& file : files)
    write_text(file, mesh_text(input.mesh, mesh_output_format(file, command.to), file));
  if (pages.any()) pages.write({result_name(command), mesh_text(input.mesh, MeshFormat::off, command.out)});
  if (!command.json) return kDone;
  Json report = report_head(command.verb, solid_inputs_json({input}), tier_of(input.mesh), timing);
  report.update({{"output", command.out},
                 {"shells", input.mesh.shell_count()},
                 {"vertices", input.mesh.vertices().size()},
                 {"faces", input.mesh.faces().size()}});
  print_report(report);
  return kDone;
}

}  // namespace dymsum::cli
