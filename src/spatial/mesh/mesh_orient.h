// Which way faces and shells run, made right: a part of the named repair.
#pragma once

#include <cstddef>

#include "dymsum/mesh.h"

namespace dymsum::spatial {

/// Whether every face is valid by itself, and has no vertex twice.
bool all_faces_valid(const MeshData& data);

/// Turns single faces over until all agree with their neighbours, as few as that takes. Only across edges of two faces;
/// what contradicts itself is left as it is. Returns how many were turned. O(n log n).
std::size_t turn_faces(MeshData& data);

struct TurnedShells {
  std::size_t count = 0;     ///< that were inside out
  std::size_t cavities = 0;  ///< shells inside others that ran the same way, and bound cavities now
};

/// Turns whole shells that are inside out. Does nothing where the surface is not closed, or a face not valid.
TurnedShells turn_shells(MeshData& data);

}  // namespace dymsum::spatial
