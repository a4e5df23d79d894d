#include "solid_operands.h"

#include <cmath>
#include <cstdlib>
#include <iostream>

#include "dymsum/mesh_io.h"
#include "exit_code.h"

namespace dymsum::cli {

bool is_solid_file(const std::string& file) {
  const Result<MeshFormat> format = mesh_format(file);
  return format && *format != MeshFormat::glb;
}

bool are_solid(const std::vector<std::string>& files) {
  std::size_t solids = 0;
  for (const std::string& file : files) solids += is_solid_file(file);
  if (solids != 0 && solids != files.size()) throw Stop(kUsage, "one operand is planar and the other one solid");
  return solids != 0;
}

SolidInput read_solid(const std::string& file, const InputOptions& options) {
  const auto in_file = [&](Error error) -> Error {
    if (error.evidence.file.empty()) error.evidence.file = file;
    return error;
  };
  MeshData data = require(read_mesh(file));
  if (!options.repair) {
    Result<Mesh> mesh = Mesh::create(std::move(data));
    if (!mesh) stop_with(in_file(mesh.error()));
    return {file, std::move(mesh).value()};
  }
  Result<RepairedMesh> repaired = repair(std::move(data));
  if (!repaired) stop_with(in_file(repaired.error()));
  if (repaired->report.changed()) std::cerr << file << ": repaired: " << repaired->report.to_string() << "\n";
  return {file, std::move(repaired).value().mesh};
}

std::vector<SolidInput> read_solids(const std::vector<std::string>& files, const InputOptions& options) {
  std::vector<SolidInput> inputs;
  for (const std::string& file : files) {
    inputs.push_back(read_solid(file, options));
    // Told here, where the file is known.
    if (std::optional<Error> error = convexity_error(inputs.back().mesh)) {
      error->evidence.file = file;
      stop_with(*error);
    }
  }
  return inputs;
}

Json solid_inputs_json(const std::vector<SolidInput>& inputs) {
  Json list = Json::array();
  for (const SolidInput& input : inputs)
    list.push_back({{"file", input.file}, {"vertices", input.mesh.vertices().size()}, {"faces", input.mesh.faces().size()}});
  return list;
}

Point3 parse_point(const std::string& text, const std::string& option) {
  Point3 p;
  const char* at = text.c_str();
  for (double* c : {&p.x, &p.y, &p.z}) {
    char* end = nullptr;
    *c = std::strtod(at, &end);
    const bool last = c == &p.z;
    if (end == at || !std::isfinite(*c) || *end != (last ? '\0' : ',')) throw Stop(kUsage, option + " wants three numbers, X,Y,Z: " + text);
    at = end + 1;
  }
  return p;
}

}  // namespace dymsum::cli
