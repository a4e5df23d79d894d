#include "spatial/boundary/lone_contacts.h"

namespace dymsum::spatial {

LoneContacts::Side::Side(const SumSpace& space, DirectionSource::Of name, const SolidOperand& operand,
                         const std::vector<Vec3>& vertices)
    : of(name), solid(operand), at(vertices), radius(space.sum_radius()), tame(operand.vertices.size()) {
  normals.reserve(solid.triangles.size());
  for (const Triangle& t : solid.triangles) normals.push_back(normal_direction(at[t[0]], at[t[1]], at[t[2]], radius));
}

template <class F>
bool LoneContacts::Side::all_triangles(std::uint32_t vertex, F f) const {
  for (std::uint32_t c = solid.corner_begin[vertex]; c < solid.corner_begin[vertex + 1]; ++c)
    if (!f(solid.corners[c] / 3)) return false;
  return true;
}

/// Every edge at a vertex leaves it in one of the triangles there.
template <class F>
bool LoneContacts::Side::all_edges(std::uint32_t vertex, F f) const {
  for (std::uint32_t c = solid.corner_begin[vertex]; c < solid.corner_begin[vertex + 1]; ++c) {
    const std::uint32_t corner = solid.corners[c];
    if (!f(line(vertex, solid.triangles[corner / 3][(corner + 1) % 3]))) return false;
  }
  return true;
}

/// Whether a way leads inward through all faces at a vertex: moved along it, the material there stays in itself.
bool LoneContacts::Side::has_free_direction(std::uint32_t vertex) {
  return tame.get(vertex, [&] {
    Vec3 sum;
    all_triangles(vertex, [&](std::uint32_t t) {
      const Vec3 n = normals[t].v;
      const double size = length(n);
      if (size > 0) sum = sum - (1 / size) * n;
      return true;
    });
    const Direction direction = scaled_direction(sum, 0);
    return all_triangles(vertex, [&](std::uint32_t t) { return filtered_sign(normals[t], direction) < 0; });
  });
}

LoneContacts::LoneContacts(const SumSpace& space, const FacetTable& table, const SolidOperand& p, const SolidOperand& q)
    : space_(space),
      table_(table),
      p_(space, DirectionSource::Of::p, p, space.p()),
      q_(space, DirectionSource::Of::q, q, space.q()),
      edge_(space.edges().size()) {}

bool LoneContacts::parallel(const Side& faces, std::uint32_t triangle, const Line& line) const {
  if (filtered_sign(faces.normals[triangle], line.near) != 0) return false;
  const Triangle& t = faces.solid.triangles[triangle];
  return space_.exact_det({faces.of, t[0], t[1]}, {faces.of, t[0], t[2]}, line.direction) == 0;
}

bool LoneContacts::lone(const Side& edges, std::uint32_t from, std::uint32_t to, const Side& vertices,
                        std::uint32_t v) const {
  int faces = 0;
  Vec3 direction;
  const bool across = edges.all_triangles(from, [&](std::uint32_t t) {
    const Triangle& triangle = edges.solid.triangles[t];
    if (triangle[0] != to && triangle[1] != to && triangle[2] != to) return true;
    ++faces;
    const double size = length(edges.normals[t].v);
    if (size > 0) direction = direction - (1 / size) * edges.normals[t].v;
    return vertices.all_edges(v, [&](const Line& d) { return !parallel(edges, t, d); });
  });
  if (!across || faces != 2) return false;
  // Inward through both faces: a way apart.
  const Direction inward = scaled_direction(direction, 0);
  const bool free = edges.all_triangles(from, [&](std::uint32_t t) {
    const Triangle& triangle = edges.solid.triangles[t];
    const bool there = triangle[0] == to || triangle[1] == to || triangle[2] == to;
    return !there || filtered_sign(edges.normals[t], inward) < 0;
  });
  if (!free) return false;
  const Line along = edges.line(from, to);
  return vertices.all_triangles(v, [&](std::uint32_t t) { return !parallel(vertices, t, along); });
}

/// No face at a vertex of one operand is parallel to an edge at a vertex of the other.
bool LoneContacts::lone(const Side& faces, std::uint32_t vertex, const Side& edges, std::uint32_t v) const {
  return edges.all_edges(v, [&](const Line& d) {
    return faces.all_triangles(vertex, [&](std::uint32_t t) { return !parallel(faces, t, d); });
  });
}

bool LoneContacts::edge(EdgeId id) {
  return edge_.get(id, [&] {
    const SumEdge& e = space_.edges()[id];
    const bool of_p = e.from.q == e.to.q;
    return of_p ? lone(p_, e.from.p, e.to.p, q_, e.from.q) : lone(q_, e.from.q, e.to.q, p_, e.from.p);
  });
}

bool LoneContacts::corner(SumPoint s) {
  return (p_.has_free_direction(s.p) || q_.has_free_direction(s.q)) && lone(p_, s.p, q_, s.q) && lone(q_, s.q, p_, s.p);
}

bool LoneContacts::facet(std::uint32_t id) {
  const SumFacet& f = table_.facets[id].facet;
  const auto face_vertex = [&](const Side& faces, std::uint32_t t, const Side& vertices, std::uint32_t v) {
    return vertices.all_edges(v, [&](const Line& d) { return !parallel(faces, t, d); });
  };
  if (f.kind == SumFacet::Kind::face_vertex) return face_vertex(p_, f.p, q_, f.q);
  if (f.kind == SumFacet::Kind::vertex_face) return face_vertex(q_, f.q, p_, f.p);
  const Wedge &e = p_.solid.wedges[f.p], &g = q_.solid.wedges[f.q];
  const Line along_e = p_.line(e.from, e.to), along_g = q_.line(g.from, g.to);
  return !parallel(p_, e.left, along_g) && !parallel(p_, e.right, along_g) && !parallel(q_, g.left, along_e) &&
         !parallel(q_, g.right, along_e);
}

bool LoneContacts::crosses(EdgeId id, PlaneId plane) const {
  const SumEdge& e = space_.edges()[id];
  const Direction along = edge_direction(space_.approx(e.from), space_.approx(e.to), space_.sum_radius());
  // The plane's normal is relatively within 2^-51, its largest component at least a half.
  return filtered_sign({space_.plane(plane).n, 0x1p-49}, along) != 0 || space_.exact_rise(plane, e) != 0;
}

}  // namespace dymsum::spatial
