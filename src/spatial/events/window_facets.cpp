#include "spatial/events/window_facets.h"

#include <cmath>

namespace dymsum::spatial {

namespace {

DirectionSource::Of of_operand(int op) { return op == 0 ? DirectionSource::Of::p : DirectionSource::Of::q; }
Vec3 unit_of(Vec3 v) { return (1 / length(v)) * v; }

/// The unit vector along u x v within 2^-32, or zero, which excludes nothing, where that is not proved: the product
/// errs by 2^-50 of the sizes of u and v.
Vec3 provably_unit(Vec3 u, Vec3 v) {
  const Vec3 n = cross(u, v);
  return length(n) < length(u) * length(v) * 0x1p-16 ? Vec3{} : unit_of(n);
}

Box box_of(const WindowFacet& f, const JetFrame& frame) {
  Box box;
  for (int k = 0; k < f.facet.corners; ++k) box.add(frame.box(f.facet.corner[k]));
  return box;
}

}  // namespace

GaussMaps::GaussMaps(const RotatingPair& pair) : pair_(pair) {
  for (int op = 0; op < 2; ++op) {
    const SolidOperand& solid = pair.operand(op);
    const std::vector<Vec3>& at = pair.positions[op];
    for (const Triangle& t : solid.triangles)
      sides_[op].normals.push_back(provably_unit(at[t[1]] - at[t[0]], at[t[2]] - at[t[0]]));
    for (std::uint32_t w = 0; w < solid.wedges.size(); ++w) {
      if (solid.wedges[w].bend != Wedge::Bend::convex) continue;
      sides_[op].convex.push_back(w);
      sides_[op].edges.push_back(unit_of(at[solid.wedges[w].to] - at[solid.wedges[w].from]));
    }
    sides_[op].rays.resize(solid.rays.size());
    for (const SupportCone& cone : solid.cones)
      for (std::uint32_t k = cone.first; k < cone.last; ++k)
        sides_[op].rays[k] = unit_of(at[solid.rays[k]] - at[cone.vertex]);
  }
}

// Directions turn by at most `half`, so products of unit vectors change by no more.
std::vector<WindowFacet> GaussMaps::facets(double midpoint, double half) const {
  const JetFrame frame(pair_, midpoint, half);
  const double margin = half * (1 + 0x1p-20) + 0x1p-30;
  std::vector<WindowFacet> facets;
  for (int op = 0; op < 2; ++op) add_face_vertex(op, frame, margin, facets);
  add_edge_edge(frame, margin, facets);
  for (WindowFacet& f : facets) f.box = box_of(f, frame);
  return facets;
}

void GaussMaps::add_face_vertex(int op, const JetFrame& frame, double margin, std::vector<WindowFacet>& facets) const {
  const SolidOperand &faces = pair_.operand(op), &vertices = pair_.operand(1 - op);
  std::vector<Vec3> rays = sides_[1 - op].rays;
  for (Vec3& r : rays) r = turned(1 - op, frame.matrix(), r);
  for (std::uint32_t t = 0; t < faces.triangles.size(); ++t) {
    const Vec3 n = turned(op, frame.matrix(), sides_[op].normals[t]);
    for (const SupportCone& cone : vertices.cones) {
      bool excluded = false, proved = true;
      for (std::uint32_t k = cone.first; k < cone.last && !excluded; ++k) {
        const double slant = dot(n, rays[k]);
        excluded = slant > margin, proved = proved && slant < -margin;
      }
      if (excluded) continue;
      WindowFacet facet;
      facet.facet = face_vertex_facet(of_operand(op), faces, t, cone.vertex);
      facet.plane = plane_of(facet.facet);
      for (std::uint32_t k = cone.first; k < cone.last && !proved; ++k)
        if (!(dot(n, rays[k]) < -margin))
          facet.unsure.push_back(
              {static_cast<std::int8_t>(op), 1, t, DirectionSource{of_operand(1 - op), cone.vertex, vertices.rays[k]}});
      facets.push_back(std::move(facet));
    }
  }
}

void GaussMaps::add_edge_edge(const JetFrame& frame, double margin, std::vector<WindowFacet>& facets) const {
  const SolidOperand &p = pair_.pair.p, &q = pair_.pair.q;
  std::array<std::vector<Vec3>, 2> normals, edges;
  for (int op = 0; op < 2; ++op) {
    for (const Vec3& n : sides_[op].normals) normals[op].push_back(turned(op, frame.matrix(), n));
    for (const Vec3& e : sides_[op].edges) edges[op].push_back(turned(op, frame.matrix(), e));
  }
  for (std::size_t i = 0; i < edges[0].size(); ++i) {
    const std::uint32_t we = sides_[0].convex[i];
    const Wedge& e = p.wedges[we];
    const Vec3 el = normals[0][e.left], er = normals[0][e.right];
    const bool along = pair_.along_axis(0, e.from, e.to);
    for (std::size_t j = 0; j < edges[1].size(); ++j) {
      const double a = dot(el, edges[1][j]), b = dot(er, edges[1][j]);
      if ((a > margin && b > margin) || (a < -margin && b < -margin)) continue;
      const std::uint32_t wg = sides_[1].convex[j];
      const Wedge& g = q.wedges[wg];
      if (along && pair_.along_axis(1, g.from, g.to)) continue;  // parallel at every angle
      const double c = dot(normals[1][g.left], edges[0][i]), d = dot(normals[1][g.right], edges[0][i]);
      for (const int s : {1, -1}) {
        // s (g . e_left) >= 0 >= s (g . e_right), s (e . g_left) <= 0 <= s (e . g_right): facet_rule.h.
        const double up[4] = {-s * a, s * b, s * c, -s * d};
        if (up[0] > margin || up[1] > margin || up[2] > margin || up[3] > margin) continue;
        const SlantCondition all[4] = {
            {0, static_cast<std::int8_t>(-s), e.left, {DirectionSource::Of::q, g.from, g.to}},
            {0, static_cast<std::int8_t>(s), e.right, {DirectionSource::Of::q, g.from, g.to}},
            {1, static_cast<std::int8_t>(s), g.left, {DirectionSource::Of::p, e.from, e.to}},
            {1, static_cast<std::int8_t>(-s), g.right, {DirectionSource::Of::p, e.from, e.to}}};
        WindowFacet facet;
        facet.facet = edge_edge_facet(p, q, we, wg, s);
        facet.plane = plane_of(facet.facet);
        for (int k = 0; k < 4; ++k)
          if (!(up[k] < -margin)) facet.unsure.push_back(all[k]);
        facets.push_back(std::move(facet));
      }
    }
  }
}

}  // namespace dymsum::spatial
