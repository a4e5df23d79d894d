// The named repair of meshes.
#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>

#include "dymsum/mesh.h"
#include "exact/orient3.h"
#include "spatial/mesh/edge_order.h"
#include "spatial/mesh/edge_splits.h"
#include "spatial/mesh/equal_positions.h"
#include "spatial/mesh/mesh_orient.h"
#include "spatial/mesh/mesh_repair.h"
#include "spatial/mesh/mesh_validate.h"
#include "spatial/mesh/open_edges.h"
#include "spatial/mesh/surface_crossings.h"
#include "spatial/mesh/thin_faces.h"
#include "spatial/mesh/triangulate.h"

namespace dymsum {

namespace spatial {

namespace {

struct RepairOptions {
  bool thin_parts = false;    ///< points, segments and open surfaces stay
  bool drop_needles = false;  ///< triangles that are nearly a line go
};

class MeshRepair {
 public:
  MeshRepair(MeshData data, const RepairOptions& options) : data_(std::move(data)), options_(options) {}

  Result<RepairedMesh> run() {
    if (auto error = check_lists()) return *std::move(error);
    repair_faces();
    orient();
    drop_unused_vertices();
    Result<Mesh> mesh = options_.thin_parts ? Mesh::with_thin_parts(std::move(data_)) : Mesh::create(std::move(data_));
    if (!mesh) return in_the_input(mesh.error());
    return RepairedMesh{std::move(mesh).value(), report_};
  }

  Result<PreparedSurface> prepare() {
    if (auto error = check_lists()) return *std::move(error);
    repair_faces();
    report_.reversed_faces = turn_faces(data_);
    drop_unused_vertices();
    return PreparedSurface{std::move(data_), report_};
  }

 private:
  std::optional<Error> check_lists() const {
    if (auto error = check_finite(data_.vertices)) return error;
    return check_indices(data_);
  }

  void repair_faces() {
    merge_vertices();
    drop_degenerate_faces();
    if (options_.drop_needles) drop_needles();
    if (!options_.thin_parts) close_cracks_of_faces();
    split_edges();
    if (!options_.thin_parts) fill_small_holes();
    split_faces();
  }

  /// Every face names the first of the vertices at its positions.
  void merge_vertices() {
    const std::vector<std::uint32_t> first = first_at_position(data_.vertices);
    is_duplicate_.resize(first.size());
    for (std::uint32_t v = 0; v < first.size(); ++v) {
      is_duplicate_[v] = first[v] != v;
      report_.duplicate_vertices += is_duplicate_[v];
    }
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
    const std::vector<std::int64_t> before = std::exchange(face_origin_, {});
    for (std::size_t f = 0; f < data_.faces.size(); ++f) {
      Face face = std::move(data_.faces[f]);
      const bool thin = options_.thin_parts && (face.size() == 1 || face.size() == 2);
      face.erase(std::unique(face.begin(), face.end()), face.end());
      while (face.size() > 1 && face.front() == face.back()) face.pop_back();
      if (!thin && !has_area(face)) {
        ++report_.degenerate_faces;
        continue;
      }
      kept.push_back(std::move(face));
      face_origin_.push_back(before.empty() ? static_cast<std::int64_t>(f) : before[f]);
    }
    data_.faces = std::move(kept);
  }

  template <class Drop>
  std::size_t drop_faces(Drop drop) {
    std::size_t kept = 0;
    const std::size_t all = data_.faces.size();
    for (std::size_t f = 0; f < all; ++f) {
      if (drop(f)) continue;
      if (kept != f) data_.faces[kept] = std::move(data_.faces[f]);
      face_origin_[kept++] = face_origin_[f];
    }
    data_.faces.resize(kept);
    face_origin_.resize(kept);
    return all - kept;
  }

  void drop_needles() {
    const std::vector<bool> thin = options_.thin_parts ? thin_faces(data_.faces) : std::vector<bool>{};
    report_.needles = drop_faces(
        [&](std::size_t f) { return (thin.empty() || !thin[f]) && is_needle(data_.vertices, data_.faces[f]); });
  }

  void split_edges() {
    const EdgeSplits splits = split_open_edges(data_.vertices, data_.faces);
    report_.split_edges += splits.count;
    report_.largest_gap = std::max(report_.largest_gap, splits.largest_gap);
  }

  /// Before edges are split: what lies along a crack may be near its other side's edges, too.
  void close_cracks_of_faces() {
    const ClosedCracks cracks = close_cracks(data_.vertices, data_.faces);
    report_.cracks = cracks.merged;
    report_.largest_crack = cracks.furthest;
    if (cracks.merged > 0) drop_degenerate_faces();
  }

  void fill_small_holes() {
    const FilledHoles holes = fill_holes(data_.vertices, data_.faces);
    report_.holes = holes.count;
    for (const std::uint32_t f : holes.beside) face_origin_.push_back(face_origin_[f]);
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

  /// What bounds a solid is oriented; it does not matter which way parts without volume run. What parts the inside of
  /// the solid bounds nothing, and is dropped where parts without volume are not kept.
  void orient() {
    std::vector<bool> thin = options_.thin_parts ? thin_faces(data_.faces) : std::vector<bool>{};
    thin.resize(data_.faces.size());
    for_the_others(thin, [&](MeshData& solid, const std::vector<std::size_t>& origin) {
      report_.reversed_faces = turn_faces(solid);
      const std::vector<bool> inner = inner_faces(solid);
      for (std::size_t k = 0; k < inner.size(); ++k)
        if (inner[k]) thin[origin[k]] = true;
    });
    for_the_others(thin, [&](MeshData& solid, const std::vector<std::size_t>&) {
      const TurnedShells turned = turn_shells(solid);
      report_.reversed_shells = turned.count;
      report_.cavities = turned.cavities;
    });
    if (!options_.thin_parts) report_.membranes = drop_faces([&](std::size_t f) { return bool{thin[f]}; });
  }

  /// Membranes; none where faces cross, as what begins inside may end outside then.
  static std::vector<bool> inner_faces(const MeshData& solid) {
    std::vector<bool> inner = all_faces_valid(solid) ? membranes(solid) : std::vector<bool>{};
    if (inner.empty()) return inner;
    const Triangles triangles = triangulated(solid);
    if (find_meeting(solid, triangles, boxes_of(solid.vertices, triangles.triangles))) inner.clear();
    return inner;
  }

  /// f(the faces that are not `left_out`, their indices).
  template <class F>
  void for_the_others(const std::vector<bool>& left_out, F f) {
    MeshData others{data_.vertices, {}};
    std::vector<std::size_t> origin;
    for (std::size_t k = 0; k < left_out.size(); ++k) {
      if (left_out[k]) continue;
      others.faces.push_back(std::move(data_.faces[k]));
      origin.push_back(k);
    }
    f(others, origin);
    for (std::size_t k = 0; k < origin.size(); ++k) data_.faces[origin[k]] = std::move(others.faces[k]);
  }

  void drop_unused_vertices() {
    std::vector<bool> used(data_.vertices.size());
    for (const Face& face : data_.faces) {
      for (const std::uint32_t v : face) used[v] = true;
    }
    std::vector<std::uint32_t> position(data_.vertices.size());
    std::vector<Point3> kept;
    for (std::size_t v = 0; v < used.size(); ++v) {
      if (!used[v]) {
        report_.unused_vertices += !is_duplicate_[v];
        continue;
      }
      position[v] = static_cast<std::uint32_t>(kept.size());
      kept.push_back(data_.vertices[v]);
      vertex_origin_.push_back(static_cast<std::int64_t>(v));
    }
    data_.vertices = std::move(kept);
    for (Face& face : data_.faces) {
      for (std::uint32_t& v : face) v = position[v];
    }
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
  RepairOptions options_;
  MeshRepairReport report_;
  std::vector<bool> is_duplicate_;
  std::vector<std::int64_t> face_origin_, vertex_origin_;
};

/// Triangles that are nearly a line are dropped only where they are in the way.
Result<RepairedMesh> repaired(MeshData data, RepairOptions options) {
  Result<RepairedMesh> made = MeshRepair(data, options).run();
  if (made || made.error().code != ErrorCode::faces_cross) return made;
  const auto needle = [&](const Face& face) { return is_needle(data.vertices, face); };
  if (std::none_of(data.faces.begin(), data.faces.end(), needle)) return made;
  options.drop_needles = true;
  Result<RepairedMesh> without = MeshRepair(std::move(data), options).run();
  return without ? without : made;
}

}  // namespace

Result<PreparedSurface> prepared_surface(MeshData data) { return MeshRepair(std::move(data), {}).prepare(); }

}  // namespace spatial

Result<RepairedMesh> repair(MeshData data) { return spatial::repaired(std::move(data), {}); }

Result<RepairedMesh> repair_with_thin_parts(MeshData data) {
  spatial::RepairOptions options;
  options.thin_parts = true;
  return spatial::repaired(std::move(data), options);
}

std::string MeshRepairReport::to_string() const {
  std::string text;
  const auto say = [&](std::size_t n, const char* one, const char* many) {
    if (n > 0) text += (text.empty() ? "" : ", ") + std::to_string(n) + " " + (n == 1 ? one : many);
  };
  say(duplicate_vertices, "duplicate vertex merged", "duplicate vertices merged");
  say(unused_vertices, "unused vertex dropped", "unused vertices dropped");
  say(degenerate_faces, "face without area dropped", "faces without area dropped");
  say(needles, "needle that lay on its neighbours dropped", "needles that lay on their neighbours dropped");
  say(split_edges, "edge split at vertices of its neighbours", "edges split at vertices of their neighbours");
  if (largest_gap > 0) {
    char gap[32];
    std::snprintf(gap, sizeof gap, "%.3g", largest_gap);
    text += std::string(" (the furthest ") + gap + " off)";
  }
  say(cracks, "vertex merged across a crack", "vertices merged across cracks");
  if (cracks > 0) {
    char wide[32];
    std::snprintf(wide, sizeof wide, "%.3g", largest_crack);
    text += std::string(" (at most ") + wide + " wide)";
  }
  say(holes, "small hole filled", "small holes filled");
  say(split_faces, "face split into triangles", "faces split into triangles");
  say(reversed_faces, "face turned over", "faces turned over");
  say(reversed_shells, "shell turned right", "shells turned right");
  say(cavities, "shell that ran the same way as the one around it made a cavity",
      "shells that ran the same way as those around them made cavities");
  say(membranes, "face inside the solid dropped", "faces inside the solid dropped");
  if (united) {
    text += std::string(text.empty() ? "" : ", ") + "what crossed or overlapped united (" +
            std::to_string(united_crossings) + (united_crossings == 1 ? " new vertex" : " new vertices");
    if (united_distance > 0) {
      char within[48];
      std::snprintf(within, sizeof within, ", merged within %.3g", united_distance);
      text += within;
    }
    text += ")";
  }
  return text.empty() ? "nothing to repair" : text;
}

}  // namespace dymsum
