#include "spatial/sum/surface_edits.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "base/scratch.h"
#include "exact/orient.h"
#include "spatial/mesh/surface_crossings.h"

namespace dymsum::spatial {
namespace {

bool has_corner(const SurfaceEdits::Part& part, std::uint32_t v) {
  return std::find(part.v.begin(), part.v.end(), v) != part.v.end();
}

/// b is a, turned over.
bool turned_over(const std::array<std::uint32_t, 3>& a, const std::array<std::uint32_t, 3>& b) {
  const auto first = std::find(b.begin(), b.end(), a[0]);
  if (first == b.end()) return false;
  const auto k = static_cast<std::size_t>(first - b.begin());
  return b[(k + 1) % 3] == a[2] && b[(k + 2) % 3] == a[1];
}

}  // namespace

SurfaceEdits::SurfaceEdits(const MeshData& triangles, const std::vector<std::uint32_t>& faces, double moved)
    : at_(triangles.vertices), around_(triangles.vertices.size()), moved_(moved) {
  for (std::size_t t = 0; t < triangles.faces.size(); ++t) {
    const Face& f = triangles.faces[t];
    for (const std::uint32_t v : f) around_[v].push_back(static_cast<std::uint32_t>(parts_.size()));
    parts_.push_back({{f[0], f[1], f[2]}, faces[t], moved, true});
  }
}

std::uint32_t SurfaceEdits::add_vertex(const Point3& at) {
  at_.push_back(at);
  around_.emplace_back();
  return static_cast<std::uint32_t>(at_.size() - 1);
}

void SurfaceEdits::kill(std::uint32_t part) { parts_[part].live = false; }

void SurfaceEdits::add(const Part& part) {
  moved_ = std::max(moved_, part.moved);
  if (part.v[0] == part.v[1] || part.v[1] == part.v[2] || part.v[2] == part.v[0]) return;
  for (const std::uint32_t other : around_[part.v[0]]) {
    if (!parts_[other].live || !turned_over(part.v, parts_[other].v)) continue;
    kill(other);
    return;
  }
  const auto index = static_cast<std::uint32_t>(parts_.size());
  parts_.push_back(part);
  for (const std::uint32_t v : part.v) around_[v].push_back(index);
}

bool SurfaceEdits::has_edge(std::uint32_t a, std::uint32_t b) const {
  return std::any_of(around_[a].begin(), around_[a].end(),
                     [&](std::uint32_t t) { return parts_[t].live && has_corner(parts_[t], b); });
}

void SurfaceEdits::merge(std::uint32_t u, std::uint32_t w, double by) {
  const std::vector<std::uint32_t> old = std::move(around_[u]);
  around_[u].clear();
  for (const std::uint32_t t : old) {
    if (!parts_[t].live) continue;
    Part part = parts_[t];
    kill(t);
    part.moved += by;
    std::replace(part.v.begin(), part.v.end(), u, w);
    add(part);
  }
}

void SurfaceEdits::split_edge(std::uint32_t a, std::uint32_t b, std::uint32_t p, double by) {
  const std::vector<std::uint32_t> old = around_[a];
  for (const std::uint32_t t : old) {
    if (!parts_[t].live || !has_corner(parts_[t], b)) continue;
    Part part = parts_[t];
    kill(t);
    part.moved += by;
    for (const std::uint32_t end : {a, b}) {
      Part half = part;
      std::replace(half.v.begin(), half.v.end(), end, p);
      add(half);
    }
  }
}

void SurfaceEdits::split_part(std::uint32_t index, std::uint32_t p, double by) {
  Part part = parts_[index];
  kill(index);
  part.moved += by;
  for (std::size_t k = 0; k < 3; ++k) {
    Part third = part;
    third.v[k] = p;
    add(third);
  }
}

SurfaceTopology topology_of(const MeshData& mesh) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  edges.reserve(3 * mesh.faces.size());
  UnionFind pieces(static_cast<std::uint32_t>(mesh.vertices.size()));
  for (const Face& face : mesh.faces) {
    for (std::size_t k = 0; k < face.size(); ++k) {
      const std::uint32_t a = face[k], b = face[(k + 1) % face.size()];
      edges.emplace_back(std::min(a, b), std::max(a, b));
      pieces.unite(a, b);
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  SurfaceTopology found;
  for (std::uint32_t v = 0; v < pieces.size(); ++v) found.pieces += pieces.root(v) == v;
  found.euler = static_cast<std::int64_t>(mesh.vertices.size()) - static_cast<std::int64_t>(edges.size()) +
                static_cast<std::int64_t>(mesh.faces.size());
  return found;
}

namespace {

Error error_at(const char* message, const Point3& p) {
  Error error{ErrorCode::rounding_changed_topology, message, {}};
  error.evidence.x = p.x;
  error.evidence.y = p.y;
  error.evidence.z = p.z;
  return error;
}

}  // namespace

std::optional<Error> rounding_error(const MeshData& mesh) {
  std::vector<Point3> sorted = mesh.vertices;
  std::sort(sorted.begin(), sorted.end(),
            [](const Point3& a, const Point3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); });
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end()) return error_at("two vertices round to one place", *twice);
  Triangles triangles;
  for (const Face& face : mesh.faces) {
    const Point3 &a = mesh.vertices[face[0]], &b = mesh.vertices[face[1]], &c = mesh.vertices[face[2]];
    if (exact::collinear(a, b, c)) return error_at("a triangle rounds to a line", a);
    triangles.triangles.push_back({face[0], face[1], face[2]});
  }
  triangles.face.resize(mesh.faces.size());
  std::iota(triangles.face.begin(), triangles.face.end(), 0u);
  const auto meeting = find_meeting(mesh, triangles, boxes_of(mesh.vertices, triangles.triangles));
  if (!meeting) return std::nullopt;
  return error_at("two faces cross or touch once they are rounded", meeting->at);
}

}  // namespace dymsum::spatial
