// The named repair of meshes.
#include <algorithm>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "dymsum/mesh.h"
#include "exact/orient3.h"
#include "spatial/mesh/edge_order.h"
#include "spatial/mesh/mesh_validate.h"
#include "spatial/mesh/shell_nesting.h"
#include "spatial/mesh/six_volume.h"
#include "spatial/mesh/surface_crossings.h"
#include "spatial/mesh/triangulate.h"

namespace dymsum {

namespace spatial {

namespace {

class MeshRepair {
 public:
  explicit MeshRepair(MeshData data) : data_(std::move(data)) {}

  Result<RepairedMesh> run() {
    if (auto error = check_finite(data_.vertices)) return *std::move(error);
    if (auto error = check_indices(data_)) return *std::move(error);
    merge_vertices();
    drop_degenerate_faces();
    split_faces();
    drop_unused_vertices();
    orient();
    Result<Mesh> mesh = Mesh::create(std::move(data_));
    if (!mesh) return in_the_input(mesh.error());
    return RepairedMesh{std::move(mesh).value(), report_};
  }

 private:
  /// Every face names the first of the vertices at its places.
  void merge_vertices() {
    const std::vector<Point3>& points = data_.vertices;
    std::vector<std::uint32_t> order(points.size()), first(points.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::tie(points[a].x, points[a].y, points[a].z, a) < std::tie(points[b].x, points[b].y, points[b].z, b);
    });
    for (std::size_t i = 0; i < order.size(); ++i) {
      const bool again = i > 0 && points[order[i]] == points[order[i - 1]];
      first[order[i]] = again ? first[order[i - 1]] : order[i];
      report_.duplicate_vertices += again;
    }
    is_duplicate_.resize(points.size());
    for (std::uint32_t v = 0; v < points.size(); ++v) is_duplicate_[v] = first[v] != v;
    for (Face& face : data_.faces) {
      for (std::uint32_t& v : face) v = first[v];
    }
  }

  bool has_area(const Face& face) const {
    for (std::size_t i = 2; i < face.size(); ++i) {
      if (!exact::collinear(data_.vertices[face[0]], data_.vertices[face[1]], data_.vertices[face[i]])) return true;
    }
    return false;
  }

  void drop_degenerate_faces() {
    std::vector<Face> kept;
    for (std::size_t f = 0; f < data_.faces.size(); ++f) {
      Face face = std::move(data_.faces[f]);
      face.erase(std::unique(face.begin(), face.end()), face.end());
      while (face.size() > 1 && face.front() == face.back()) face.pop_back();
      if (!has_area(face)) {
        ++report_.degenerate_faces;
        continue;
      }
      kept.push_back(std::move(face));
      face_origin_.push_back(static_cast<std::int64_t>(f));
    }
    data_.faces = std::move(kept);
  }

  bool is_plane(const Face& face) const {
    const std::optional<Error> error = face_error(data_.vertices, face);
    return !error || error->code != ErrorCode::not_planar;
  }

  /// Bridges to holes, and corners at which a face touches itself.
  static bool has_vertex_twice(Face face) {
    std::sort(face.begin(), face.end());
    return std::adjacent_find(face.begin(), face.end()) != face.end();
  }

  /// The face as triangles, or the face itself where it is not to be split, or one of them would have no area.
  std::vector<Face> pieces_of(const Face& face) const {
    std::vector<Face> pieces;
    if (face.size() > 3 && (has_vertex_twice(face) || !is_plane(face))) {
      for (const Triangle& t : triangulated(data_.vertices, face, average_view(data_.vertices, face)))
        pieces.emplace_back(t.begin(), t.end());
      if (std::all_of(pieces.begin(), pieces.end(), [&](const Face& f) { return has_area(f); })) return pieces;
    }
    return {face};
  }

  void split_faces() {
    std::vector<Face> faces;
    std::vector<std::int64_t> origins;
    for (std::size_t f = 0; f < data_.faces.size(); ++f) {
      const std::vector<Face> pieces = pieces_of(data_.faces[f]);
      report_.split_faces += pieces.size() > 1;
      origins.insert(origins.end(), pieces.size(), face_origin_[f]);
      faces.insert(faces.end(), pieces.begin(), pieces.end());
    }
    data_.faces = std::move(faces);
    face_origin_ = std::move(origins);
  }

  void drop_unused_vertices() {
    std::vector<bool> used(data_.vertices.size());
    for (const Face& face : data_.faces) {
      for (const std::uint32_t v : face) used[v] = true;
    }
    std::vector<std::uint32_t> place(data_.vertices.size());
    std::vector<Point3> kept;
    for (std::size_t v = 0; v < used.size(); ++v) {
      if (!used[v]) {
        report_.unused_vertices += !is_duplicate_[v];
        continue;
      }
      place[v] = static_cast<std::uint32_t>(kept.size());
      kept.push_back(data_.vertices[v]);
      vertex_origin_.push_back(static_cast<std::int64_t>(v));
    }
    data_.vertices = std::move(kept);
    for (Face& face : data_.faces) {
      for (std::uint32_t& v : face) v = place[v];
    }
  }

  /// Turns single faces over until all agree with their neighbours, as few as that takes, then whole shells that are
  /// inside out. Only across edges of two faces; what contradicts itself is left to Mesh::create.
  void orient() {
    const std::vector<bool> turned = disagreeing_faces();
    for (std::size_t f = 0; f < turned.size(); ++f) {
      if (!turned[f]) continue;
      turn_over(data_.faces[f]);
      ++report_.reversed_faces;
    }
    HalfEdges edges = half_edges_without_twins(data_.faces);
    if (!is_closed(edges)) return;
    const Shells shells = find_shells(edges);
    std::vector<int> signs = shell_signs(data_, shells);
    const std::vector<std::uint32_t> depths = depths_of(shells);
    for (std::size_t s = 0; s < signs.size(); ++s) {
      if (depths[s] % 2 == 1) signs[s] = -signs[s];  // around a cavity
    }
    report_.reversed_shells += static_cast<std::size_t>(std::count(signs.begin(), signs.end(), -1));
    for (std::size_t f = 0; f < data_.faces.size(); ++f) {
      if (signs[shells.of_face[f]] < 0) turn_over(data_.faces[f]);
    }
  }

  /// Joins all edges; false where the surface is not closed, or not valid for other reasons.
  bool is_closed(HalfEdges& edges) const {
    const std::vector<EdgeSide> sides = edge_sides(edges);
    bool even = true, several = false;
    for_each_edge(sides, [&](const EdgeSide* first, const EdgeSide* last) {
      const auto along = std::count_if(
          first, last, [&](const EdgeSide& s) { return edges.origin[s.half_edge] == edges.origin[first->half_edge]; });
      even &= 2 * along == last - first;
      several |= last - first > 2;
    });
    return even && (!several || all_faces_valid()) && !join_around(edges, sides, data_);
  }
  bool all_faces_valid() const {
    return std::all_of(data_.faces.begin(), data_.faces.end(),
                       [&](const Face& face) { return !has_vertex_twice(face) && !face_error(data_.vertices, face); });
  }

  /// None where a face is not valid by itself, so that Mesh::create refuses it.
  std::vector<std::uint32_t> depths_of(const Shells& shells) const {
    if (shells.count < 2 || !all_faces_valid()) return std::vector<std::uint32_t>(shells.count);
    const Triangles triangles = triangulated(data_);
    return shell_depths(data_, shells, triangles, boxes_of(data_.vertices, triangles.triangles));
  }

  static void turn_over(Face& face) { std::reverse(face.begin() + 1, face.end()); }

  /// A face and the one across an edge; `agree` when they run through it in opposite directions.
  struct Neighbour {
    std::uint32_t face;
    bool agree;
  };

  std::vector<std::vector<Neighbour>> neighbours() const {
    std::vector<std::vector<Neighbour>> found(data_.faces.size());
    const HalfEdges edges = half_edges_without_twins(data_.faces);
    const std::vector<EdgeSide> sides = edge_sides(edges);
    for_each_edge(sides, [&](const EdgeSide* first, const EdgeSide* last) {
      if (last - first != 2) return;
      const std::uint32_t g = first[0].half_edge, h = first[1].half_edge;
      const bool agree = edges.origin[g] != edges.origin[h];
      found[edges.face[g]].push_back({edges.face[h], agree});
      found[edges.face[h]].push_back({edges.face[g], agree});
    });
    return found;
  }

  std::vector<bool> disagreeing_faces() const {
    const std::vector<std::vector<Neighbour>> beside = neighbours();
    std::vector<bool> turned(beside.size()), reached(beside.size());
    for (std::uint32_t start = 0; start < beside.size(); ++start) {
      if (reached[start]) continue;
      reached[start] = true;
      std::vector<std::uint32_t> shell{start};
      for (std::size_t i = 0; i < shell.size(); ++i) {
        for (const Neighbour& n : beside[shell[i]]) {
          if (reached[n.face]) continue;
          reached[n.face] = true;
          turned[n.face] = turned[shell[i]] == n.agree;
          shell.push_back(n.face);
        }
      }
      const auto count = std::count_if(shell.begin(), shell.end(), [&](std::uint32_t f) { return turned[f]; });
      if (2 * static_cast<std::size_t>(count) <= shell.size()) continue;
      for (const std::uint32_t f : shell) turned[f] = !turned[f];
    }
    return turned;
  }

  /// The error with the numbers of faces and vertices that they had at first.
  Error in_the_input(Error error) const {
    Evidence& e = error.evidence;
    for (auto* face : {&e.face, &e.other_face}) {
      if (*face) *face = face_origin_[static_cast<std::size_t>(**face)];
    }
    for (auto* vertex : {&e.vertex, &e.other_vertex}) {
      if (*vertex) *vertex = vertex_origin_[static_cast<std::size_t>(**vertex)];
    }
    return error;
  }

  MeshData data_;
  MeshRepairReport report_;
  std::vector<bool> is_duplicate_;
  std::vector<std::int64_t> face_origin_, vertex_origin_;
};

}  // namespace

}  // namespace spatial

Result<RepairedMesh> repair(MeshData data) { return spatial::MeshRepair(std::move(data)).run(); }

std::string MeshRepairReport::to_string() const {
  std::string text;
  const auto say = [&](std::size_t n, const char* one, const char* many) {
    if (n > 0) text += (text.empty() ? "" : ", ") + std::to_string(n) + " " + (n == 1 ? one : many);
  };
  say(duplicate_vertices, "duplicate vertex merged", "duplicate vertices merged");
  say(unused_vertices, "unused vertex dropped", "unused vertices dropped");
  say(degenerate_faces, "face without area dropped", "faces without area dropped");
  say(split_faces, "face split into triangles", "faces split into triangles");
  say(reversed_faces, "face turned over", "faces turned over");
  say(reversed_shells, "shell turned right", "shells turned right");
  return text.empty() ? "nothing to repair" : text;
}

}  // namespace dymsum
