#include "spatial/mesh/mesh_canonical.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "exact/orient.h"
#include "spatial/mesh/half_edges.h"
#include "spatial/mesh/mesh_validate.h"

namespace dymsum::spatial {

std::vector<bool> thin_faces(const std::vector<Face>& faces) {
  std::vector<bool> thin(faces.size());
  bool any = false;
  std::vector<Face> with_area;
  std::vector<std::uint32_t> origin;
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    thin[f] = faces[f].size() < 3;
    any |= thin[f];
    if (thin[f]) continue;
    with_area.push_back(faces[f]);
    origin.push_back(f);
  }
  const HalfEdges edges = half_edges_without_twins(with_area);
  const std::vector<EdgeSide> sides = edge_sides(edges);
  std::vector<std::size_t> first_of(edges.size()), last_of(edges.size()), left(edges.size());
  std::vector<std::uint32_t> open;  // faces that turned out to be thin
  const auto drop = [&](std::uint32_t f) {
    if (thin[origin[f]]) return;
    thin[origin[f]] = any = true;
    open.push_back(f);
  };
  for_each_edge(sides, [&](const EdgeSide* first, const EdgeSide* last) {
    for (const EdgeSide* s = first; s != last; ++s) {
      first_of[s->half_edge] = static_cast<std::size_t>(first - sides.data());
      last_of[s->half_edge] = static_cast<std::size_t>(last - sides.data());
    }
    left[first->half_edge] = static_cast<std::size_t>(last - first);
    if (last - first == 1) drop(edges.face[first->half_edge]);
  });
  while (!open.empty()) {
    const std::uint32_t f = open.back();
    open.pop_back();
    for (std::uint32_t h = edges.face_begin[f]; h < edges.face_begin[f + 1]; ++h) {
      if (--left[sides[first_of[h]].half_edge] != 1) continue;
      for (std::size_t s = first_of[h]; s < last_of[h]; ++s) drop(edges.face[sides[s].half_edge]);
    }
  }
  if (!any) thin.clear();
  return thin;
}

MeshData solid_part(const Mesh& mesh) {
  if (!mesh.has_thin_parts()) return mesh.data();
  MeshData solid{mesh.vertices(), {}};
  for (std::size_t f = 0; f < mesh.faces().size(); ++f)
    if (!mesh.thin_faces()[f]) solid.faces.push_back(mesh.faces()[f]);
  return solid;
}

}  // namespace dymsum::spatial

namespace dymsum {

namespace spatial {
namespace {

constexpr std::uint32_t kNone = HalfEdges::kNone;

bool less(const Point3& p, const Point3& q) { return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z); }

/// Faces joined through flat edges, and the outlines of what they cover.
class FlatGroups {
 public:
  explicit FlatGroups(const MeshData& data) : data_(data), edges_(half_edges(data)), group_(data.faces.size()) {
    std::iota(group_.begin(), group_.end(), 0u);
    const std::vector<FacePlane> planes = face_planes(data);
    for (std::uint32_t h = 0; h < edges_.size(); ++h) {
      if (h > edges_.twin[h] || edge_bend(data, edges_, planes, h) != Bend::flat) continue;
      group_[root(edges_.face[h])] = root(edges_.face[edges_.twin[h]]);
    }
  }

  /// One face per group whose outline is one loop that touches itself nowhere; the faces as they are of other groups.
  std::vector<Face> merged_faces() {
    std::vector<std::vector<std::uint32_t>> members(group_.size());
    for (std::uint32_t f = 0; f < group_.size(); ++f) members[root(f)].push_back(f);
    std::vector<Face> faces;
    seen_.assign(data_.vertices.size(), kNone);
    for (std::uint32_t g = 0; g < members.size(); ++g) {
      if (members[g].empty()) continue;
      Face outline = members[g].size() == 1 ? data_.faces[members[g][0]] : simple_outline(g, members[g]);
      if (!outline.empty()) {
        faces.push_back(std::move(outline));
      } else {
        for (const std::uint32_t f : members[g]) faces.push_back(data_.faces[f]);
      }
    }
    return faces;
  }

 private:
  std::uint32_t root(std::uint32_t f) {
    while (group_[f] != f) f = group_[f] = group_[group_[f]];
    return f;
  }
  bool inside(std::uint32_t h) { return root(edges_.face[h]) == root(edges_.face[edges_.twin[h]]); }

  /// The outline's half-edges after h: around the end of h over the group's own faces.
  std::uint32_t next_on_outline(std::uint32_t h) {
    h = edges_.next[h];
    while (inside(h)) h = edges_.next[edges_.twin[h]];
    return h;
  }

  /// Empty where there are several loops, or a vertex comes twice.
  Face simple_outline(std::uint32_t group, const std::vector<std::uint32_t>& members) {
    std::size_t outer = 0;
    std::uint32_t start = kNone;
    for (const std::uint32_t f : members) {
      for (std::uint32_t h = edges_.face_begin[f]; h < edges_.face_begin[f + 1]; ++h) {
        if (inside(h)) continue;
        ++outer;
        start = h;
      }
    }
    Face outline;
    if (start == kNone) return outline;
    std::uint32_t h = start;
    do {
      if (std::exchange(seen_[edges_.origin[h]], group) == group) return {};
      outline.push_back(edges_.origin[h]);
      h = next_on_outline(h);
    } while (h != start);
    return outline.size() == outer ? outline : Face{};
  }

  const MeshData& data_;
  HalfEdges edges_;
  std::vector<std::uint32_t> group_;
  std::vector<std::uint32_t> seen_;  ///< per vertex the group whose outline passed it last
};

/// Drops the vertices at which two edges only meet, straight on.
void drop_straight_vertices(const std::vector<Point3>& vertices, std::vector<Face>& faces) {
  std::vector<std::uint32_t> degree(vertices.size(), 0);
  for (const Face& face : faces) {
    for (const std::uint32_t v : face) ++degree[v];
  }
  for (Face& face : faces) {
    Face kept;
    for (std::size_t i = 0; i < face.size(); ++i) {
      const std::uint32_t before = face[i == 0 ? face.size() - 1 : i - 1];
      const std::uint32_t after = face[i + 1 == face.size() ? 0 : i + 1];
      if (degree[face[i]] == 2 && exact::collinear(vertices[before], vertices[face[i]], vertices[after])) continue;
      kept.push_back(face[i]);
    }
    face = std::move(kept);
  }
}

}  // namespace

MeshData sorted(const std::vector<Point3>& vertices, std::vector<Face> faces) {
  std::vector<std::uint32_t> order, position(vertices.size(), kNone);
  for (const Face& face : faces) {
    for (const std::uint32_t v : face) {
      if (std::exchange(position[v], 0) == kNone) order.push_back(v);
    }
  }
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return less(vertices[a], vertices[b]); });
  MeshData data;
  for (const std::uint32_t v : order) {
    position[v] = static_cast<std::uint32_t>(data.vertices.size());
    const Point3& p = vertices[v];
    data.vertices.push_back({p.x + 0.0, p.y + 0.0, p.z + 0.0});  // no negative zeros
  }
  for (Face& face : faces) {
    for (std::uint32_t& v : face) v = position[v];
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
  }
  std::sort(faces.begin(), faces.end());
  data.faces = std::move(faces);
  return data;
}

MeshData merged_and_sorted(const MeshData& data) {
  std::vector<Face> faces = FlatGroups(data).merged_faces();
  drop_straight_vertices(data.vertices, faces);
  return sorted(data.vertices, std::move(faces));
}

}  // namespace spatial

Mesh Mesh::canonical() const {
  if (has_thin_parts()) {
    MeshData sorted = spatial::sorted(data_.vertices, data_.faces);
    std::vector<bool> thin = spatial::thin_faces(sorted.faces);
    return spatial::trusted_mesh(std::move(sorted), shells_, std::move(thin));
  }
  MeshData merged = spatial::merged_and_sorted(data_);
  // Surfaces that touch themselves may lose their validity by merging; they are sorted only.
  if (spatial::validate(merged).error) merged = spatial::sorted(data_.vertices, data_.faces);
  return spatial::trusted_mesh(std::move(merged), shells_);
}

bool operator==(const Mesh& a, const Mesh& b) {
  return a.data_ == b.data_ || a.canonical().data_ == b.canonical().data_;
}

// Whether a mesh bounds a convex solid.
//
// Faces of a mesh meet only where they share an edge or a vertex, and each fan of them goes around its vertex once.
// Where no edge is reflex, a small sphere around a point of the surface cuts the material of a fan in a region whose
// boundary is a simple polygon without reflex corners, and that is convex: the surface is locally convex. A connected
// closed surface that is locally convex bounds a convex solid, also if it were allowed to touch itself (van Heijenoort
// 1952).

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
