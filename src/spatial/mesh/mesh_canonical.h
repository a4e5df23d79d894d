// The merging of coplanar faces behind Mesh::canonical.
#pragma once

#include <vector>

#include "dymsum/mesh.h"

namespace dymsum::spatial {

// The faces of a mesh that bound no volume.

/// Faces with fewer than three vertices, and, again and again, those with an edge that no other face has that is left.
/// Empty where there are none. O(n log n).
std::vector<bool> thin_faces(const std::vector<Face>& faces);

/// The faces of a mesh that are not thin, with all vertices.
MeshData solid_part(const Mesh& mesh);

/// The canonical form of a valid surface, before it is known whether merging kept it valid. It always is for convex
/// solids. Exact. O(n log n).
MeshData merged_and_sorted(const MeshData& data);

/// Vertices and faces as they are, in canonical order: vertices by x, y, z, faces from their smallest vertex, sorted;
/// vertices without a face dropped, no negative zeros.
MeshData sorted(const std::vector<Point3>& vertices, std::vector<Face> faces);

}  // namespace dymsum::spatial
