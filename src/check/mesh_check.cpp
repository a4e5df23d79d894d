#include "dymsum/mesh_check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "spatial/mesh/half_edges.h"
#include "spatial/mesh/mesh_orient.h"
#include "spatial/mesh/mesh_validate.h"
#include "spatial/mesh/surface_crossings.h"
#include "spatial/mesh/vec3.h"

namespace dymsum {
namespace {

class FaultList {
 public:
  FaultList(const MeshData& data, const MeshCheckOptions& options) : data_(data), options_(options) {}

  MeshCheck run() {
    check_lists();
    if (check_.count > 0) return std::move(check_);  // there are no positions, or no vertices
    check_vertices();
    check_faces();
    check_duplicates();
    const bool closed = check_edges();
    check_meetings();
    if (closed) check_shells();
    return std::move(check_);
  }

 private:
  void add(Error error) {
    ++check_.count;
    if (check_.faults.size() < options_.listed) check_.faults.push_back(std::move(error));
  }
  Error error_at(ErrorCode code, const char* message, std::uint32_t vertex) const {
    Error error{code, message, {}};
    const Point3& p = data_.vertices[vertex];
    error.evidence.vertex = vertex;
    error.evidence.x = p.x, error.evidence.y = p.y, error.evidence.z = p.z;
    return error;
  }
  Error face_error_at(ErrorCode code, const char* message, std::uint32_t face) const {
    const Face& vertices = data_.faces[face];
    Error error = vertices.empty() ? Error{code, message, {}} : error_at(code, message, vertices[0]);
    error.evidence.face = face;
    return error;
  }

  void check_lists() {
    for (std::uint32_t v = 0; v < data_.vertices.size(); ++v) {
      const Point3& p = data_.vertices[v];
      if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) continue;
      Error error{ErrorCode::not_finite, "a coordinate is not a finite number", {}};
      error.evidence.vertex = v;
      add(std::move(error));
    }
    for (std::uint32_t f = 0; f < data_.faces.size(); ++f)
      for (const std::uint32_t v : data_.faces[f]) {
        if (v < data_.vertices.size()) continue;
        Error error{ErrorCode::bad_index, "a face names a vertex that does not exist", {}};
        error.evidence.face = f;
        error.evidence.vertex = v;
        add(std::move(error));
        break;
      }
  }

  void check_vertices() {
    first_ = spatial::first_at_position(data_.vertices);
    std::vector<bool> used(data_.vertices.size());
    for (const Face& face : data_.faces)
      for (const std::uint32_t v : face) used[v] = true;
    for (std::uint32_t v = 0; v < first_.size(); ++v) {
      if (first_[v] == v) continue;
      Error error = error_at(ErrorCode::repeated_vertex, "two vertices are at the same position", first_[v]);
      error.evidence.other_vertex = v;
      add(std::move(error));
    }
    for (std::uint32_t v = 0; v < used.size(); ++v)
      if (!used[v]) add(error_at(ErrorCode::bad_index, "no face uses this vertex", v));
  }

  // Faces that are right by themselves, of one vertex for each position.
  void check_faces() {
    right_.vertices = data_.vertices;
    for (std::uint32_t f = 0; f < data_.faces.size(); ++f) {
      Face face = data_.faces[f];
      for (std::uint32_t& v : face) v = first_[v];
      if (face.size() < 3) {
        add(face_error_at(ErrorCode::too_few_vertices, "a face needs at least three vertices", f));
        continue;
      }
      Face sorted = face;
      std::sort(sorted.begin(), sorted.end());
      if (const auto twice = std::adjacent_find(sorted.begin(), sorted.end()); twice != sorted.end()) {
        Error error = error_at(ErrorCode::repeated_vertex, "a face has a vertex twice", *twice);
        error.evidence.face = f;
        add(std::move(error));
        continue;
      }
      if (std::optional<Error> error = spatial::face_error(data_.vertices, face)) {
        error->evidence.face = f;
        add(*std::move(error));
        continue;
      }
      right_.faces.push_back(std::move(face));
      origin_.push_back(f);
    }
  }

  // Faces with the same vertices, whichever way they run, of which the first is kept: the others lie on it.
  void check_duplicates() {
    std::map<Face, std::uint32_t> known;
    std::vector<Face> kept;
    std::vector<std::uint32_t> origin;
    for (std::uint32_t f = 0; f < right_.faces.size(); ++f) {
      Face sorted = right_.faces[f];
      std::sort(sorted.begin(), sorted.end());
      const auto [first, added] = known.try_emplace(std::move(sorted), origin_[f]);
      if (added) {
        kept.push_back(std::move(right_.faces[f]));
        origin.push_back(origin_[f]);
        continue;
      }
      Error error = face_error_at(ErrorCode::faces_cross, "two faces have the same vertices", first->second);
      error.evidence.other_face = origin_[f];
      ++check_.crossings;
      add(std::move(error));
    }
    right_.faces = std::move(kept);
    origin_ = std::move(origin);
  }

  Error edge_error(ErrorCode code, const char* message, std::uint32_t h) const {
    Error error = error_at(code, message, edges_.origin[h]);
    error.evidence.other_vertex = edges_.target(h);
    error.evidence.face = origin_[edges_.face[h]];
    return error;
  }

  /// Whether every edge has as many faces on one side as on the other, by turns.
  bool check_edges() {
    edges_ = spatial::half_edges_without_twins(right_.faces);
    const std::vector<spatial::EdgeSide> sides = spatial::edge_sides(edges_);
    bool closed = !right_.faces.empty();
    spatial::for_each_edge(sides, [&](const spatial::EdgeSide* first, const spatial::EdgeSide* last) {
      const std::uint32_t h = first->half_edge;
      const auto count = last - first;
      const auto along = std::count_if(
          first, last, [&](const spatial::EdgeSide& s) { return edges_.origin[s.half_edge] == edges_.origin[h]; });
      if (2 * along == count) return;
      closed = false;
      if (count == 1) {
        ++check_.open_edges;
        return add(edge_error(ErrorCode::not_closed, "an edge has a face on one side only", h));
      }
      Error error = count % 2 == 1
                        ? edge_error(ErrorCode::not_manifold, "an edge has an odd number of faces", h)
                        : edge_error(ErrorCode::wrong_orientation, "two faces run through an edge in one direction", h);
      error.evidence.other_face = origin_[edges_.face[first[1].half_edge]];
      add(std::move(error));
    });
    if (!closed) {
      spatial::join_twins(edges_, sides);
    } else if (const std::optional<spatial::SideClash> clash = spatial::join_around(edges_, sides, right_)) {
      Error error = edge_error(ErrorCode::not_manifold,
                               "the faces around an edge do not bound inside and outside by turns", clash->half_edge);
      error.evidence.other_face = origin_[edges_.face[clash->other]];
      add(std::move(error));
      closed = false;
    }
    shells_ = spatial::find_shells(edges_);
    check_.shells = shells_.count;
    return closed;
  }

  void check_meetings() {
    triangles_ = spatial::triangulated(right_);
    boxes_ = spatial::boxes_of(right_.vertices, triangles_.triangles);
    const auto meetings =
        spatial::find_meetings(right_, triangles_, boxes_, std::vector<bool>(triangles_.triangles.size(), true));
    std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
    for (const auto& [s, t] : meetings) {
      const auto [f, g] = std::minmax(triangles_.face[s], triangles_.face[t]);
      if (f == g || !seen.emplace(f, g).second) continue;
      ++check_.crossings;
      ++check_.count;
      if (check_.faults.size() == options_.listed) continue;
      Error error = spatial::contact_error(right_, triangles_, {f, g, between(s, t)});
      error.evidence.face = origin_[static_cast<std::size_t>(*error.evidence.face)];
      error.evidence.other_face = origin_[static_cast<std::size_t>(*error.evidence.other_face)];
      check_.faults.push_back(std::move(error));
    }
  }

  /// In the boxes of both triangles.
  Point3 between(std::uint32_t s, std::uint32_t t) const {
    const spatial::Box &a = boxes_.box(s), &b = boxes_.box(t);
    const auto halfway = [](double a0, double a1, double b0, double b1) {
      return std::max(a0, b0) / 2 + std::min(a1, b1) / 2;
    };
    return {halfway(a.low.x, a.high.x, b.low.x, b.high.x), halfway(a.low.y, a.high.y, b.low.y, b.high.y),
            halfway(a.low.z, a.high.z, b.low.z, b.high.z)};
  }

  void check_shells() {
    check_.volume = exact::to_rational(spatial::exact_volume(right_));
    const std::vector<int> signs = spatial::shell_signs(right_, shells_);
    std::vector<std::uint32_t> first(shells_.count);
    for (std::size_t f = right_.faces.size(); f-- > 0;) first[shells_.of_face[f]] = origin_[f];
    const std::vector<std::uint32_t> depths = check_.crossings == 0
                                                  ? spatial::shell_depths(right_, shells_, triangles_, boxes_)
                                                  : std::vector<std::uint32_t>();
    for (std::uint32_t shell = 0; shell < shells_.count; ++shell) {
      const std::uint32_t f = first[shell];
      if (signs[shell] == 0) add(face_error_at(ErrorCode::no_area, "a shell encloses no volume", f));
      else if (depths.empty()) continue;
      else if (depths[shell] % 2 == 0 && signs[shell] < 0)
        add(face_error_at(ErrorCode::wrong_orientation, "a shell is inside out", f));
      else if (depths[shell] % 2 == 1 && signs[shell] > 0)
        add(face_error_at(ErrorCode::wrong_orientation,
                          "a shell inside another one does not run inward, around a cavity", f));
    }
  }

  const MeshData& data_;
  const MeshCheckOptions& options_;
  MeshCheck check_;
  std::vector<std::uint32_t> first_;   // of the vertices at each one's position
  MeshData right_;                     // what is right by itself
  std::vector<std::uint32_t> origin_;  // of its faces
  spatial::HalfEdges edges_;
  spatial::Shells shells_;
  spatial::Triangles triangles_;
  spatial::BoxTree boxes_;
};

}  // namespace

MeshCheck check_mesh(const MeshData& data, const MeshCheckOptions& options) { return FaultList(data, options).run(); }

}  // namespace dymsum
