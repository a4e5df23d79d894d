#include "solid_inputs.h"

#include <iostream>
#include <utility>

#include "exit_code.h"

namespace dymsum::cli {

bool names_solid(const std::string& file) { return mesh_format(file).ok(); }

Result<Mesh> make_mesh(MeshData data, const std::string& file, const InputOptions& options) {
  const auto in_file = [&](Error error) {
    if (error.evidence.file.empty()) error.evidence.file = file;
    return error;
  };
  if (!options.repair) {
    Result<Mesh> mesh = Mesh::create(std::move(data));
    if (!mesh) return in_file(mesh.error());
    return mesh;
  }
  Result<RepairedMesh> repaired = repair(std::move(data));
  if (!repaired) return in_file(repaired.error());
  if (repaired->report.changed()) std::cerr << file << ": repaired: " << repaired->report.to_string() << "\n";
  return std::move(repaired).value().mesh;
}

SolidInput read_solid(const std::string& file, const InputOptions& options) {
  return {file, require(make_mesh(require(read_mesh(file)), file, options))};
}

Json solid_inputs_json(const std::vector<SolidInput>& inputs) {
  Json list = Json::array();
  for (const SolidInput& input : inputs) {
    list.push_back({{"file", input.file},
                    {"vertices", input.mesh.vertices().size()},
                    {"faces", input.mesh.faces().size()},
                    {"shells", input.mesh.shell_count()}});
  }
  return list;
}

}  // namespace dymsum::cli
