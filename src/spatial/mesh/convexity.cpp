// Whether a mesh bounds a convex solid.
//
// Faces of a mesh meet only where they share an edge or a vertex, and each fan of them goes around its vertex once.
// Where no edge is reflex, a small sphere around a point of the surface cuts the material of a fan in a region whose
// boundary is a simple polygon without reflex corners, and that is convex: the surface is locally convex. A connected
// closed surface that is locally convex bounds a convex solid, also if it were allowed to touch itself (van Heijenoort
// 1952).
#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "spatial/mesh/edge_bend.h"
#include "spatial/mesh/edge_order.h"
#include "spatial/mesh/half_edges.h"

namespace dymsum {

namespace spatial {

namespace {

Error not_convex(std::string message, std::uint32_t face) {
  Error error{ErrorCode::not_convex, std::move(message), {}};
  error.evidence.face = face;
  return error;
}

Error bad_edge(const MeshData& data, const HalfEdges& edges, std::uint32_t h, Bend bend) {
  Error error =
      not_convex(bend == Bend::reflex ? "an edge is reflex" : "two faces lie on top of each other", edges.face[h]);
  const std::uint32_t v = edges.origin[h];
  error.evidence.other_face = edges.face[edges.twin[h]];
  error.evidence.vertex = v;
  error.evidence.other_vertex = edges.target(h);
  error.evidence.x = data.vertices[v].x;
  error.evidence.y = data.vertices[v].y;
  error.evidence.z = data.vertices[v].z;
  return error;
}

}  // namespace

}  // namespace spatial

std::optional<Error> convexity_error(const Mesh& mesh) {
  using namespace spatial;
  if (mesh.empty()) return Error{ErrorCode::no_area, "the mesh is empty", {}};
  if (mesh.has_thin_parts()) {
    const std::vector<bool>& thin = mesh.thin_faces();
    const auto first = std::find(thin.begin(), thin.end(), true) - thin.begin();
    return not_convex("the mesh has parts without volume", static_cast<std::uint32_t>(first));
  }
  const MeshData& data = mesh.data();
  const HalfEdges edges = half_edges(data);
  if (mesh.shell_count() > 1) {
    const Shells shells = find_shells(edges);
    const auto second = std::find(shells.of_face.begin(), shells.of_face.end(), 1u);
    return not_convex("the mesh has several shells", static_cast<std::uint32_t>(second - shells.of_face.begin()));
  }
  const std::vector<FacePlane> planes = face_planes(data);
  for (std::uint32_t h = 0; h < edges.size(); ++h) {
    if (h > edges.twin[h]) continue;
    const Bend bend = edge_bend(data, edges, planes, h);
    if (bend == Bend::reflex || bend == Bend::folded) return bad_edge(data, edges, h, bend);
  }
  return std::nullopt;
}

}  // namespace dymsum
