#include "spatial/sum/rounded_surface.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "exact/orient.h"
#include "spatial/mesh/surface_crossings.h"

namespace dymsum::spatial {
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
