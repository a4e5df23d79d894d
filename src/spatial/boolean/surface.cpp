#include "spatial/boolean/surface.h"

#include <algorithm>
#include <utility>

#include "exact/orient.h"
#include "spatial/mesh/triangulate.h"
#include "spatial/mesh/vec3.h"

namespace dymsum::spatial {
namespace {

/// Adds faces as triangles to an operand that has all vertices.
class FaceTriangles {
 public:
  explicit FaceTriangles(SolidOperand& operand)
      : operand_(operand), first_(first_at_position(operand.vertices)), used_(operand.vertices.size(), false) {}

  void add(const Face& face, std::uint32_t name) {
    if (face.size() == 3) add_triangle({face[0], face[1], face[2]}, name);
    if (face.size() <= 3) return;
    for (const Triangle& t : triangulated(operand_.vertices, face, average_view(operand_.vertices, face)))
      add_triangle(t, name);
  }
  void finish() {
    operand_.first_plate = static_cast<std::uint32_t>(operand_.triangles.size());
    const auto some = static_cast<std::size_t>(std::find(used_.begin(), used_.end(), true) - used_.begin());
    for (std::size_t v = 0; v < used_.size(); ++v)
      if (!used_[v] && some < used_.size()) operand_.vertices[v] = operand_.vertices[some];
  }

 private:
  void add_triangle(const Triangle& t, std::uint32_t face) {
    const Triangle at{first_[t[0]], first_[t[1]], first_[t[2]]};
    const std::vector<Point3>& vertices = operand_.vertices;
    if (exact::collinear(vertices[at[0]], vertices[at[1]], vertices[at[2]])) return;
    for (const std::uint32_t v : at) used_[v] = true;
    operand_.triangles.push_back(at);
    operand_.face.push_back(face);
  }

  SolidOperand& operand_;
  std::vector<std::uint32_t> first_;  // the first vertex at the position of each
  std::vector<bool> used_;
};

}  // namespace

Surface surface_of(const MeshData& data) {
  Surface surface;
  surface.operand.vertices = data.vertices;
  FaceTriangles triangles(surface.operand);
  for (std::uint32_t f = 0; f < data.faces.size(); ++f) triangles.add(data.faces[f], f);
  triangles.finish();
  return surface;
}

Surface surface_of(const CommonGrid& grid, const ExactSet& set) {
  Surface surface;
  SolidOperand& operand = surface.operand;
  operand.vertices = set.set.vertices;
  for (std::uint32_t f = 0; f < set.set.faces.size(); ++f) {
    const Face& face = set.set.faces[f];
    operand.triangles.push_back({face[0], face[1], face[2]});
    operand.face.push_back(f);
  }
  operand.first_plate = static_cast<std::uint32_t>(operand.triangles.size());
  operand.exact = vertices_on(grid, set), operand.exponent = grid.unit();
  return surface;
}

Surface surface_of(std::span<const DirectedSolid> solids) {
  Surface surface;
  std::size_t vertices = 0, faces = 0;
  bool thin = false;
  for (const DirectedSolid& solid : solids) {
    vertices += solid.mesh->vertices().size(), faces += solid.mesh->faces().size();
    thin = thin || solid.mesh->has_thin_parts();
  }
  SolidOperand& operand = surface.operand;
  operand.vertices.reserve(vertices), operand.triangles.reserve(faces), operand.face.reserve(faces);
  for (const DirectedSolid& solid : solids)
    operand.vertices.insert(operand.vertices.end(), solid.mesh->vertices().begin(), solid.mesh->vertices().end());
  FaceTriangles triangles(operand);
  std::uint32_t vertex = 0, name = 0;
  Face face;
  for (const DirectedSolid& solid : solids) {
    surface.first_triangle.push_back(static_cast<std::uint32_t>(operand.triangles.size()));
    const Mesh& mesh = *solid.mesh;
    for (std::size_t f = 0; f < mesh.faces().size(); ++f, ++name) {
      if (mesh.has_thin_parts() && mesh.thin_faces()[f]) continue;
      face = mesh.faces()[f];
      for (std::uint32_t& v : face) v += vertex;
      if (solid.inside_out) std::reverse(face.begin(), face.end());
      triangles.add(face, name);
    }
    vertex += static_cast<std::uint32_t>(mesh.vertices().size());
  }
  surface.first_triangle.push_back(static_cast<std::uint32_t>(operand.triangles.size()));
  triangles.finish();
  // Whether a solid's faces and its thin parts meet edge to edge is not asked here.
  if (thin) surface.first_triangle.clear();
  return surface;
}

}  // namespace dymsum::spatial
