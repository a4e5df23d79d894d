#include "solid/solid_convert.h"

#include <iostream>

#include "exit_code.h"
#include "options.h"
#include "outputs.h"
#include "planar/tier.h"
#include "progress_bar.h"
#include "report.h"
#include "solid/solid_inputs.h"
#include "solid/solid_outputs.h"
#include "solid/solid_results.h"
#include "timing.h"
#include "viewer/viewer_pages.h"

namespace dymsum::cli {
namespace {

/// What a page calls the solid: a hull is another one than what was read.
std::string result_name(const SolidConvert& command) {
  return (command.verb == "hull" ? "hull of " : "") + shape_name(command.in) + ".off";
}

/// An exact result, or a solid by its planes.
SolidInput exact_input(const SolidConvert& command) {
  SolidInput input{command.in, Mesh()};
  if (holds_solid_result(command.in, command.input)) {
    input.result = read_solid_result(command.in, command.input);
  } else {
    input = std::move(read_by_planes({command.in}, command.input)[0]);
    input.result = input.by_planes;
  }
  input.fractions = true;
  return input;
}

/// Written as the verb writes it that it is the result of.
ExitCode convert_result(const SolidConvert& command) {
  if (command.verb != "convert")
    throw Stop(kUsage, command.verb + " is for coordinates in doubles, as dymsum convert writes them, and " +
                           shown_file(command.in) + " holds an exact result");
  if (command.canonical) refuse_options(*command.parser, {"--canonical"}, "is what an exact result is anyway");
  std::vector<std::string> files{command.out};
  const SolidOutput how{command.to, false, command.triangulate};
  const ResultPages pages(*command.parser, files);
  check_solid_outputs(files, how, ".html (the viewer), ");
  const auto [input, timing] = timed(1, [&] { return exact_input(command); });
  const SpatialSum& sum = *input.result;
  if (pages.any() && sum.faces.empty()) pages.stop_with_nothing_to_show();
  const InterruptGuard guard;
  Json rounding;
  for (const std::string& file : files) {
    const WrittenSolid written = written_solid(sum, file, how);
    write_text(file, written.text);
    rounding = written.rounding;
  }
  if (pages.any()) pages.write({result_name(command), solid_output(sum, pages.file(), {})});
  if (!command.json) return kDone;
  Json report = report_head(command.verb, solid_inputs_json({input}), 0, timing);
  report.update({{"output", command.out},
                 {"shells", sum.shells},
                 {"vertices", sum.vertices.size()},
                 {"faces", sum.faces.size()}});
  if (!rounding.is_null()) report["rounding"] = std::move(rounding);
  print_report(report);
  return kDone;
}

}  // namespace

ExitCode run_solid_convert(const SolidConvert& command) {
  if (holds_solid_result(command.in, command.input) || !command.input.planes.empty()) return convert_result(command);
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
