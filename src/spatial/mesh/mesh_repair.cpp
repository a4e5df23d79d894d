#include "spatial/mesh/mesh_repair.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dymsum/mesh.h"
#include "dymsum/named_repairs.h"
#include "exact/orient.h"
#include "spatial/mesh/half_edges.h"
#include "spatial/mesh/mesh_canonical.h"
#include "spatial/mesh/mesh_orient.h"
#include "spatial/mesh/mesh_validate.h"
#include "spatial/mesh/open_edges.h"
#include "spatial/mesh/surface_crossings.h"
#include "spatial/mesh/triangulate.h"
#include "spatial/mesh/vec3.h"

namespace dymsum::spatial {
namespace {

// Faces that are given twice.

/// From its smallest vertex on.
Face from_smallest(Face face) {
  if (!face.empty()) std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
  return face;
}

/// Whether every edge has as many faces in one direction as in the other.
bool all_edges_balanced(const std::vector<Face>& faces) {
  struct Side {
    std::array<std::uint32_t, 2> ends;
    bool forward;
  };
  std::vector<Side> sides;
  for (const Face& face : faces) {
    for (std::size_t k = 0; k < face.size(); ++k) {
      const std::uint32_t a = face[k], b = face[k + 1 < face.size() ? k + 1 : 0];
      if (a != b) sides.push_back({{std::min(a, b), std::max(a, b)}, a < b});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.ends < b.ends; });
  for (std::size_t k = 0; k < sides.size();) {
    std::int64_t more = 0;
    const std::size_t first = k;
    for (; k < sides.size() && sides[k].ends == sides[first].ends; ++k) more += sides[k].forward ? 1 : -1;
    if (more != 0) return false;
  }
  return true;
}

/// Which faces run as one before them does, vertex by vertex; empty where none does. O(n log n).
std::vector<bool> duplicate_faces(const std::vector<Face>& faces) {
  std::vector<Face> keys;
  keys.reserve(faces.size());
  for (const Face& face : faces) keys.push_back(from_smallest(face));
  std::vector<std::size_t> order(faces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return keys[a] < keys[b]; });
  std::vector<bool> again(faces.size());
  bool any = false;
  for (std::size_t k = 1; k < order.size(); ++k)
    if (keys[order[k]] == keys[order[k - 1]]) again[order[k]] = any = true;
  if (!any) again.clear();
  return again;
}

}  // namespace
}  // namespace dymsum::spatial

namespace dymsum {

// The named repair of meshes.

namespace spatial {
namespace {

struct RepairMode {
  bool thin_parts = false;    ///< points, segments and open surfaces stay
  bool drop_needles = false;  ///< triangles that are nearly a line go
};

class MeshRepair {
 public:
  MeshRepair(MeshData data, const MeshRepairOptions& options, const RepairMode& mode)
      : data_(std::move(data)), options_(options), mode_(mode) {}

  Result<LoggedMesh> run() {
    if (auto error = check_lists()) return *std::move(error);
    repair_faces();
    orient();
    drop_unused_vertices();
    Result<Mesh> mesh = mode_.thin_parts ? Mesh::with_thin_parts(std::move(data_)) : Mesh::create(std::move(data_));
    if (!mesh) return in_the_input(mesh.error());
    log_.marks = marks_.all();
    return LoggedMesh{std::move(mesh).value(), std::move(log_)};
  }

  Result<PreparedSurface> prepare() {
    if (auto error = check_lists()) return *std::move(error);
    repair_faces();
    if (may(MeshRepairKind::reversed_faces)) reverse_faces(data_);
    drop_unused_vertices();
    log_.marks = marks_.all();
    return PreparedSurface{std::move(data_), std::move(log_)};
  }

 private:
  std::optional<Error> check_lists() const {
    if (auto error = check_finite(data_.vertices)) return error;
    return check_indices(data_);
  }

  bool may(MeshRepairKind kind) const { return allows(options_, kind); }
  void mark(MeshRepairKind kind, std::uint32_t vertex) { marks_.add(kind, data_.vertices[vertex]); }
  void mark_face(MeshRepairKind kind, const Face& face) {
    if (!face.empty()) mark(kind, face.front());
  }

  void repair_faces() {
    was_used_ = used_vertices();
    merge_vertices();
    drop_degenerate_faces();
    if (may(MeshRepairKind::duplicate_faces)) drop_duplicate_faces();
    if (mode_.drop_needles) drop_needles();
    if (!mode_.thin_parts && may(MeshRepairKind::cracks)) close_cracks_of_faces();
    if (may(MeshRepairKind::t_junctions)) split_edges();
    if (!mode_.thin_parts && may(MeshRepairKind::holes)) fill_small_holes();
    if (may(MeshRepairKind::split_faces)) split_faces();
  }

  /// Every face names the first of the vertices at its positions.
  void merge_vertices() {
    is_duplicate_.resize(data_.vertices.size());
    if (!may(MeshRepairKind::duplicate_vertices)) return;
    const std::vector<std::uint32_t> first = first_at_position(data_.vertices);
    for (std::uint32_t v = 0; v < first.size(); ++v) {
      is_duplicate_[v] = first[v] != v;
      if (!is_duplicate_[v]) continue;
      ++log_.counts.duplicate_vertices;
      mark(MeshRepairKind::duplicate_vertices, v);
    }
    for (Face& face : data_.faces) {
      for (std::uint32_t& v : face) v = first[v];
    }
  }

  static void drop_repeated(Face& face) {
    face.erase(std::unique(face.begin(), face.end()), face.end());
    while (face.size() > 1 && face.front() == face.back()) face.pop_back();
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
      const bool thin = mode_.thin_parts && (face.size() == 1 || face.size() == 2);
      if (may(MeshRepairKind::duplicate_vertices)) drop_repeated(face);
      if (!thin && may(MeshRepairKind::faces_without_area) && !has_area(face)) {
        ++log_.counts.degenerate_faces;
        mark_face(MeshRepairKind::faces_without_area, face);
        on_a_line_.push_back(std::move(face));
        continue;
      }
      kept.push_back(std::move(face));
      face_origin_.push_back(before.empty() ? static_cast<std::int64_t>(f) : before[f]);
    }
    data_.faces = std::move(kept);
  }

  /// Drops faces, with a mark for each; returns how many.
  template <class Drop>
  std::size_t drop_faces(MeshRepairKind kind, Drop drop) {
    for (std::size_t f = 0; f < data_.faces.size(); ++f)
      if (drop(f)) mark_face(kind, data_.faces[f]);
    return erase_faces(drop);
  }
  template <class Drop>
  std::size_t erase_faces(Drop drop) {
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

  /// Where all edges have as many faces in one direction as in the other, nothing is dropped: these are bodies given
  /// twice, which are bodies that overlap. Faces on a line that were dropped may close the others.
  void drop_duplicate_faces() {
    const std::vector<bool> again = duplicate_faces(data_.faces);
    if (again.empty() || all_edges_balanced(data_.faces)) return;
    std::vector<Face> with_lines = data_.faces;
    with_lines.insert(with_lines.end(), on_a_line_.begin(), on_a_line_.end());
    if (all_edges_balanced(with_lines)) return;
    log_.duplicate_faces = drop_faces(MeshRepairKind::duplicate_faces, [&](std::size_t f) { return bool{again[f]}; });
  }

  void drop_needles() {
    const std::vector<bool> thin = mode_.thin_parts ? thin_faces(data_.faces) : std::vector<bool>{};
    log_.counts.needles = drop_faces(MeshRepairKind::needles, [&](std::size_t f) {
      return (thin.empty() || !thin[f]) && is_needle(data_.vertices, data_.faces[f]);
    });
  }

  void split_edges() {
    const EdgeSplits splits = split_open_edges(data_.vertices, data_.faces);
    log_.counts.split_edges += splits.at.size();
    for (const std::uint32_t v : splits.at) mark(MeshRepairKind::t_junctions, v);
    log_.counts.largest_gap = std::max(log_.counts.largest_gap, splits.largest_gap);
  }

  /// Closes cracks before edges are split: what lies along a crack may be near its other side's edges, too.
  void close_cracks_of_faces() {
    const ClosedCracks cracks = close_cracks(data_.vertices, data_.faces, options_.crack_width);
    log_.counts.cracks = cracks.merged.size();
    log_.counts.largest_crack = cracks.furthest;
    for (const std::uint32_t v : cracks.merged) mark(MeshRepairKind::cracks, v);
    if (cracks.merged.empty()) return;
    for (Face& face : data_.faces) drop_repeated(face);
    drop_degenerate_faces();
  }

  void fill_small_holes() {
    const FilledHoles holes = fill_holes(data_.vertices, data_.faces, options_.hole_length);
    log_.counts.holes = holes.at.size();
    log_.longest_hole = holes.longest;
    for (const std::uint32_t v : holes.at) mark(MeshRepairKind::holes, v);
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
      log_.counts.split_faces += pieces.size() > 1;
      if (pieces.size() > 1) mark_face(MeshRepairKind::split_faces, pieces.front());
      origins.insert(origins.end(), pieces.size(), face_origin_[f]);
      faces.insert(faces.end(), pieces.begin(), pieces.end());
    }
    data_.faces = std::move(faces);
    face_origin_ = std::move(origins);
  }

  void reverse_faces(MeshData& data) {
    const std::vector<std::uint32_t> turned = turn_faces(data);
    log_.counts.reversed_faces = turned.size();
    for (const std::uint32_t f : turned) mark_face(MeshRepairKind::reversed_faces, data.faces[f]);
  }

  /// What bounds a solid is oriented; it does not matter which way parts without volume run. What parts the inside of
  /// the solid bounds nothing, and is dropped where parts without volume are not kept.
  void orient() {
    std::vector<bool> thin = mode_.thin_parts ? thin_faces(data_.faces) : std::vector<bool>{};
    thin.resize(data_.faces.size());
    std::vector<bool> nested(data_.faces.size());
    for_the_others(thin, [&](MeshData& solid, const std::vector<std::size_t>& origin) {
      if (may(MeshRepairKind::reversed_faces)) reverse_faces(solid);
      if (!mode_.thin_parts && !may(MeshRepairKind::membranes)) return;
      const std::vector<bool> inner = inner_faces(solid);
      for (std::size_t k = 0; k < inner.size(); ++k)
        if (inner[k]) thin[origin[k]] = true;
    });
    for_the_others(thin, [&](MeshData& solid, const std::vector<std::size_t>& origin) {
      const TurnedShells turned = orient_shells(solid);
      for (std::size_t k = 0; k < turned.dropped.size(); ++k) nested[origin[k]] = turned.dropped[k];
    });
    if (!mode_.thin_parts)
      log_.counts.membranes = drop_faces(MeshRepairKind::membranes, [&](std::size_t f) { return bool{thin[f]}; });
    // Where there are nested bodies there are no membranes: shells are closed, and nothing was dropped.
    if (log_.nested_bodies > 0) erase_faces([&](std::size_t f) { return bool{nested[f]}; });
  }

  TurnedShells orient_shells(MeshData& solid) {
    ShellRepairs repairs{may(MeshRepairKind::reversed_shells), std::nullopt};
    if (may(MeshRepairKind::nested_shells)) repairs.nested = options_.nested;
    TurnedShells turned = turn_shells(solid, repairs);
    log_.counts.reversed_shells = turned.turned.size();
    log_.counts.cavities = turned.cavities.size();
    log_.nested_bodies = turned.bodies.size();
    for (const std::uint32_t f : turned.bodies) mark_face(MeshRepairKind::nested_shells, solid.faces[f]);
    for (const std::uint32_t f : turned.cavities) mark_face(MeshRepairKind::nested_shells, solid.faces[f]);
    for (const std::uint32_t f : turned.turned)
      if (std::find(turned.cavities.begin(), turned.cavities.end(), f) == turned.cavities.end())
        mark_face(MeshRepairKind::reversed_shells, solid.faces[f]);
    return turned;
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

  std::vector<bool> used_vertices() const {
    std::vector<bool> used(data_.vertices.size());
    for (const Face& face : data_.faces) {
      for (const std::uint32_t v : face) used[v] = true;
    }
    return used;
  }

  /// Those that only a repair has left without a face are a part of that one: they are counted, and have no mark.
  void drop_unused_vertices() {
    const std::vector<bool> used = used_vertices();
    std::vector<std::uint32_t> position(data_.vertices.size());
    std::vector<Point3> kept;
    for (std::size_t v = 0; v < used.size(); ++v) {
      const bool by_itself = !was_used_[v] && !is_duplicate_[v];
      if (!used[v] && (!by_itself || may(MeshRepairKind::unused_vertices))) {
        log_.counts.unused_vertices += !is_duplicate_[v];
        if (by_itself) mark(MeshRepairKind::unused_vertices, static_cast<std::uint32_t>(v));
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
  const MeshRepairOptions& options_;
  RepairMode mode_;
  MeshRepairLog log_;
  RepairMarks marks_;
  std::vector<Face> on_a_line_;                ///< faces that were dropped as they have no area
  std::vector<bool> is_duplicate_, was_used_;  ///< of vertices: whether one before has its position; at first
  std::vector<std::int64_t> face_origin_, vertex_origin_;
};

/// Triangles that are nearly a line are dropped only where they are in the way.
Result<LoggedMesh> repaired(MeshData data, const MeshRepairOptions& options, RepairMode mode) {
  Result<LoggedMesh> made = MeshRepair(data, options, mode).run();
  if (made || made.error().code != ErrorCode::faces_cross || !allows(options, MeshRepairKind::needles)) return made;
  const auto needle = [&](const Face& face) { return is_needle(data.vertices, face); };
  if (std::none_of(data.faces.begin(), data.faces.end(), needle)) return made;
  mode.drop_needles = true;
  Result<LoggedMesh> without = MeshRepair(std::move(data), options, mode).run();
  return without ? without : made;
}

}  // namespace

Result<PreparedSurface> prepared_surface(MeshData data, const MeshRepairOptions& options) {
  return MeshRepair(std::move(data), options, {}).prepare();
}

}  // namespace spatial

namespace {

Result<RepairedMesh> without_log(Result<LoggedMesh> logged) {
  if (!logged) return logged.error();
  LoggedMesh mesh = std::move(logged).value();
  return RepairedMesh{std::move(mesh.mesh), mesh.log.counts};
}

}  // namespace

Result<LoggedMesh> repair(MeshData data, const MeshRepairOptions& options) {
  return spatial::repaired(std::move(data), options, {});
}
Result<LoggedMesh> repair_with_thin_parts(MeshData data, const MeshRepairOptions& options) {
  spatial::RepairMode mode;
  mode.thin_parts = true;
  return spatial::repaired(std::move(data), options, mode);
}

Result<RepairedMesh> repair(MeshData data) { return without_log(repair(std::move(data), MeshRepairOptions{})); }
Result<RepairedMesh> repair_with_thin_parts(MeshData data) {
  return without_log(repair_with_thin_parts(std::move(data), MeshRepairOptions{}));
}

}  // namespace dymsum
