#include "solid/solid_convert.h"

#include <iostream>

#include "outputs.h"
#include "planar/tier.h"
#include "progress_bar.h"
#include "report.h"
#include "solid/solid_inputs.h"
#include "solid/solid_outputs.h"
#include "timing.h"

namespace dymsum::cli {

ExitCode run_solid_convert(const SolidConvert& command) {
  const MeshFormat format = mesh_output_format(command.out, command.to);
  auto [input, timing] = timed(1, [&] { return read_solid(command.in, command.input); });
  if (command.canonical) input.mesh = input.mesh.canonical();
  if (command.triangulate) input.mesh = triangulated(input.mesh).mesh;
  const InterruptGuard guard;
  write_text(command.out, mesh_text(input.mesh, format, command.out));
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
