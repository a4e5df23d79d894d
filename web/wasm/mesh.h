// Formats of meshes by name.
#pragma once

#include <string>

#include "dymsum/mesh_io.h"

namespace dymsum::web {

MeshFormat mesh_format_in(const std::string& name);

}  // namespace dymsum::web
