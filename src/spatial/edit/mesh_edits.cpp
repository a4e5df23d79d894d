#include "spatial/edit/mesh_edits.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "exact/orient.h"
#include "spatial/mesh/half_edges.h"
#include "spatial/mesh/mesh_validate.h"

namespace dymsum::spatial {
namespace {

Error refused_edit(std::string message) { return {ErrorCode::out_of_range, std::move(message), {}}; }

std::optional<Error> no_vertex(const NamedMeshData& mesh, std::uint32_t vertex) {
  if (vertex < mesh.data.vertices.size()) return std::nullopt;
  return refused_edit("there is no vertex " + std::to_string(vertex));
}

std::optional<Error> no_face(const NamedMeshData& mesh, std::uint32_t face) {
  if (face < mesh.data.faces.size()) return std::nullopt;
  return refused_edit("there is no face " + std::to_string(face));
}

std::uint32_t add_vertex(NamedMeshData& mesh, const Point3& at) {
  mesh.data.vertices.push_back(at);
  mesh.vertex_names.push_back(mesh.next_name++);
  return static_cast<std::uint32_t>(mesh.data.vertices.size() - 1);
}

void add_face(NamedMeshData& mesh, Face face, std::uint64_t ancestor) {
  mesh.data.faces.push_back(std::move(face));
  mesh.face_names.push_back(mesh.next_name++);
  mesh.face_ancestors.push_back(ancestor);
}

template <class T>
void keep(std::vector<T>& list, const std::vector<bool>& gone) {
  std::size_t n = 0;
  for (std::size_t k = 0; k < gone.size(); ++k)
    if (!gone[k]) {
      if (n != k) list[n] = std::move(list[k]);
      ++n;
    }
  list.resize(n);
}

void take_out_faces(NamedMeshData& mesh, const std::vector<bool>& gone) {
  keep(mesh.data.faces, gone);
  keep(mesh.face_names, gone);
  keep(mesh.face_ancestors, gone);
}

/// Requires: no face uses them.
void take_out_vertices(NamedMeshData& mesh, const std::vector<bool>& gone) {
  std::vector<std::uint32_t> index(gone.size());
  std::uint32_t n = 0;
  for (std::size_t v = 0; v < gone.size(); ++v) index[v] = gone[v] ? n : n++;
  for (Face& face : mesh.data.faces)
    for (std::uint32_t& v : face) v = index[v];
  keep(mesh.data.vertices, gone);
  keep(mesh.vertex_names, gone);
}

std::uint32_t after(const Face& face, std::size_t k) { return face[k + 1 == face.size() ? 0 : k + 1]; }
std::uint32_t before(const Face& face, std::size_t k) { return face[k == 0 ? face.size() - 1 : k - 1]; }

/// A face that runs from a to b, and where in it a is.
struct Side {
  std::uint32_t face = 0;
  std::size_t at = 0;
};

std::vector<Side> sides(const NamedMeshData& mesh, std::uint32_t a, std::uint32_t b) {
  std::vector<Side> found;
  for (std::uint32_t f = 0; f < mesh.data.faces.size(); ++f) {
    const Face& face = mesh.data.faces[f];
    for (std::size_t k = 0; k < face.size(); ++k)
      if (face[k] == a && after(face, k) == b) found.push_back({f, k});
  }
  return found;
}

/// The two sides of an edge: from a to b, and back.
Result<std::pair<Side, Side>> both_sides(const NamedMeshData& mesh, std::uint32_t a, std::uint32_t b) {
  for (const std::uint32_t v : {a, b})
    if (std::optional<Error> error = no_vertex(mesh, v)) return *error;
  const std::vector<Side> there = sides(mesh, a, b), back = sides(mesh, b, a);
  const std::string edge = "an edge from vertex " + std::to_string(a) + " to vertex " + std::to_string(b);
  if (there.empty() || back.empty()) return refused_edit("there is no " + edge.substr(3));
  if (there.size() + back.size() > 2) return refused_edit(edge + " has more than two faces");
  return std::pair{there[0], back[0]};
}

bool coplanar(const NamedMeshData& mesh, const Face& face) {
  const auto at = [&](std::size_t k) -> const Point3& { return mesh.data.vertices[face[k]]; };
  std::size_t third = 2;
  while (third < face.size() && exact::collinear(at(0), at(1), at(third))) ++third;
  for (std::size_t k = 2; k < face.size(); ++k)
    if (exact::orient3_sign(at(0), at(1), at(std::min(third, face.size() - 1)), at(k)) != 0) return false;
  return true;
}

Result<void> move_vertex(const SolidEdit& edit, NamedMeshData& mesh) {
  if (std::optional<Error> error = no_vertex(mesh, edit.vertex)) return *error;
  mesh.data.vertices[edit.vertex] = edit.at;
  return {};
}

Result<void> invert(const SolidEdit& edit, NamedMeshData& mesh) {
  const auto found = both_sides(mesh, edit.vertex, edit.other);
  if (!found) return found.error();
  const auto [there, back] = *found;
  Face &first = mesh.data.faces[there.face], &second = mesh.data.faces[back.face];
  if (first.size() != 3 || second.size() != 3) {
    Error error = refused_edit("the edge has a face that is no triangle");
    error.evidence.vertex = edit.vertex, error.evidence.other_vertex = edit.other;
    error.evidence.face = first.size() != 3 ? there.face : back.face;
    return error;
  }
  const std::uint32_t c = before(first, there.at), d = before(second, back.at);
  first = {c, edit.vertex, d}, second = {d, edit.other, c};
  return {};
}

/// Triangles from a vertex to the edges of a face that it does not end, instead of the face.
void fan_out(NamedMeshData& mesh, std::uint32_t vertex, const Face& face, std::uint64_t ancestor) {
  for (std::size_t k = 0; k < face.size(); ++k)
    if (face[k] != vertex && after(face, k) != vertex) add_face(mesh, {vertex, face[k], after(face, k)}, ancestor);
}

Result<void> insert_in_face(const SolidEdit& edit, NamedMeshData& mesh) {
  if (std::optional<Error> error = no_face(mesh, edit.face)) return *error;
  const Face face = mesh.data.faces[edit.face];
  const std::uint64_t ancestor = mesh.face_ancestors[edit.face];
  const std::uint32_t vertex = add_vertex(mesh, edit.at);
  std::vector<bool> gone(mesh.data.faces.size());
  gone[edit.face] = true;
  take_out_faces(mesh, gone);
  fan_out(mesh, vertex, face, ancestor);
  return {};
}

Result<void> insert_in_edge(const SolidEdit& edit, NamedMeshData& mesh) {
  const auto found = both_sides(mesh, edit.vertex, edit.other);
  if (!found) return found.error();
  const std::uint32_t vertex = add_vertex(mesh, edit.at);
  std::vector<bool> gone(mesh.data.faces.size());
  std::vector<std::pair<Face, std::uint64_t>> split;
  for (const Side& side : {found->first, found->second}) {
    Face face = mesh.data.faces[side.face];
    face.insert(face.begin() + static_cast<std::ptrdiff_t>(side.at + 1), vertex);
    if (face.size() > 4 && coplanar(mesh, face)) {
      mesh.data.faces[side.face] = std::move(face);
      continue;
    }
    gone[side.face] = true;
    split.emplace_back(std::move(face), mesh.face_ancestors[side.face]);
  }
  take_out_faces(mesh, gone);
  for (const auto& [face, ancestor] : split) fan_out(mesh, vertex, face, ancestor);
  return {};
}

/// The faces of an extrusion.
Result<std::vector<bool>> extruded_faces(const SolidEdit& edit, const NamedMeshData& mesh, const HalfEdges& edges) {
  if (edit.faces.empty()) return refused_edit("an extrusion wants a face at least");
  std::vector<bool> in(mesh.data.faces.size());
  for (const std::uint32_t f : edit.faces) {
    if (std::optional<Error> error = no_face(mesh, f)) return *error;
    if (in[f]) return refused_edit("face " + std::to_string(f) + " is extruded twice");
    in[f] = true;
  }
  std::vector<std::uint32_t> reached{edit.faces[0]};
  std::vector<bool> seen(in.size());
  seen[edit.faces[0]] = true;
  for (std::size_t k = 0; k < reached.size(); ++k)
    for (std::uint32_t h = edges.face_begin[reached[k]]; h < edges.face_begin[reached[k] + 1]; ++h) {
      if (edges.twin[h] == HalfEdges::kNone) continue;
      const std::uint32_t beyond = edges.face[edges.twin[h]];
      if (!in[beyond] || seen[beyond]) continue;
      seen[beyond] = true;
      reached.push_back(beyond);
    }
  if (reached.size() == edit.faces.size()) return in;
  const auto apart = std::find_if(edit.faces.begin(), edit.faces.end(), [&](std::uint32_t f) { return !seen[f]; });
  Error error = refused_edit("the faces to extrude are not connected by edges");
  error.evidence.face = edit.faces[0], error.evidence.other_face = *apart;
  return error;
}

Result<void> extrude(const SolidEdit& edit, NamedMeshData& mesh) {
  const HalfEdges edges = half_edges(mesh.data.faces);
  const Result<std::vector<bool>> faces = extruded_faces(edit, mesh, edges);
  if (!faces) return faces.error();
  const std::vector<bool>& in = *faces;
  std::vector<bool> inner(mesh.data.vertices.size(), true);
  for (std::uint32_t f = 0; f < in.size(); ++f)
    if (!in[f])
      for (const std::uint32_t v : mesh.data.faces[f]) inner[v] = false;
  // The boundary of the set is left where it is, and joined by walls to its moved copy.
  struct Wall {
    std::uint32_t from, to, face;
  };
  std::vector<Wall> walls;
  for (std::uint32_t h = 0; h < edges.size(); ++h)
    if (in[edges.face[h]] && (edges.twin[h] == HalfEdges::kNone || !in[edges.face[edges.twin[h]]]))
      walls.push_back({edges.origin[h], edges.target(h), edges.face[h]});
  std::map<std::uint32_t, std::uint32_t> moved;
  const auto copy_of = [&](std::uint32_t v) {
    if (const auto known = moved.find(v); known != moved.end()) return known->second;
    const Point3 at = mesh.data.vertices[v];
    const Point3 to{at.x + edit.at.x, at.y + edit.at.y, at.z + edit.at.z};
    std::uint32_t copy = v;
    if (inner[v]) mesh.data.vertices[v] = to;
    else copy = add_vertex(mesh, to);
    return moved[v] = copy;
  };
  for (std::uint32_t f = 0; f < in.size(); ++f)
    if (in[f])
      for (std::size_t k = 0; k < mesh.data.faces[f].size(); ++k) {
        const std::uint32_t copy = copy_of(mesh.data.faces[f][k]);
        mesh.data.faces[f][k] = copy;
      }
  for (const Wall& wall : walls) {
    const std::uint64_t ancestor = mesh.face_ancestors[wall.face];
    const std::uint32_t a = wall.from, b = wall.to, a1 = moved.at(a), b1 = moved.at(b);
    if (coplanar(mesh, {a, b, b1, a1})) {
      add_face(mesh, {a, b, b1, a1}, ancestor);
    } else {
      add_face(mesh, {a, b, b1}, ancestor);
      add_face(mesh, {a, b1, a1}, ancestor);
    }
  }
  return {};
}

// Taking out a vertex.

/// The faces around a vertex, and the polygon around them, in the direction of these faces.
struct Star {
  std::vector<std::uint32_t> faces;
  Face around;
};

Result<Star> star_of(const NamedMeshData& mesh, std::uint32_t vertex) {
  std::map<std::uint32_t, Side> by_next;
  Star star;
  const Error refused = refused_edit("the faces around vertex " + std::to_string(vertex) + " are not one fan");
  for (std::uint32_t f = 0; f < mesh.data.faces.size(); ++f) {
    const Face& face = mesh.data.faces[f];
    const auto at = std::find(face.begin(), face.end(), vertex);
    if (at == face.end()) continue;
    const auto k = static_cast<std::size_t>(at - face.begin());
    if (!by_next.emplace(after(face, k), Side{f, k}).second) return refused;
    star.faces.push_back(f);
  }
  if (by_next.empty()) return refused;
  const std::uint32_t start = by_next.begin()->first;
  std::uint32_t next = start;
  for (std::size_t n = 0; n < star.faces.size(); ++n) {
    const auto side = by_next.find(next);
    if (side == by_next.end() || (n > 0 && next == start)) return refused;
    const Face& face = mesh.data.faces[side->second.face];
    for (std::size_t k = 1; k + 1 < face.size(); ++k) star.around.push_back(face[(side->second.at + k) % face.size()]);
    next = before(face, side->second.at);
  }
  return next == start ? Result<Star>(std::move(star)) : Result<Star>(refused);
}

/// A vertex inside an edge, of two faces: both lose it.
bool drop_from_edge(NamedMeshData& mesh, const Star& star, std::uint32_t vertex) {
  if (star.faces.size() != 2) return false;
  for (const std::uint32_t f : star.faces)
    if (mesh.data.faces[f].size() < 4) return false;
  for (const std::uint32_t f : star.faces) std::erase(mesh.data.faces[f], vertex);
  return true;
}

/// The polygon as one face, or triangles from its k-th corner.
NamedMeshData filled(NamedMeshData mesh, const Face& around, std::uint64_t ancestor,
                     std::optional<std::size_t> corner) {
  if (corner) fan_out(mesh, around[*corner], around, ancestor);
  else add_face(mesh, around, ancestor);
  return mesh;
}

Result<void> remove_vertex(const SolidEdit& edit, NamedMeshData& mesh) {
  if (std::optional<Error> error = no_vertex(mesh, edit.vertex)) return *error;
  const Result<Star> found = star_of(mesh, edit.vertex);
  if (!found) return found.error();
  Star star = *found;
  std::vector<bool> gone(mesh.data.vertices.size());
  gone[edit.vertex] = true;
  if (drop_from_edge(mesh, star, edit.vertex)) {
    take_out_vertices(mesh, gone);
    return {};
  }
  if (star.around.size() < 3) return refused_edit("nothing fills the gap of vertex " + std::to_string(edit.vertex));
  const std::uint64_t ancestor = mesh.face_ancestors[star.faces[0]];
  std::vector<bool> faces_gone(mesh.data.faces.size());
  for (const std::uint32_t f : star.faces) faces_gone[f] = true;
  take_out_faces(mesh, faces_gone);
  for (std::uint32_t& v : star.around) v -= v > edit.vertex;
  take_out_vertices(mesh, gone);
  // One face where it is plane; else the first fan that makes a valid mesh. Where other edits of the step still have to
  // make it valid none does, and the step is decided as a whole.
  if (star.around.size() == 3 || coplanar(mesh, star.around)) {
    mesh = filled(std::move(mesh), star.around, ancestor, std::nullopt);
    return {};
  }
  for (std::size_t k = 0; k < star.around.size(); ++k) {
    NamedMeshData tried = filled(mesh, star.around, ancestor, k);
    if (validate(tried.data).error) continue;
    mesh = std::move(tried);
    return {};
  }
  mesh = filled(std::move(mesh), star.around, ancestor, 0);
  return {};
}

Result<void> add_shell(const SolidEdit& edit, NamedMeshData& mesh) {
  if (edit.added.faces.empty()) return refused_edit("a shell has faces");
  if (std::optional<Error> error = check_indices(edit.added)) return *error;
  const auto first = static_cast<std::uint32_t>(mesh.data.vertices.size());
  for (const Point3& v : edit.added.vertices) add_vertex(mesh, v);
  for (Face face : edit.added.faces) {
    for (std::uint32_t& v : face) v += first;
    add_face(mesh, std::move(face), mesh.next_name);  // its own ancestor
  }
  return {};
}

Result<void> remove_shell(const SolidEdit& edit, NamedMeshData& mesh) {
  if (std::optional<Error> error = no_face(mesh, edit.face)) return *error;
  const Shells shells = find_shells(half_edges(mesh.data.faces));
  std::vector<bool> faces_gone(mesh.data.faces.size()), unused(mesh.data.vertices.size(), true);
  for (std::uint32_t f = 0; f < faces_gone.size(); ++f) {
    faces_gone[f] = shells.of_face[f] == shells.of_face[edit.face];
    if (!faces_gone[f])
      for (const std::uint32_t v : mesh.data.faces[f]) unused[v] = false;
  }
  take_out_faces(mesh, faces_gone);
  take_out_vertices(mesh, unused);
  return {};
}

}  // namespace

Result<void> apply(const SolidEdit& edit, NamedMeshData& edited) {
  switch (edit.kind) {
    case SolidEditKind::move:
      return move_vertex(edit, edited);
    case SolidEditKind::extrude:
      return extrude(edit, edited);
    case SolidEditKind::invert:
      return invert(edit, edited);
    case SolidEditKind::insert_in_face:
      return insert_in_face(edit, edited);
    case SolidEditKind::insert_in_edge:
      return insert_in_edge(edit, edited);
    case SolidEditKind::remove:
      return remove_vertex(edit, edited);
    case SolidEditKind::add_shell:
      return add_shell(edit, edited);
    default:
      return remove_shell(edit, edited);
  }
}

}  // namespace dymsum::spatial
