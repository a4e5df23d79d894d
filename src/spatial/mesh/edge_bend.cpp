#include "spatial/mesh/edge_bend.h"

namespace dymsum::spatial {

std::vector<FacePlane> face_planes(const MeshData& data) {
  std::vector<FacePlane> planes;
  planes.reserve(data.faces.size());
  for (const Face& face : data.faces) planes.push_back(face_plane(data.vertices, face));
  return planes;
}

// The other face lies on one side of the edge's line, as far as the edge is concerned. A vertex w of it off that line,
// on that side, is above the first face's plane where the edge is reflex, and below it where it is convex; a w on the
// line's far side says the opposite.
Bend edge_bend(const MeshData& data, const HalfEdges& edges, const std::vector<FacePlane>& planes, std::uint32_t h) {
  const std::uint32_t twin = edges.twin[h];
  const FacePlane &plane = planes[edges.face[h]], &other = planes[edges.face[twin]];
  const Point3 &from = data.vertices[edges.origin[twin]], &to = data.vertices[edges.target(twin)];
  std::uint32_t w = edges.next[edges.next[twin]];
  int side = 0;
  for (; side == 0; w = edges.next[w]) side = turn_sign(other, from, to, data.vertices[edges.origin[w]]);
  w = edges.previous(w);
  const int height = side * height_sign(data.vertices, plane, data.vertices[edges.origin[w]]);
  if (height != 0) return height < 0 ? Bend::convex : Bend::reflex;
  const int other_sign =
      exact::normal_sign(data.vertices[other.a], data.vertices[other.b], data.vertices[other.c], plane.axis);
  return other_sign == plane.axis_sign ? Bend::flat : Bend::folded;
}

}  // namespace dymsum::spatial
