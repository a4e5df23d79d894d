// The checks behind Mesh::create, and the way to make meshes whose validity is already proved.
#pragma once

#include <cstddef>
#include <optional>

#include "dymsum/mesh.h"
#include "dymsum/result.h"
#include "spatial/mesh/surface_crossings.h"

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

/// The error faces_cross for a meeting that find_meeting found. Its sentence and evidence say what the faces have in
/// common, the first of these that they have:
/// - an edge of one runs through the inside of the other, where the two cross: `face`, `other_face`;
/// - they lie on each other in one plane: `face`, `other_face`;
/// - a vertex of one touches the other inside: `vertex` touches `face`, and is a corner of `other_face`;
/// - or inside an edge, which begins at `other_vertex` in that face;
/// - an edge of `face`, from `vertex` to `other_vertex`, touches one of `other_face`, between the ends of both.
/// Exact. O(k l) for faces of k and l vertices.
Error contact_error(const MeshData& data, const Triangles& triangles, const FaceMeeting& meeting);

/// Mesh made of data that are known to be valid.
Mesh trusted_mesh(MeshData data, std::size_t shells, std::vector<bool> thin = {});

}  // namespace dymsum::spatial
