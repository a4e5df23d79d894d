#include "spatial/convolution/facet_rule.h"

#include <algorithm>

namespace dymsum::spatial {

namespace {

Way::Of other_of(Way::Of of) { return of == Way::Of::p ? Way::Of::q : Way::Of::p; }

}  // namespace

int normal_sign(const SumSpace& space, Way::Of of, const Triangle& t, Way d) {
  return space.exact_det(Way{of, t[0], t[1]}, Way{of, t[0], t[2]}, d);
}

bool ties_hold(const SumSpace& space, const SolidOperand& p, const SolidOperand& q, const Wedge& e, const Wedge& g,
               const EdgePairSigns& at) {
  const Way ew{Way::Of::p, e.from, e.to}, gw{Way::Of::q, g.from, g.to};
  const auto along = [&](Way::Of of, const SolidOperand& faces, std::uint32_t triangle) {
    const Triangle& t = faces.triangles[triangle];
    return space.exact_dot(Way{of, t[0], t[1]}, Way{of, t[0], t[2]}, ew, gw);
  };
  const int lex_e = space.exact_leading(ew), lex_g = space.exact_leading(gw);
  if (!e.is_segment() && at.e_left == 0 && along(Way::Of::p, p, e.left) * lex_g < 0) return false;
  if (!e.is_segment() && at.e_right == 0 && -along(Way::Of::p, p, e.right) * lex_g < 0) return false;
  if (!g.is_segment() && at.g_left == 0 && along(Way::Of::q, q, g.left) * lex_e < 0) return false;
  if (!g.is_segment() && at.g_right == 0 && -along(Way::Of::q, q, g.right) * lex_e < 0) return false;
  return true;
}

bool makes_facet(const SumSpace& space, Way::Of of, const SolidOperand& faces, std::uint32_t t,
                 const SolidOperand& vertices, const SupportCone& cone) {
  const int tie = of == Way::Of::p ? -1 : 1;
  for (const std::uint32_t ray : vertices.rays_of(cone)) {
    const Way d{other_of(of), cone.vertex, ray};
    const int s = normal_sign(space, of, faces.triangles[t], d);
    if (s > 0 || (s == 0 && space.exact_leading(d) != tie)) return false;
  }
  return true;
}

int facet_side(const SumSpace& space, const SolidOperand& p, const SolidOperand& q, std::uint32_t we,
               std::uint32_t wg) {
  const Wedge &e = p.wedges[we], &g = q.wedges[wg];
  const Way ew{Way::Of::p, e.from, e.to}, gw{Way::Of::q, g.from, g.to};
  const auto at_p = [&](std::uint32_t t) { return normal_sign(space, Way::Of::p, p.triangles[t], gw); };
  const auto at_q = [&](std::uint32_t t) { return normal_sign(space, Way::Of::q, q.triangles[t], ew); };
  const EdgePairSigns at{at_p(e.left), at_p(e.right), at_q(g.left), at_q(g.right)};
  const int side = edge_pair_side(at);
  return side != 0 && at.any_zero() && !ties_hold(space, p, q, e, g, at) ? 0 : side;
}

SumFacet face_vertex_facet(Way::Of of, const SolidOperand& faces, std::uint32_t t, std::uint32_t v) {
  const Triangle& tri = faces.triangles[t];
  SumFacet facet;
  const bool of_p = of == Way::Of::p;
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
    return {c[0], {Way::Of::p, c[0].p, c[1].p}, {Way::Of::p, c[0].p, c[2].p}, false};
  if (facet.kind == SumFacet::Kind::vertex_face)
    return {c[0], {Way::Of::q, c[0].q, c[1].q}, {Way::Of::q, c[0].q, c[2].q}, false};
  return {c[0], {Way::Of::p, c[0].p, c[2].p}, {Way::Of::q, c[0].q, c[2].q}, c[1].p == c[0].p};
}

}  // namespace dymsum::spatial
