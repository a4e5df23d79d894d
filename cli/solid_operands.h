// Solid operands of a command line.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "dymsum/mesh.h"
#include "inputs.h"
#include "report.h"

namespace dymsum::cli {

struct SolidInput {
  std::string file;
  Mesh mesh;
};

/// Told by the extension: .off .obj .stl .ply.
bool is_solid_file(const std::string& file);
/// Whether all operands are solids; a Stop when only some are.
bool are_solid(const std::vector<std::string>& files);
SolidInput read_solid(const std::string& file, const InputOptions& options);
std::vector<SolidInput> read_solids(const std::vector<std::string>& files, const InputOptions& options);
Json solid_inputs_json(const std::vector<SolidInput>& inputs);

/// "x,y,z".
Point3 parse_point(const std::string& text, const std::string& option);

}  // namespace dymsum::cli
