// The checks behind Mesh::create, and the way to make meshes whose validity is already proved.
#pragma once

#include <cstddef>
#include <optional>

#include "dymsum/mesh.h"
#include "dymsum/result.h"

namespace dymsum::spatial {

/// The first coordinate that is NaN or infinite, with its vertex.
std::optional<Error> check_finite(const std::vector<Point3>& vertices);
/// The first vertex number of a face that no vertex has, with the face and that number.
std::optional<Error> check_indices(const MeshData& data);

/// What makes `data` not a valid mesh (see Mesh), or nothing. Evidence: `face`, `vertex`, the `other_` ones, and the
/// position of `vertex`; an edge is named by `vertex` and `other_vertex`, in the direction of `face`. Checks run in
/// this order: coordinates; indices, lengths and repeated indices of faces; equal vertices; unused vertices (bad_index
/// with no face); faces by themselves; edges; shells. Exact. O(n log n).
struct MeshValidation {
  std::optional<Error> error;
  std::size_t shells = 0;  ///< only without an error
};
MeshValidation validate(const MeshData& data);

/// The same for Mesh::with_thin_parts; `thin` as Mesh::thin_faces.
MeshValidation validate_with_thin_parts(const MeshData& data, std::vector<bool>& thin);

/// Mesh made of data that are known to be valid.
Mesh trusted_mesh(MeshData data, std::size_t shells, std::vector<bool> thin = {});

}  // namespace dymsum::spatial
