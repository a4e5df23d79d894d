// Solids far from the origin, moved beside it without rounding: what does not depend on where operands lie is asked of
// coordinates no longer than the solid is wide.
#pragma once

#include <optional>

#include "dymsum/mesh.h"

namespace dymsum::spatial {

/// The vector from the origin to which a solid is moved back: along every axis on which it is at least as far
/// from 0 as it is wide, its coordinate nearest to 0; 0 along others. Every coordinate of the solid less that of the
/// vector is a double.
Point3 offset_from_origin(const Mesh& solid);
/// The solid less that vector; nothing where that is 0. Vertices and faces keep their indices. Requires a solid without
/// thin parts.
std::optional<Mesh> beside_origin(const Mesh& solid);

}  // namespace dymsum::spatial
