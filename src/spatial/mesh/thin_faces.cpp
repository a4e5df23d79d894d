#include "spatial/mesh/thin_faces.h"

#include <algorithm>

#include "spatial/mesh/half_edges.h"

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
