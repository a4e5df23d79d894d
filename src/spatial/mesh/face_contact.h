// What two faces have in common that they may not, distinguished: the error of a surface that meets itself.
#pragma once

#include "dymsum/mesh.h"
#include "dymsum/result.h"
#include "spatial/mesh/surface_crossings.h"

namespace dymsum::spatial {

/// The error faces_cross for a meeting that find_meeting found. Its sentence and evidence say what the faces have in
/// common, the first of these that they have:
/// - an edge of one runs through the inside of the other, where the two cross: `face`, `other_face`;
/// - they lie on each other in one plane: `face`, `other_face`;
/// - a vertex of one touches the other inside: `vertex` touches `face`, and is a corner of `other_face`;
/// - or inside an edge, which begins at `other_vertex` in that face;
/// - an edge of `face`, from `vertex` to `other_vertex`, touches one of `other_face`, between the ends of both.
/// Exact. O(k l) for faces of k and l vertices.
Error contact_error(const MeshData& data, const Triangles& triangles, const FaceMeeting& meeting);

}  // namespace dymsum::spatial
