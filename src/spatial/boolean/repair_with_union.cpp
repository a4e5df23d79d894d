// The named repair of surfaces that cross: first what else there is to repair, then the union.
#include <algorithm>
#include <iterator>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "dymsum/solid_union.h"
#include "exact/orient3.h"
#include "spatial/mesh/half_edges.h"
#include "spatial/mesh/mesh_repair.h"
#include "spatial/mesh/six_volume.h"
#include "spatial/mesh/surface_crossings.h"
#include "spatial/mesh/thin_faces.h"
#include "spatial/mesh/triangulate.h"

namespace dymsum {

namespace {

bool by_position(const Point3& a, const Point3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

/// Those vertices that are in no position of the list.
std::vector<Point3> new_positions(const std::vector<Point3>& vertices, std::vector<Point3> known) {
  std::sort(known.begin(), known.end(), by_position);
  std::vector<Point3> found;
  std::copy_if(vertices.begin(), vertices.end(), std::back_inserter(found),
               [&](const Point3& p) { return !std::binary_search(known.begin(), known.end(), p, by_position); });
  return found;
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
/// taken away. (One that crosses nothing bounds a cavity, or a body by itself.) Returns a vertex of each.
std::vector<Point3> turn_crossing_shells(MeshData& triangles) {
  const spatial::Shells shells = spatial::find_shells(spatial::half_edges(triangles.faces));
  const std::vector<int> signs = spatial::shell_signs(triangles, shells);
  if (shells.count < 2 || std::find(signs.begin(), signs.end(), -1) == signs.end()) return {};
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
  std::vector<Point3> at;
  std::vector<bool> seen(shells.count);
  for (std::size_t f = 0; f < triangles.faces.size(); ++f) {
    const std::uint32_t shell = shells.of_face[f];
    if (!turned[shell]) continue;
    if (!seen[shell]) at.push_back(triangles.vertices[triangles.faces[f].front()]);
    seen[shell] = true;
    std::reverse(triangles.faces[f].begin(), triangles.faces[f].end());
  }
  return at;
}

/// Errors that no union repairs.
bool is_final(ErrorCode code) { return code == ErrorCode::not_finite || code == ErrorCode::bad_index; }
bool is_limit(ErrorCode code) { return code == ErrorCode::cancelled || code == ErrorCode::out_of_memory; }

}  // namespace

namespace {

/// Whether the solid holds all parts without volume: the sum with the origin has tight features where it does not.
Result<bool> holds_thin_parts(const Mesh& mesh, const SpatialOptions& options) {
  const Mesh origin = Mesh::with_thin_parts({{{0, 0, 0}}, {{0}}}).value();
  const Result<SpatialSum> set = minkowski_sum(mesh, origin, options);
  if (!set) return set.error();
  return set->tight_faces.empty() && set->tight_segments.empty() && set->tight_points.empty();
}

/// The faces that are not thin, and their vertices.
MeshData without_thin_parts(const Mesh& mesh) {
  MeshData solid = spatial::solid_part(mesh), kept;
  std::vector<std::uint32_t> name(solid.vertices.size(), spatial::HalfEdges::kNone);
  for (Face& face : solid.faces) {
    for (std::uint32_t& v : face) {
      if (name[v] == spatial::HalfEdges::kNone) {
        name[v] = static_cast<std::uint32_t>(kept.vertices.size());
        kept.vertices.push_back(solid.vertices[v]);
      }
      v = name[v];
    }
  }
  kept.faces = std::move(solid.faces);
  return kept;
}

/// Nothing where walls are no repair; else the solid without them, or the error that ended that.
std::optional<Result<LoggedMesh>> repair_loose_walls(const MeshData& data, const MeshRepairOptions& repairs,
                                                     const SpatialOptions& options) {
  if (!spatial::allows(repairs, MeshRepairKind::loose_walls)) return std::nullopt;
  Result<LoggedMesh> thin = repair_with_thin_parts(data, repairs);
  if (!thin || !thin->mesh.has_thin_parts()) return std::nullopt;
  MeshData solid = without_thin_parts(thin->mesh);
  if (solid.faces.empty()) return std::nullopt;
  const Result<bool> held = holds_thin_parts(thin->mesh, options);
  if (!held) return is_limit(held.error().code) ? std::optional<Result<LoggedMesh>>(held.error()) : std::nullopt;
  if (!*held) return std::nullopt;
  auto [mesh, log] = std::move(thin).value();
  spatial::RepairMarks marks(log.marks);
  for (std::size_t f = 0; f < mesh.faces().size(); ++f) {
    if (!mesh.thin_faces()[f]) continue;
    ++log.loose_walls;
    marks.add(MeshRepairKind::loose_walls, mesh.vertices()[mesh.faces()[f].front()]);
  }
  log.marks = marks.all();
  return LoggedMesh{Mesh::create(std::move(solid)).value(), std::move(log)};
}

/// The solid that the surface bounds by winding number. Nothing where it bounds none.
std::optional<Result<LoggedMesh>> repair_crossings(MeshData data, Fill fill, const MeshRepairOptions& repairs,
                                                   const SpatialOptions& options) {
  if (!spatial::allows(repairs, MeshRepairKind::crossings)) return std::nullopt;
  Result<spatial::PreparedSurface> surface = spatial::prepared_surface(std::move(data), repairs);
  if (!surface) return std::nullopt;
  MeshData triangles = as_triangles(surface->data);
  const bool reverses = fill == Fill::nonzero && spatial::allows(repairs, MeshRepairKind::reversed_shells);
  const std::vector<Point3> turned = reverses ? turn_crossing_shells(triangles) : std::vector<Point3>{};
  const Result<SpatialSum> solid = united(triangles, fill, options);
  if (!solid) return is_limit(solid.error().code) ? std::optional<Result<LoggedMesh>>(solid.error()) : std::nullopt;
  if (solid->faces.empty()) return std::nullopt;
  Result<SpatialSum::Rounded> rounded = solid->rounded();
  if (!rounded) return rounded.error();
  LoggedMesh result;
  result.log = std::move(surface->log);
  MeshRepairReport& counts = result.log.counts;
  counts.reversed_shells += turned.size();
  counts.united = true;
  counts.united_distance = rounded->distance;
  const std::vector<Point3> crossings = new_positions(rounded->mesh.vertices, surface->data.vertices);
  counts.united_crossings = crossings.size();
  spatial::RepairMarks marks(result.log.marks);
  for (const Point3& at : turned) marks.add(MeshRepairKind::reversed_shells, at);
  for (const Point3& at : crossings) marks.add(MeshRepairKind::crossings, at);
  if (crossings.empty()) marks.add(MeshRepairKind::crossings, rounded->mesh.vertices.front());
  result.log.marks = marks.all();
  Result<Mesh> mesh = Mesh::create(std::move(rounded->mesh));
  if (!mesh) return mesh.error();
  result.mesh = *std::move(mesh);
  return result;
}

}  // namespace

Result<LoggedMesh> repair_with_union(MeshData data, Fill fill, const MeshRepairOptions& repairs,
                                     const SpatialOptions& options) {
  Result<LoggedMesh> plain = repair(data, repairs);
  if (plain || is_final(plain.error().code)) return plain;
  if (std::optional<Result<LoggedMesh>> without = repair_loose_walls(data, repairs, options))
    return *std::move(without);
  if (std::optional<Result<LoggedMesh>> whole = repair_crossings(std::move(data), fill, repairs, options))
    return *std::move(whole);
  return plain;
}

Result<RepairedMesh> repair_with_union(MeshData data, Fill fill, const SpatialOptions& options) {
  MeshRepairOptions repairs;
  std::erase(repairs.kinds, MeshRepairKind::loose_walls);  // which the report does not count
  Result<LoggedMesh> logged = repair_with_union(std::move(data), fill, repairs, options);
  if (!logged) return logged.error();
  LoggedMesh mesh = std::move(logged).value();
  return RepairedMesh{std::move(mesh.mesh), mesh.log.counts};
}

}  // namespace dymsum
