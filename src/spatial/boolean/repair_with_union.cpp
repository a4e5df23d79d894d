// The named repair of surfaces that cross: first what else there is to repair, then the union.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "dymsum/solid_union.h"
#include "exact/orient.h"
#include "spatial/mesh/half_edges.h"
#include "spatial/mesh/mesh_canonical.h"
#include "spatial/mesh/mesh_orient.h"
#include "spatial/mesh/mesh_repair.h"
#include "spatial/mesh/surface_crossings.h"
#include "spatial/mesh/triangulate.h"
#include "spatial/mesh/vec3.h"

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

/// What was done, before the union, with shells that run inward and meet another one.
struct InnerShells {
  std::vector<Point3> turned;  ///< a vertex of each that was reversed
  bool cavities = false;       ///< others were kept as they are
};

/// The shells that run inward and meet another one. (One that meets nothing bounds a cavity, or a body by itself; one
/// with an edge of more than two faces may be a piece of a surface, which has no inside.)
std::vector<bool> inward_shells_that_meet(const MeshData& triangles, const spatial::Shells& shells,
                                          const std::vector<int>& signs) {
  std::vector<bool> found(shells.count);
  if (shells.count < 2 || std::find(signs.begin(), signs.end(), -1) == signs.end()) return found;
  spatial::Triangles all;
  for (const Face& face : triangles.faces) all.triangles.push_back({face[0], face[1], face[2]});
  std::vector<bool> queried;
  for (const std::uint32_t shell : shells.of_face) queried.push_back(signs[shell] < 0);
  for (const auto& [a, b] : spatial::find_meetings(triangles.vertices, all.triangles,
                                                   spatial::boxes_of(triangles.vertices, all.triangles), queried)) {
    const std::uint32_t s = shells.of_face[a], t = shells.of_face[b];
    if (s == t) continue;
    found[s] = found[s] || signs[s] < 0, found[t] = found[t] || signs[t] < 0;
  }
  return found;
}

/// A shell that runs inward bounds a cavity where what it encloses lies in the bodies, the shells that run outward; one
/// that sticks out of them is a body inside out, and is reversed: then the bodies with what it encloses are another set
/// than without. O(k) unions for k of these shells.
Result<InnerShells> settle_inner_shells(MeshData& triangles, const SpatialOptions& options) {
  const spatial::HalfEdges edges = spatial::half_edges(triangles.faces);
  const spatial::Shells shells = spatial::find_shells(edges);
  std::vector<int> signs = spatial::shell_signs(triangles, shells);
  for (std::size_t h = 0; h < edges.twin.size(); ++h)
    if (edges.twin[h] == spatial::HalfEdges::kNone) signs[shells.of_face[edges.face[h]]] = 0;
  const std::vector<bool> inward = inward_shells_that_meet(triangles, shells, signs);
  InnerShells inner;
  if (std::find(inward.begin(), inward.end(), true) == inward.end()) return inner;
  MeshData bodies{triangles.vertices, {}};
  std::vector<std::vector<Face>> turned(shells.count);
  for (std::size_t f = 0; f < triangles.faces.size(); ++f) {
    const std::uint32_t s = shells.of_face[f];
    if (signs[s] > 0) bodies.faces.push_back(triangles.faces[f]);
    if (inward[s]) turned[s].emplace_back(triangles.faces[f].rbegin(), triangles.faces[f].rend());
  }
  const Result<SpatialSum> before = united(bodies, Fill::nonzero, options);
  if (!before) return before.error();
  std::vector<bool> sticks_out(shells.count);
  for (std::uint32_t s = 0; s < shells.count; ++s) {
    if (!inward[s]) continue;
    MeshData with = bodies;
    with.faces.insert(with.faces.end(), turned[s].begin(), turned[s].end());
    const Result<SpatialSum> after = united(with, Fill::nonzero, options);
    if (!after) return after.error();
    sticks_out[s] = *before != *after;
    inner.cavities = inner.cavities || !sticks_out[s];
    if (sticks_out[s]) inner.turned.push_back(triangles.vertices[turned[s].front().back()]);
  }
  for (std::size_t f = 0; f < triangles.faces.size(); ++f)
    if (sticks_out[shells.of_face[f]]) std::reverse(triangles.faces[f].begin(), triangles.faces[f].end());
  return inner;
}

/// Errors that no union repairs.
bool is_final(ErrorCode code) { return code == ErrorCode::not_finite || code == ErrorCode::bad_index; }
bool is_limit(ErrorCode code) { return code == ErrorCode::cancelled || code == ErrorCode::out_of_memory; }

}  // namespace

namespace {

/// A triangle of a wall.
using Wall = std::array<Point3, 3>;

/// The walls as triangles; nothing where there are segments or points, which are no walls.
std::optional<std::vector<Wall>> walls_of(const Mesh& mesh) {
  const TriangulatedMesh split = triangulated(mesh);
  std::vector<Wall> walls;
  for (std::size_t t = 0; t < split.mesh.faces().size(); ++t) {
    if (!mesh.thin_faces()[split.face[t]]) continue;
    const Face& corners = split.mesh.faces()[t];
    if (corners.size() != 3) return std::nullopt;
    const std::vector<Point3>& at = split.mesh.vertices();
    walls.push_back({at[corners[0]], at[corners[1]], at[corners[2]]});
  }
  return walls;
}

/// A point near a triangle's centroid, 2^-10 of its size away from it on one side.
Point3 apex_over(const Wall& wall, double side) {
  const auto [a, b, c] = wall;
  const spatial::Vec3 u{b.x - a.x, b.y - a.y, b.z - a.z}, v{c.x - a.x, c.y - a.y, c.z - a.z}, n = spatial::cross(u, v);
  // The normal is as long as twice the area: divided by the longest edge that is the triangle's height, at most.
  const double longest = std::max(spatial::dot(u, u), spatial::dot(v, v)), off = std::ldexp(side, -10) / longest;
  const double height = std::sqrt(longest) * off;
  return {(a.x + b.x + c.x) / 3 + n.x * height, (a.y + b.y + c.y) / 3 + n.y * height,
          (a.z + b.z + c.z) / 3 + n.z * height};
}

/// Tetrahedra over walls, on one side; an error of Mesh::create where one is flat or two of them meet.
Result<Mesh> tetrahedra(std::span<const Wall> walls, double side) {
  MeshData all;
  for (const Wall& wall : walls) {
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    const std::uint32_t a = first, b = first + 1, c = first + 2, d = first + 3;
    all.vertices.insert(all.vertices.end(), {wall[0], wall[1], wall[2], apex_over(wall, side)});
    const bool above = exact::orient3_sign(wall[0], wall[1], wall[2], all.vertices[d]) > 0;
    if (above) all.faces.insert(all.faces.end(), {{a, c, b}, {a, b, d}, {b, c, d}, {c, a, d}});
    else all.faces.insert(all.faces.end(), {{a, b, c}, {b, a, d}, {c, b, d}, {a, c, d}});
  }
  MeshRepairOptions only;
  only.kinds = {MeshRepairKind::duplicate_vertices};
  Result<LoggedMesh> made = repair(std::move(all), only);
  if (!made) return made.error();
  return std::move(made).value().mesh;
}

/// Whether walls lie in the solid: whether tetrahedra over all of them do, on one of the two sides, or, where there are
/// few, over each of them. (One that touches the solid's boundary from both sides is taken as outside.)
Result<bool> holds(const Mesh& solid, std::span<const Wall> walls, const SpatialOptions& options) {
  SpatialOptions regular = options;
  regular.semantics = Semantics::regular;
  for (const double side : {1.0, -1.0}) {
    const Result<Mesh> over = tetrahedra(walls, side);
    if (!over) continue;
    const Result<SpatialSum> outside = difference(*over, solid, regular);
    if (!outside) return outside.error();
    if (outside->faces.empty()) return true;
  }
  constexpr std::size_t kFew = 64;
  if (walls.size() == 1 || walls.size() > kFew) return false;
  for (std::size_t k = 0; k < walls.size(); ++k) {
    const Result<bool> one = holds(solid, walls.subspan(k, 1), options);
    if (!one || !*one) return one;
  }
  return true;
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
  MeshData rest = without_thin_parts(thin->mesh);
  const std::optional<std::vector<Wall>> walls = walls_of(thin->mesh);
  if (rest.faces.empty() || !walls) return std::nullopt;
  Mesh solid = Mesh::create(std::move(rest)).value();
  const Result<bool> held = holds(solid, *walls, options);
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
  return LoggedMesh{std::move(solid), std::move(log)};
}

/// The solid that the surface bounds by winding number. Nothing where it bounds none.
std::optional<Result<LoggedMesh>> repair_crossings(MeshData data, Fill fill, const MeshRepairOptions& repairs,
                                                   const SpatialOptions& options) {
  if (!spatial::allows(repairs, MeshRepairKind::crossings)) return std::nullopt;
  Result<spatial::PreparedSurface> surface = spatial::prepared_surface(std::move(data), repairs);
  if (!surface) return std::nullopt;
  MeshData triangles = as_triangles(surface->data);
  const bool reverses = fill == Fill::nonzero && spatial::allows(repairs, MeshRepairKind::reversed_shells);
  const Result<InnerShells> inner = reverses ? settle_inner_shells(triangles, options) : InnerShells{};
  if (!inner) return is_limit(inner.error().code) ? std::optional<Result<LoggedMesh>>(inner.error()) : std::nullopt;
  // Where cavities overlap each other, and nothing else is there, the winding number is -1.
  const Result<SpatialSum> solid = united(triangles, inner->cavities ? Fill::positive : fill, options);
  if (!solid) return is_limit(solid.error().code) ? std::optional<Result<LoggedMesh>>(solid.error()) : std::nullopt;
  if (solid->faces.empty())
    return Result<LoggedMesh>(Error{ErrorCode::no_area, "the surfaces go around nothing, by winding number", {}});
  Result<SpatialSum::Rounded> rounded = solid->rounded();
  if (!rounded) return rounded.error();
  LoggedMesh result;
  result.log = std::move(surface->log);
  MeshRepairReport& counts = result.log.counts;
  counts.reversed_shells += inner->turned.size();
  counts.united = true;
  counts.united_distance = rounded->distance;
  const std::vector<Point3> crossings = new_positions(rounded->mesh.vertices, surface->data.vertices);
  counts.united_crossings = crossings.size();
  spatial::RepairMarks marks(result.log.marks);
  for (const Point3& at : inner->turned) marks.add(MeshRepairKind::reversed_shells, at);
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
