// Meshes as JavaScript gives them, and their formats by name.
#pragma once

#include <string>

#include "bind.h"
#include "dymsum/mesh_io.h"

namespace dymsum::web {

/// {vertices, faces}, not validated. Errors malformed, bad_index.
MeshData mesh_data_in(const val& data);
MeshFormat mesh_format_in(const std::string& name);

}  // namespace dymsum::web
