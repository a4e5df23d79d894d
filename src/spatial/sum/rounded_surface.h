// What rounding did to a surface of triangles.
#pragma once

#include <optional>

#include "dymsum/mesh.h"

namespace dymsum::spatial {

/// rounding_changed_topology with the position where two vertices became one, a triangle became a line, or two
/// triangles cross or touch, that did not before; nothing for a surface that stayed what it was. Requires: triangles
/// that share nothing but vertices and edges before rounding; edges and vertices may be those of more than two
/// triangles. Exact. O((n + k) log n) for k pairs with overlapping boxes.
std::optional<Error> rounding_error(const MeshData& triangles);

}  // namespace dymsum::spatial
