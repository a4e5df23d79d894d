#include "spatial/mesh/mesh_validate.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "spatial/mesh/edge_order.h"
#include "spatial/mesh/equal_positions.h"
#include "spatial/mesh/face_contact.h"
#include "spatial/mesh/face_plane.h"
#include "spatial/mesh/half_edges.h"
#include "spatial/mesh/shell_nesting.h"
#include "spatial/mesh/six_volume.h"
#include "spatial/mesh/surface_crossings.h"
#include "spatial/mesh/thin_faces.h"

namespace dymsum {

Result<Mesh> Mesh::create(MeshData data) {
  spatial::MeshValidation checked = spatial::validate(data);
  if (checked.error) return *std::move(checked.error);
  return spatial::trusted_mesh(std::move(data), checked.shells);
}

Result<Mesh> Mesh::with_thin_parts(MeshData data) {
  std::vector<bool> thin;
  spatial::MeshValidation checked = spatial::validate_with_thin_parts(data, thin);
  if (checked.error) return *std::move(checked.error);
  return spatial::trusted_mesh(std::move(data), checked.shells, std::move(thin));
}

namespace spatial {

struct MeshInternals {
  static Mesh make(MeshData data, std::size_t shells, std::vector<bool> thin) {
    Mesh mesh;
    mesh.data_ = std::move(data);
    mesh.shells_ = shells;
    mesh.thin_ = std::move(thin);
    return mesh;
  }
};

Mesh trusted_mesh(MeshData data, std::size_t shells, std::vector<bool> thin) {
  return MeshInternals::make(std::move(data), shells, std::move(thin));
}

std::optional<Error> check_finite(const std::vector<Point3>& vertices) {
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Point3& p = vertices[i];
    if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) continue;
    Error error{ErrorCode::not_finite, "a coordinate is not a finite number", {}};
    error.evidence.vertex = static_cast<std::int64_t>(i);
    return error;
  }
  return std::nullopt;
}

std::optional<Error> check_indices(const MeshData& data) {
  for (std::size_t f = 0; f < data.faces.size(); ++f) {
    for (const std::uint32_t v : data.faces[f]) {
      if (v < data.vertices.size()) continue;
      Error error{ErrorCode::bad_index, "a face names a vertex that does not exist", {}};
      error.evidence.face = static_cast<std::int64_t>(f);
      error.evidence.vertex = v;
      return error;
    }
  }
  return std::nullopt;
}

namespace {

class MeshCheck {
 public:
  /// `least` vertices a face.
  MeshCheck(const MeshData& data, std::size_t least) : data_(data), least_(least) {}

  /// Vertices, and faces by themselves.
  std::optional<Error> check_lists() const {
    if (auto error = check_finite(data_.vertices)) return error;
    if (auto error = check_indices(data_)) return error;
    if (auto error = check_corners()) return error;
    if (auto error = check_positions()) return error;
    if (auto error = check_use()) return error;
    return check_faces();
  }
  /// How faces meet.
  std::optional<Error> check_surface() {
    edges_ = half_edges_without_twins(data_.faces);
    if (auto error = check_edges()) return error;
    if (auto error = check_volumes()) return error;
    triangles_ = triangulated(data_);
    boxes_ = boxes_of(data_.vertices, triangles_.triangles);
    if (auto error = check_meetings()) return error;
    return check_orientations();
  }
  std::size_t shell_count() const { return shells_.count; }

 private:
  Error error_at(ErrorCode code, std::string message, std::uint32_t vertex) const {
    Error error{code, std::move(message), {}};
    const Point3& p = data_.vertices[vertex];
    error.evidence.vertex = vertex;
    error.evidence.x = p.x;
    error.evidence.y = p.y;
    error.evidence.z = p.z;
    return error;
  }
  Error edge_error(ErrorCode code, std::string message, std::uint32_t h) const {
    Error error = error_at(code, std::move(message), edges_.origin[h]);
    error.evidence.other_vertex = edges_.target(h);
    error.evidence.face = edges_.face[h];
    return error;
  }

  std::optional<Error> check_corners() const {
    std::vector<std::size_t> last_face(data_.vertices.size(), data_.faces.size());
    for (std::size_t f = 0; f < data_.faces.size(); ++f) {
      const Face& face = data_.faces[f];
      if (face.size() < least_) {
        Error error{ErrorCode::too_few_vertices,
                    least_ == 1 ? "a face without vertices" : "a face needs at least three vertices",
                    {}};
        if (!face.empty()) error = error_at(error.code, std::move(error.message), face[0]);
        error.evidence.face = static_cast<std::int64_t>(f);
        return error;
      }
      for (const std::uint32_t v : face) {
        if (std::exchange(last_face[v], f) != f) continue;
        Error error = error_at(ErrorCode::repeated_vertex, "a face has a vertex twice", v);
        error.evidence.face = static_cast<std::int64_t>(f);
        return error;
      }
    }
    return std::nullopt;
  }

  std::optional<Error> check_positions() const {
    const std::vector<std::uint32_t> order = order_by_position(data_.vertices);
    for (std::size_t i = 1; i < order.size(); ++i) {
      if (data_.vertices[order[i - 1]] != data_.vertices[order[i]]) continue;
      Error error = error_at(ErrorCode::repeated_vertex, "two vertices are at the same place", order[i - 1]);
      error.evidence.other_vertex = order[i];
      return error;
    }
    return std::nullopt;
  }

  std::optional<Error> check_use() const {
    std::vector<bool> used(data_.vertices.size());
    for (const Face& face : data_.faces) {
      for (const std::uint32_t v : face) used[v] = true;
    }
    const auto unused = std::find(used.begin(), used.end(), false);
    if (unused == used.end()) return std::nullopt;
    return error_at(ErrorCode::bad_index, "no face uses this vertex",
                    static_cast<std::uint32_t>(unused - used.begin()));
  }

  std::optional<Error> check_faces() const {
    for (std::size_t f = 0; f < data_.faces.size(); ++f) {
      if (data_.faces[f].size() < 3) continue;
      std::optional<Error> error = face_error(data_.vertices, data_.faces[f]);
      if (!error) continue;
      error->evidence.face = static_cast<std::int64_t>(f);
      return error;
    }
    return std::nullopt;
  }

  std::optional<Error> check_edges() {
    const std::vector<EdgeSide> sides = edge_sides(edges_);
    std::optional<Error> found;
    for_each_edge(sides, [&](const EdgeSide* first, const EdgeSide* last) {
      if (!found) found = edge_error_of(first, last);
    });
    if (found) return found;
    const std::optional<SideClash> clash = join_around(edges_, sides, data_);
    if (!clash) return std::nullopt;
    Error error = edge_error(ErrorCode::not_manifold,
                             "the faces around an edge do not bound inside and outside by turns", clash->half_edge);
    error.evidence.other_face = edges_.face[clash->other];
    return error;
  }

  std::optional<Error> edge_error_of(const EdgeSide* first, const EdgeSide* last) const {
    const std::uint32_t h = first->half_edge;
    const auto count = last - first;
    if (count == 1) return edge_error(ErrorCode::not_closed, "an edge has a face on one side only", h);
    const auto along =
        std::count_if(first, last, [&](const EdgeSide& s) { return edges_.origin[s.half_edge] == edges_.origin[h]; });
    if (2 * along == count) return std::nullopt;
    Error error = count % 2 == 1
                      ? edge_error(ErrorCode::not_manifold, "an edge has an odd number of faces", h)
                      : edge_error(ErrorCode::wrong_orientation, "two faces run through an edge in one direction", h);
    error.evidence.other_face = edges_.face[first[1].half_edge];
    return error;
  }

  std::optional<Error> check_meetings() const {
    const std::optional<FaceMeeting> meeting = find_meeting(data_, triangles_, boxes_);
    if (!meeting) return std::nullopt;
    return contact_error(data_, triangles_, *meeting);
  }

  std::optional<Error> check_volumes() {
    shells_ = find_shells(edges_);
    signs_ = shell_signs(data_, shells_);
    return first_face([&](std::uint32_t shell) { return signs_[shell] == 0; }, ErrorCode::no_area,
                      "a shell encloses no volume");
  }

  std::optional<Error> check_orientations() const {
    const std::vector<std::uint32_t> depths = shell_depths(data_, shells_, triangles_, boxes_);
    if (auto error = first_face([&](std::uint32_t shell) { return depths[shell] % 2 == 0 && signs_[shell] < 0; },
                                ErrorCode::wrong_orientation, "a shell is inside out")) {
      return error;
    }
    return first_face([&](std::uint32_t shell) { return depths[shell] % 2 == 1 && signs_[shell] > 0; },
                      ErrorCode::wrong_orientation, "a shell inside another one does not run inward, around a cavity");
  }

  /// The error at the first face of a shell that is wrong.
  template <class Wrong>
  std::optional<Error> first_face(Wrong wrong, ErrorCode code, const char* message) const {
    for (std::size_t f = 0; f < data_.faces.size(); ++f) {
      if (!wrong(shells_.of_face[f])) continue;
      Error error = error_at(code, message, data_.faces[f][0]);
      error.evidence.face = static_cast<std::int64_t>(f);
      return error;
    }
    return std::nullopt;
  }

  const MeshData& data_;
  std::size_t least_;
  HalfEdges edges_;
  Triangles triangles_;
  BoxTree boxes_;
  Shells shells_;
  std::vector<int> signs_;  // of the shells' volumes
};

/// The faces that are not thin.
struct SolidFaces {
  SolidFaces(const MeshData& all, const std::vector<bool>& thin) : data{all.vertices, {}} {
    for (std::size_t f = 0; f < all.faces.size(); ++f) {
      if (!thin.empty() && thin[f]) continue;
      data.faces.push_back(all.faces[f]);
      origin.push_back(static_cast<std::int64_t>(f));
    }
  }
  MeshData data;
  std::vector<std::int64_t> origin;
};

}  // namespace

MeshValidation validate(const MeshData& data) {
  MeshCheck check(data, 3);
  if (auto error = check.check_lists()) return {std::move(error), 0};
  if (auto error = check.check_surface()) return {std::move(error), 0};
  return {std::nullopt, check.shell_count()};
}

MeshValidation validate_with_thin_parts(const MeshData& data, std::vector<bool>& thin) {
  if (auto error = MeshCheck(data, 1).check_lists()) return {std::move(error), 0};
  thin = thin_faces(data.faces);
  SolidFaces solid(data, thin);
  if (const std::vector<bool> inner = membranes(solid.data); !inner.empty()) {
    thin.resize(data.faces.size());
    for (std::size_t f = 0; f < inner.size(); ++f)
      if (inner[f]) thin[static_cast<std::size_t>(solid.origin[f])] = true;
    solid = SolidFaces(data, thin);
  }
  MeshCheck check(solid.data, 3);
  std::optional<Error> error = check.check_surface();
  if (!error) return {std::nullopt, check.shell_count()};
  for (auto* face : {&error->evidence.face, &error->evidence.other_face})
    if (*face) *face = solid.origin[static_cast<std::size_t>(**face)];
  return {std::move(error), 0};
}

}  // namespace spatial
}  // namespace dymsum
