#include "solid/solid_info.h"

#include <algorithm>
#include <array>
#include <iostream>
#include <optional>

#include "outputs.h"
#include "planar/tier.h"
#include "progress_bar.h"
#include "report.h"
#include "solid/solid_inputs.h"
#include "solid/solid_outputs.h"
#include "solid/solid_results.h"
#include "timing.h"

namespace dymsum::cli {
namespace {

Json info_json(const SolidInput& input, const std::optional<Error>& not_convex, const Timing& timing) {
  const Mesh& mesh = input.mesh;
  Json json = report_head("info", solid_inputs_json({input}), tier_of(mesh), timing);
  json.update({{"valid", true},
               {"shells", mesh.shell_count()},
               {"vertices", mesh.vertices().size()},
               {"edges", mesh.edge_count()},
               {"faces", mesh.faces().size()},
               {"triangles", mesh.triangle_count()},
               {"convex", !not_convex.has_value()}});
  if (not_convex) json["not_convex"] = not_convex->to_string();
  json.update({{"volume", measure_json(volume_of(mesh))},
               {"area", measure_json(surface_of(mesh))},
               {"bounds", mesh.empty() ? Json(nullptr) : Json(bounds(mesh))},
               {"bits", grid_bits(mesh)}});
  return json;
}

/// A file that can be read and holds no valid solid.
Json invalid_json(const Error& error, const Timing& timing) {
  Json json = report_head("info", Json::array(), 0, timing);
  json.update({{"valid", false}, {"error", error_json(error)}});
  return json;
}

void print_info(const SolidInput& input, const std::optional<Error>& not_convex) {
  const Mesh& mesh = input.mesh;
  const std::array<double, 6> box = bounds(mesh);
  const auto precision = std::cout.precision(17);
  std::cout << "valid, " << counted(mesh.shell_count(), "shell") << ", "
            << counted(mesh.vertices().size(), "vertex", "vertices") << ", " << counted(mesh.edge_count(), "edge")
            << ", " << counted(mesh.faces().size(), "face") << "\n  "
            << (not_convex ? "not convex: " + not_convex->to_string() : std::string("convex")) << "\n  bounds ["
            << box[0] << ", " << box[3] << "] x [" << box[1] << ", " << box[4] << "] x [" << box[2] << ", " << box[5]
            << "]";
  print_notes(std::cout, input.notes);
  std::cout << "\n  volume " << shown(volume_of(mesh)) << ", surface " << shown(surface_of(mesh)) << "\n  "
            << counted(static_cast<std::size_t>(grid_bits(mesh)), "bit") << " per coordinate, "
            << tier_name(tier_of(mesh)) << " integers\n";
  std::cout.precision(precision);
}

/// The positions of an exact result, at the nearest doubles.
Json bounds_json(const SpatialSum& sum) {
  if (sum.vertices.empty()) return nullptr;
  std::array<double, 6> box{};
  for (std::size_t v = 0; v < sum.vertices.size(); ++v) {
    const RationalPoint3 at = sum.exact(v);
    const std::array<double, 3> c{at.x.to_double(), at.y.to_double(), at.z.to_double()};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box[axis] = v == 0 ? c[axis] : std::min(box[axis], c[axis]);
      box[axis + 3] = v == 0 ? c[axis] : std::max(box[axis + 3], c[axis]);
    }
  }
  return box;
}

void print_result(const SpatialSum& sum) {
  std::cout << "valid, an exact result: " << counted(sum.shells, "shell") << ", "
            << counted(sum.vertices.size(), "vertex", "vertices") << ", " << counted(sum.edges().size(), "edge") << ", "
            << counted(sum.faces.size(), "face") << "\n  tight: " << counted(sum.tight_faces.size(), "face") << ", "
            << counted(sum.tight_segments.size(), "segment") << ", " << counted(sum.tight_points.size(), "point")
            << "\n  volume " << shown(volume_of(sum)) << ", surface " << shown(surface_of(sum)) << "\n";
}

/// An exact result, as it was written.
ExitCode show_result(const SolidInfo& command, const SpatialSum& sum, ReadingNotes notes, const Timing& timing) {
  for (const std::string& file : command.pictures) write_text(file, solid_output(sum, file));
  if (!command.json) {
    print_result(sum);
    return kDone;
  }
  SolidInput input{command.file, Mesh()};
  input.result = sum, input.fractions = true, input.notes = std::move(notes);
  Json json = report_head("info", solid_inputs_json({input}), 0, timing);
  json.update({{"valid", true}, {"exact", true}, {"edges", sum.edges().size()}, {"bounds", bounds_json(sum)}});
  json.update(solid_sum_json(sum, false));
  print_report(json);
  return kDone;
}

}  // namespace

ExitCode run_solid_info(const SolidInfo& command) {
  for (const std::string& file : command.pictures) {
    const Result<MeshFormat> format = mesh_format(file);
    if (!format || *format != MeshFormat::glb)
      throw Stop(kUsage, "info draws solids as .glb pictures or .html only, not " + file);
  }
  if (holds_solid_result(command.file, command.input)) {
    const auto [sum, timing] = timed(1, [&] { return read_solid_result(command.file, command.input); });
    return show_result(command, sum, Json::object(), timing);
  }
  const auto [solid, timing] = timed(1, [&]() -> Result<SolidInput> {
    if (!command.input.planes.empty()) return read_by_planes({command.file}, command.input)[0];
    return make_solid(require(read_mesh_data(command.file, command.input)), command.file, command.input);
  });
  if (solid && solid->fractions) return show_result(command, *solid->result, solid->notes, timing);
  if (!solid) {
    if (command.json) print_report(invalid_json(solid.error(), timing));
    else std::cout << "not valid (" << name(solid.error().code) << ")\n";
    std::cerr << solid.error().to_string() << "\n";
    return kBadInput;
  }
  const Mesh& mesh = solid->mesh;
  const std::optional<Error> not_convex = convexity_error(mesh);
  {
    const InterruptGuard guard;
    const WriteGuard writing;
    for (const std::string& file : command.pictures) write_text(file, mesh_text(mesh, MeshFormat::glb, file));
  }
  if (command.json) {
    print_report(info_json(*solid, not_convex, timing));
  } else {
    print_info(*solid, not_convex);
  }
  return kDone;
}

}  // namespace dymsum::cli
