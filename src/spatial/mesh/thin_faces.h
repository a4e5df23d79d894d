// The faces of a mesh that bound no volume.
#pragma once

#include <vector>

#include "dymsum/mesh.h"

namespace dymsum::spatial {

/// Faces with fewer than three vertices, and, again and again, those with an edge that no other face has that is left.
/// Empty where there are none. O(n log n).
std::vector<bool> thin_faces(const std::vector<Face>& faces);

/// The faces of a mesh that are not thin, with all vertices.
MeshData solid_part(const Mesh& mesh);

}  // namespace dymsum::spatial
