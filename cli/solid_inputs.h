// Reading solids a command line names.
#pragma once

#include <string>
#include <vector>

#include "dymsum/mesh.h"
#include "dymsum/mesh_io.h"
#include "inputs.h"
#include "report.h"

namespace dymsum::cli {

struct SolidInput {
  std::string file;  ///< as it was written on the command line
  Mesh mesh;
};

/// Whether a file's extension is one of a solid (.off .obj .stl .ply .glb).
bool names_solid(const std::string& file);

/// Validates, or repairs where asked, what was read from a file.
Result<Mesh> make_mesh(MeshData data, const std::string& file, const InputOptions& options);
/// The valid mesh of a file.
SolidInput read_solid(const std::string& file, const InputOptions& options);

Json solid_inputs_json(const std::vector<SolidInput>& inputs);

}  // namespace dymsum::cli
