// The named repair of surfaces that cross: first what else there is to repair, then the union.
#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "dymsum/solid_union.h"
#include "exact/orient3.h"
#include "spatial/mesh/half_edges.h"
#include "spatial/mesh/mesh_repair.h"
#include "spatial/mesh/six_volume.h"
#include "spatial/mesh/surface_crossings.h"
#include "spatial/mesh/triangulate.h"

namespace dymsum {

namespace {

bool by_position(const Point3& a, const Point3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

/// How many of the vertices are in no position of the list.
std::size_t new_positions(const std::vector<Point3>& vertices, std::vector<Point3> known) {
  std::sort(known.begin(), known.end(), by_position);
  return static_cast<std::size_t>(std::count_if(vertices.begin(), vertices.end(), [&](const Point3& p) {
    return !std::binary_search(known.begin(), known.end(), p, by_position);
  }));
}

/// The faces as triangles, those with an area.
MeshData as_triangles(const MeshData& surface) {
  MeshData result{surface.vertices, {}};
  for (const Face& face : surface.faces) {
    for (const spatial::Triangle& t :
         spatial::triangulated(surface.vertices, face, spatial::average_view(surface.vertices, face)))
      if (!exact::collinear(surface.vertices[t[0]], surface.vertices[t[1]], surface.vertices[t[2]]))
        result.faces.emplace_back(t.begin(), t.end());
  }
  return result;
}

/// Shells that are inside out and cross another shell are bodies: turned over, they add to it what they would have
/// taken away. (One that crosses nothing bounds a cavity, or a body by itself.) Returns how many there were.
std::size_t turn_crossing_shells(MeshData& triangles) {
  const spatial::Shells shells = spatial::find_shells(spatial::half_edges(triangles.faces));
  const std::vector<int> signs = spatial::shell_signs(triangles, shells);
  if (shells.count < 2 || std::find(signs.begin(), signs.end(), -1) == signs.end()) return 0;
  spatial::Triangles all;
  for (const Face& face : triangles.faces) all.triangles.push_back({face[0], face[1], face[2]});
  all.face.resize(triangles.faces.size());
  std::iota(all.face.begin(), all.face.end(), 0u);
  std::vector<bool> queried;
  for (const std::uint32_t shell : shells.of_face) queried.push_back(signs[shell] < 0);
  std::vector<bool> turned(shells.count);
  for (const auto& [a, b] :
       spatial::find_meetings(triangles, all, spatial::boxes_of(triangles.vertices, all.triangles), queried)) {
    const std::uint32_t s = shells.of_face[a], t = shells.of_face[b];
    if (s == t) continue;
    turned[s] = signs[s] < 0, turned[t] = signs[t] < 0;
  }
  for (std::size_t f = 0; f < triangles.faces.size(); ++f)
    if (turned[shells.of_face[f]]) std::reverse(triangles.faces[f].begin(), triangles.faces[f].end());
  return static_cast<std::size_t>(std::count(turned.begin(), turned.end(), true));
}

/// Errors that no union repairs.
bool is_final(ErrorCode code) { return code == ErrorCode::not_finite || code == ErrorCode::bad_index; }
bool is_limit(ErrorCode code) { return code == ErrorCode::cancelled || code == ErrorCode::out_of_memory; }

}  // namespace

Result<RepairedMesh> repair_with_union(MeshData data, Fill fill, const SpatialOptions& options) {
  Result<RepairedMesh> plain = repair(data);
  if (plain || is_final(plain.error().code)) return plain;
  Result<spatial::PreparedSurface> surface = spatial::prepared_surface(std::move(data));
  if (!surface) return plain;
  MeshData triangles = as_triangles(surface->data);
  const std::size_t turned = fill == Fill::nonzero ? turn_crossing_shells(triangles) : 0;
  const Result<SpatialSum> solid = united(triangles, fill, options);
  if (!solid) return is_limit(solid.error().code) ? solid.error() : plain.error();
  if (solid->faces.empty()) return plain;
  Result<SpatialSum::Rounded> rounded = solid->rounded();
  if (!rounded) return rounded.error();
  RepairedMesh result;
  result.report = surface->report;
  result.report.reversed_shells += turned;
  result.report.united = true;
  result.report.united_crossings = new_positions(rounded->mesh.vertices, surface->data.vertices);
  result.report.united_distance = rounded->distance;
  Result<Mesh> mesh = Mesh::create(std::move(rounded->mesh));
  if (!mesh) return mesh.error();
  result.mesh = *std::move(mesh);
  return result;
}

}  // namespace dymsum
