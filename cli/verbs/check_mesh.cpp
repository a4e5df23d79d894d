// dymsum check mesh FILE
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <memory>
#include <optional>

#include "dymsum/mesh_check.h"
#include "dymsum/mesh_io.h"
#include "options.h"
#include "outputs.h"
#include "progress_bar.h"
#include "report.h"
#include "solid/solid_inputs.h"
#include "solid/tight_marks.h"
#include "verbs/commands.h"

namespace dymsum::cli {
namespace {

struct MeshCheckCommand {
  std::string file;
  MeshCheckOptions options;
  std::vector<std::string> outputs;
  ReportOptions report;
  InputOptions input;
};

std::map<std::string, std::size_t> counts_of(const MeshCheck& check) {
  std::map<std::string, std::size_t> counts;
  for (const Error& fault : check.faults) ++counts[std::string(name(fault.code))];
  return counts;
}

Json mesh_check_json(const MeshCheckCommand& command, const MeshData& mesh, const MeshCheck& check,
                     const Timing& timing) {
  Json faults = Json::array();
  for (const Error& fault : check.faults) {
    Json one = error_json(fault);
    one.erase("exit");
    faults.push_back(std::move(one));
  }
  Json json = report_head(
      "check-mesh",
      Json::array({{{"file", command.file}, {"vertices", mesh.vertices.size()}, {"faces", mesh.faces.size()}}}), 0,
      timing);
  json.update({{"valid", check.valid()},
               {"fault_count", check.count},
               {"crossings", check.crossings},
               {"open_edges", check.open_edges},
               {"shells", check.shells},
               {"volume", check.volume ? Json(check.volume->to_double()) : Json()},
               {"volume_exact", check.volume ? Json(check.volume->to_string()) : Json()},
               {"faults", std::move(faults)}});
  return json;
}

void print_mesh_check(const MeshCheckCommand& command, const MeshData& mesh, const MeshCheck& check) {
  constexpr std::size_t kShown = 20;
  std::cout << shown_file(command.file) << ": " << counted(mesh.vertices.size(), "vertex", "vertices") << ", "
            << counted(mesh.faces.size(), "face") << ", " << counted(check.shells, "shell");
  if (check.volume) std::cout << ", volume " << shown(Measure(check.volume->to_double()));
  std::cout << ": " << (check.valid() ? "right" : counted(check.count, "fault")) << "\n";
  for (std::size_t k = 0; k < std::min(kShown, check.faults.size()); ++k)
    std::cout << "  " << check.faults[k].to_string() << "\n";
  if (check.count > kShown) {
    std::cout << "  and " << check.count - kShown << " more";
    const char* before = ": of those listed with --json ";
    for (const auto& [code, count] : counts_of(check)) std::cout << std::exchange(before, ", ") << count << ' ' << code;
    std::cout << "\n";
  }
}

std::optional<Point3> position_of(const Error& fault) {
  const Evidence& at = fault.evidence;
  if (!at.x || !at.y || !at.z) return std::nullopt;
  return Point3{*at.x, *at.y, *at.z};
}

/// Faces that faults name red, and their positions.
std::string mesh_fault_picture(const MeshCheckCommand& command, const MeshData& mesh, const MeshCheck& check) {
  if (std::any_of(check.faults.begin(), check.faults.end(), [](const Error& fault) {
        return fault.code == ErrorCode::not_finite || (fault.code == ErrorCode::bad_index && fault.evidence.face);
      }))
    throw Stop(kBadInput, shown_file(command.file) + " cannot be drawn: it has vertices that are no positions");
  MeshData drawn{mesh.vertices, {}};
  std::vector<std::uint32_t> name(mesh.faces.size(), 0xffffffff);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    if (mesh.faces[f].size() < 3) continue;
    name[f] = static_cast<std::uint32_t>(drawn.faces.size());
    drawn.faces.push_back(mesh.faces[f]);
  }
  FaceColour wrong{{0.91, 0.64, 0.24}, {}};
  std::vector<Point3> at;
  for (const Error& fault : check.faults) {
    for (const auto& face : {fault.evidence.face, fault.evidence.other_face})
      if (face && name[static_cast<std::size_t>(*face)] != 0xffffffff)
        wrong.faces.push_back(name[static_cast<std::size_t>(*face)]);
    if (const std::optional<Point3> position = position_of(fault)) at.push_back(*position);
  }
  std::sort(wrong.faces.begin(), wrong.faces.end());
  wrong.faces.erase(std::unique(wrong.faces.begin(), wrong.faces.end()), wrong.faces.end());
  if (const std::optional<Error> error = picture_error(drawn)) throw Stop(kBadInput, *error);
  const MeshData marks = position_marks(drawn, at);
  GlbLook look;
  look.colours = {&wrong, 1};
  if (!at.empty()) look.marks = &marks;
  return format_glb(drawn, look);
}

ExitCode run_mesh_check(const MeshCheckCommand& command) {
  for (const std::string& file : command.outputs)
    if (!file.ends_with(".glb")) throw Stop(kUsage, "check-mesh writes pictures (.glb), not '" + file + "'");
  refuse_unused_format({command.file}, command.input);
  const MeshData mesh = require(read_mesh_data(command.file, command.input)).data;
  const InterruptGuard guard;
  const auto [check, timing] = timed(command.report.repeat, [&] { return check_mesh(mesh, command.options); });
  for (const std::string& file : command.outputs) write_text(file, mesh_fault_picture(command, mesh, check));
  if (command.report.json) {
    print_report(mesh_check_json(command, mesh, check, timing));
  } else {
    print_mesh_check(command, mesh, check);
    print_times(std::cout, timing);
  }
  return check.valid() ? kDone : kNo;
}

}  // namespace

void add_check_mesh(CLI::App& app, Action& action) {
  auto command = std::make_shared<MeshCheckCommand>();
  CLI::App& verb = *app.add_subcommand(
      "check-mesh",
      "Whether a mesh bounds a solid: closed, oriented, without crossings; every fault with its position");
  verb.add_option("FILE", command->file, "The mesh (.off .obj .stl .ply .glb .3mf), or - for standard input")
      ->required()
      ->type_name("");
  whole_within(verb.add_option("--faults", command->options.listed, "How many faults are listed; all are counted"), 0,
               1000000000)
      ->type_name("N")
      ->capture_default_str();
  verb.add_option("-o", command->outputs, "A picture with the faults marked (.glb); repeatable")
      ->type_name("FILE")
      ->allow_extra_args(false);
  add_report_options(verb, command->report, "Check N times and report the median and minimum time");
  add_from_option(verb, command->input, OperandKind::solid);
  verb.footer(
      "Exit 0: right; 4: wrong. Nothing is repaired: convert --repair does.\n"
      "Example: dymsum check mesh part.stl -o faults.glb");
  verb.callback([command, &action] { action = [command] { return run_mesh_check(*command); }; });
}

}  // namespace dymsum::cli
