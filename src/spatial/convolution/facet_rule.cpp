#include "spatial/convolution/facet_rule.h"

#include <algorithm>

namespace dymsum::spatial {

namespace {

DirectionSource::Of other_of(DirectionSource::Of of) {
  return of == DirectionSource::Of::p ? DirectionSource::Of::q : DirectionSource::Of::p;
}

}  // namespace

int normal_sign(const SumSpace& space, DirectionSource::Of of, const Triangle& t, DirectionSource d) {
  return space.exact_det(DirectionSource{of, t[0], t[1]}, DirectionSource{of, t[0], t[2]}, d);
}

bool ties_hold(const SumSpace& space, const SolidOperand& p, const SolidOperand& q, const Wedge& e, const Wedge& g,
               const EdgePairSigns& at) {
  const DirectionSource ew{DirectionSource::Of::p, e.from, e.to}, gw{DirectionSource::Of::q, g.from, g.to};
  const auto along = [&](DirectionSource::Of of, const SolidOperand& faces, std::uint32_t triangle) {
    const Triangle& t = faces.triangles[triangle];
    return space.exact_dot(DirectionSource{of, t[0], t[1]}, DirectionSource{of, t[0], t[2]}, ew, gw);
  };
  const int lex_e = space.exact_leading(ew), lex_g = space.exact_leading(gw);
  if (!e.is_segment() && at.e_left == 0 && along(DirectionSource::Of::p, p, e.left) * lex_g < 0) return false;
  if (!e.is_segment() && at.e_right == 0 && -along(DirectionSource::Of::p, p, e.right) * lex_g < 0) return false;
  if (!g.is_segment() && at.g_left == 0 && along(DirectionSource::Of::q, q, g.left) * lex_e < 0) return false;
  if (!g.is_segment() && at.g_right == 0 && -along(DirectionSource::Of::q, q, g.right) * lex_e < 0) return false;
  return true;
}

bool makes_facet(const SumSpace& space, DirectionSource::Of of, const SolidOperand& faces, std::uint32_t t,
                 const SolidOperand& vertices, const SupportCone& cone) {
  const int tie = of == DirectionSource::Of::p ? -1 : 1;
  for (const std::uint32_t ray : vertices.rays_of(cone)) {
    const DirectionSource d{other_of(of), cone.vertex, ray};
    const int s = normal_sign(space, of, faces.triangles[t], d);
    if (s > 0 || (s == 0 && space.exact_leading(d) != tie)) return false;
  }
  return true;
}

int facet_side(const SumSpace& space, const SolidOperand& p, const SolidOperand& q, std::uint32_t we,
               std::uint32_t wg) {
  const Wedge &e = p.wedges[we], &g = q.wedges[wg];
  const DirectionSource ew{DirectionSource::Of::p, e.from, e.to}, gw{DirectionSource::Of::q, g.from, g.to};
  const auto at_p = [&](std::uint32_t t) { return normal_sign(space, DirectionSource::Of::p, p.triangles[t], gw); };
  const auto at_q = [&](std::uint32_t t) { return normal_sign(space, DirectionSource::Of::q, q.triangles[t], ew); };
  const EdgePairSigns at{at_p(e.left), at_p(e.right), at_q(g.left), at_q(g.right)};
  const int side = edge_pair_side(at);
  return side != 0 && at.any_zero() && !ties_hold(space, p, q, e, g, at) ? 0 : side;
}

SumFacet face_vertex_facet(DirectionSource::Of of, const SolidOperand& faces, std::uint32_t t, std::uint32_t v) {
  const Triangle& tri = faces.triangles[t];
  SumFacet facet;
  const bool of_p = of == DirectionSource::Of::p;
  facet.kind = of_p ? SumFacet::Kind::face_vertex : SumFacet::Kind::vertex_face;
  facet.p = of_p ? t : v, facet.q = of_p ? v : t;
  for (int k = 0; k < 3; ++k) facet.corner[k] = of_p ? SumPoint{tri[k], v} : SumPoint{v, tri[k]};
  return facet;
}

SumFacet edge_edge_facet(const SolidOperand& p, const SolidOperand& q, std::uint32_t we, std::uint32_t wg, int side) {
  const Wedge &e = p.wedges[we], &g = q.wedges[wg];
  SumFacet facet;
  facet.kind = SumFacet::Kind::edge_edge;
  facet.corners = 4;
  facet.p = we, facet.q = wg;
  facet.corner = {SumPoint{e.from, g.from}, {e.to, g.from}, {e.to, g.to}, {e.from, g.to}};
  if (side < 0) std::swap(facet.corner[1], facet.corner[3]);
  return facet;
}

PlaneSource plane_of(const SumFacet& facet) {
  const auto& c = facet.corner;
  if (facet.kind == SumFacet::Kind::face_vertex)
    return {c[0], {DirectionSource::Of::p, c[0].p, c[1].p}, {DirectionSource::Of::p, c[0].p, c[2].p}, false};
  if (facet.kind == SumFacet::Kind::vertex_face)
    return {c[0], {DirectionSource::Of::q, c[0].q, c[1].q}, {DirectionSource::Of::q, c[0].q, c[2].q}, false};
  return {c[0], {DirectionSource::Of::p, c[0].p, c[2].p}, {DirectionSource::Of::q, c[0].q, c[2].q}, c[1].p == c[0].p};
}

}  // namespace dymsum::spatial
