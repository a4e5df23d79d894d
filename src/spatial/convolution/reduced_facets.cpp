#include "spatial/convolution/reduced_facets.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "spatial/mesh/box_tree.h"

namespace dymsum::spatial {
namespace {

using EdgeBendSigns = Wedge::Bend;

/// One operand with its normals and edges in doubles.
struct FacetSide {
  DirectionSource::Of of;
  const SolidOperand& solid;
  std::vector<Direction> normals;     // of triangles
  std::vector<std::uint32_t> convex;  // wedges
  std::vector<Direction> edges;       // of these
  std::vector<Direction> rays;        // as solid.rays

  FacetSide(DirectionSource::Of which, const SolidOperand& operand, const SumSpace& space) : of(which), solid(operand) {
    const std::vector<Vec3>& at = which == DirectionSource::Of::p ? space.p() : space.q();
    const double each = space.sum_radius();
    for (const Triangle& t : solid.triangles) normals.push_back(normal_direction(at[t[0]], at[t[1]], at[t[2]], each));
    for (std::uint32_t w = 0; w < solid.wedges.size(); ++w) {
      if (solid.wedges[w].bend != EdgeBendSigns::convex) continue;
      convex.push_back(w);
      edges.push_back(edge_direction(at[solid.wedges[w].from], at[solid.wedges[w].to], each));
    }
    rays.resize(solid.rays.size());
    for (const SupportCone& cone : solid.cones) {
      for (std::uint32_t k = cone.first; k < cone.last; ++k)
        rays[k] = edge_direction(at[cone.vertex], at[solid.rays[k]], each);
    }
  }

  DirectionSource direction(std::uint32_t from, std::uint32_t to) const { return {of, from, to}; }
  bool is_thin(const Wedge& w) const { return w.is_segment() || w.left >= solid.first_plate; }
};

int normal_sign(const SumSpace& space, const FacetSide& faces, std::uint32_t triangle, DirectionSource d) {
  return normal_sign(space, faces.of, faces.solid.triangles[triangle], d);
}

/// A bound, in each coordinate, of the unit vectors along v.
void add_unit(Box& box, const Direction& d) {
  if (d.error > 0x1p-20) {
    box.add(Vec3{-1, -1, -1}), box.add(Vec3{1, 1, 1});
    return;
  }
  box.add((1 / length(d.v)) * d.v);
}

/// The box of the normals of a convex edge: the shorter arc between those of its faces.
Box arc_box(const FacetSide& side, const Wedge& w) {
  Box box;
  if (w.is_segment()) {
    box.add(Vec3{-1, -1, -1}), box.add(Vec3{1, 1, 1});
    return box;
  }
  const Direction &a = side.normals[w.left], &b = side.normals[w.right];
  add_unit(box, a), add_unit(box, b);
  // An arc of angle t bulges over its chord by 1 - cos(t / 2) at most.
  const Vec3 u = (1 / length(a.v)) * a.v, v = (1 / length(b.v)) * b.v;
  const double cosine = std::max(-1.0, dot(u, v));
  box.grow(1 - std::sqrt(std::max(0.0, (1 + cosine) / 2)) + 0x1p-18);
  return box;
}

/// The box of the normals that a cone supports: those with n . d <= 0 for all its rays d.
Box cone_box(const FacetSide& side, const SupportCone& cone) {
  Box box;
  const std::uint32_t n = cone.last - cone.first;
  if (cone.flat) {
    box.add(Vec3{-1, -1, -1}), box.add(Vec3{1, 1, 1});
    return box;
  }
  const auto ray = [&](std::uint32_t k) -> const Direction& { return side.rays[cone.first + k % n]; };
  std::vector<Vec3> corner;
  for (std::uint32_t k = 0; k < n; ++k) {
    // All other rays lie to the left of the plane through two neighbours, so v x u points outward.
    const Vec3 c = cross(ray(k + 1).v, ray(k).v);
    const double size = length(c);
    if (size < 0x1p-16 || ray(k).error + ray(k + 1).error > 0x1p-40) {
      box.add(Vec3{-1, -1, -1}), box.add(Vec3{1, 1, 1});
      return box;
    }
    corner.push_back((1 / size) * c);
    box.add(corner.back());
  }
  double bulge = 0;
  for (std::uint32_t k = 0; k < n; ++k) {
    const double cosine = std::max(-1.0, dot(corner[k], corner[(k + 1) % n]));
    bulge = std::max(bulge, 1 - std::sqrt(std::max(0.0, (1 + cosine) / 2)));
  }
  box.grow(bulge + 0x1p-18);
  // A coordinate has its extreme inside the region only at an axis.
  for (int axis = 0; axis < 3; ++axis) {
    for (const double s : {-1.0, 1.0}) {
      const Vec3 a{axis == 0 ? s : 0, axis == 1 ? s : 0, axis == 2 ? s : 0};
      bool inside = true;
      for (std::uint32_t k = 0; k < n && inside; ++k) inside = dot(a, ray(k).v) <= 0x1p-18;
      if (inside) box.add(a);
    }
  }
  return box;
}

/// The facets of some features of one operand with all of the other one.
class Facets {
 public:
  Facets(const SumSpace& space, const FacetSide& p, const FacetSide& q) : space_(space), p_(p), q_(q) {}

  ReducedConvolution take() { return std::move(result_); }

  /// Faces of one operand with vertices of the other whose rays all lie below the face's plane, or in it with the
  /// lexicographic sign of `tie`.
  void face_vertex(const FacetSide& faces, const FacetSide& vertices, const BoxTree& tree, int tie, std::uint32_t first,
                   std::uint32_t last) {
    std::vector<std::uint32_t> found;
    for (std::uint32_t t = first; t < last; ++t) {
      Box at;
      add_unit(at, faces.normals[t]);
      at.grow(0x1p-18);
      found.clear();
      tree.for_each(at, [&](std::uint32_t cone) {
        ++result_.counts.pairs_tried;
        if (supports(faces, t, vertices, vertices.solid.cones[cone], tie)) found.push_back(cone);
      });
      std::sort(found.begin(), found.end());
      for (const std::uint32_t cone : found) add_face_vertex(faces, t, vertices.solid.cones[cone].vertex);
      result_.counts.face_vertex += found.size();
    }
  }

  /// Convex edges of P with those of Q, by the boxes of these.
  void edge_edge(const BoxTree& tree, std::uint32_t first, std::uint32_t last) {
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = first; i < last; ++i) {
      found.clear();
      tree.for_each(arc_box(p_, p_.solid.wedges[p_.convex[i]]), [&](std::uint32_t j) { found.push_back(j); });
      result_.counts.pairs_tried += found.size();
      std::sort(found.begin(), found.end());
      for (const std::uint32_t j : found) try_edges(i, j);
    }
  }

 private:
  bool supports(const FacetSide& faces, std::uint32_t t, const FacetSide& vertices, const SupportCone& cone,
                int tie) const {
    for (std::uint32_t k = cone.first; k < cone.last; ++k) {
      int s = filtered_sign(faces.normals[t], vertices.rays[k]);
      if (s == 0) {
        const DirectionSource d = vertices.direction(cone.vertex, vertices.solid.rays[k]);
        s = normal_sign(space_, faces, t, d);
        if (s == 0) s = space_.exact_leading(d) == tie ? -1 : 1;
      }
      if (s > 0) return false;
    }
    return true;
  }

  void add_face_vertex(const FacetSide& faces, std::uint32_t t, std::uint32_t v) {
    add(face_vertex_facet(faces.of, faces.solid, t, v));
  }
  void add(const SumFacet& facet) {
    result_.facets.push_back(facet);
    result_.planes.push_back(plane_of(facet));
  }

  /// The sign of face's normal times the other operand's edge.
  int sign_at(const FacetSide& faces, std::uint32_t triangle, const FacetSide& edges, std::uint32_t i) const {
    const int s = filtered_sign(faces.normals[triangle], edges.edges[i]);
    if (s != 0) return s;
    const Wedge& w = edges.solid.wedges[edges.convex[i]];
    return normal_sign(space_, faces, triangle, edges.direction(w.from, w.to));
  }

  void try_edges(std::uint32_t i, std::uint32_t j) {
    const Wedge &e = p_.solid.wedges[p_.convex[i]], &g = q_.solid.wedges[q_.convex[j]];
    if (p_.is_thin(e) || q_.is_thin(g)) return try_thin_edges(i, j);
    EdgePairSigns at{sign_at(p_, e.left, q_, j), sign_at(p_, e.right, q_, j), 0, 0};
    if (at.e_left == at.e_right) return;
    at.g_left = sign_at(q_, g.left, p_, i);
    if ((at.e_left != 0 ? at.e_left : -at.e_right) * at.g_left > 0) return;
    at.g_right = sign_at(q_, g.right, p_, i);
    const int side = edge_pair_side(at);
    if (side == 0 || (at.any_zero() && !ties_hold(space_, p_.solid, q_.solid, e, g, at))) return;
    add_edge_edge(i, j, side);
  }

  /// A segment by itself has no faces, and those of a plate's edge are opposite. All zero: parallel edges, or thin
  /// parts in one plane, which is seen from both sides.
  void try_thin_edges(std::uint32_t i, std::uint32_t j) {
    const Wedge &e = p_.solid.wedges[p_.convex[i]], &g = q_.solid.wedges[q_.convex[j]];
    const bool bare_e = e.is_segment(), bare_g = g.is_segment();
    const int a = bare_e ? 0 : sign_at(p_, e.left, q_, j), b = bare_e ? 0 : sign_at(p_, e.right, q_, j);
    if (a == b && (a != 0 || !p_.is_thin(e))) return;
    int s = a != 0 ? a : -b;
    if (s * b > 0) return;
    const int c = bare_g ? 0 : sign_at(q_, g.left, p_, i);
    if (s * c > 0) return;
    const int d = bare_g ? 0 : sign_at(q_, g.right, p_, i);
    if (s == 0) s = c != 0 ? -c : d;
    if (s == 0 && space_.exact_dot(p_.direction(e.from, e.to), q_.direction(g.from, g.to), p_.direction(e.from, e.to),
                                   q_.direction(g.from, g.to)) == 0)
      return;
    if (s * c > 0 || s * d < 0) return;
    const EdgePairSigns at{a, b, c, d};
    if (at.any_zero() && !ties_hold(space_, p_.solid, q_.solid, e, g, at)) return;
    add_edge_edge(i, j, s != 0 ? s : 1);
    if (s == 0) add_edge_edge(i, j, -1);
  }

  void add_edge_edge(std::uint32_t i, std::uint32_t j, int s) {
    ++result_.counts.edge_edge;
    add(edge_edge_facet(p_.solid, q_.solid, p_.convex[i], q_.convex[j], s));
  }

  const SumSpace& space_;
  const FacetSide &p_, &q_;
  ReducedConvolution result_;
};

BoxTree cone_tree(const FacetSide& side) {
  std::vector<Box> boxes;
  for (const SupportCone& cone : side.solid.cones) boxes.push_back(cone_box(side, cone));
  return BoxTree(std::move(boxes));
}
BoxTree arc_tree(const FacetSide& side) {
  std::vector<Box> boxes;
  for (const std::uint32_t w : side.convex) boxes.push_back(arc_box(side, side.solid.wedges[w]));
  return BoxTree(std::move(boxes));
}

void append(ReducedConvolution& all, const ReducedConvolution& some) {
  all.facets.insert(all.facets.end(), some.facets.begin(), some.facets.end());
  all.planes.insert(all.planes.end(), some.planes.begin(), some.planes.end());
  all.counts.face_vertex += some.counts.face_vertex;
  all.counts.edge_edge += some.counts.edge_edge;
  all.counts.pairs_tried += some.counts.pairs_tried;
}

}  // namespace

ReducedConvolution reduced_convolution(const SumSpace& space, const SolidOperand& p, const SolidOperand& q,
                                       StageWatch& watch) {
  std::optional<FacetSide> sides[2];
  watch.run(2, [&](std::size_t k) {
    if (k == 0) sides[0].emplace(DirectionSource::Of::p, p, space);
    else sides[1].emplace(DirectionSource::Of::q, q, space);
  });
  const FacetSide &a = *sides[0], &b = *sides[1];
  BoxTree trees[3];
  watch.run(3, [&](std::size_t k) { trees[k] = k == 0 ? cone_tree(a) : k == 1 ? cone_tree(b) : arc_tree(b); });
  const BoxTree &p_cones = trees[0], &q_cones = trees[1], &q_arcs = trees[2];
  // Faces of P, faces of Q, edges of P, in parts.
  constexpr std::uint32_t kPart = 128;
  const auto parts_of = [](std::size_t n) { return (static_cast<std::uint32_t>(n) + kPart - 1) / kPart; };
  const std::uint32_t faces_p = parts_of(p.triangles.size()), faces_q = parts_of(q.triangles.size()),
                      edges = parts_of(a.convex.size());
  std::vector<ReducedConvolution> parts(faces_p + faces_q + edges);
  watch.run(parts.size(), [&](std::size_t k) {
    Facets facets(space, a, b);
    auto part = static_cast<std::uint32_t>(k);
    const auto last = [&](std::size_t n) { return std::min(static_cast<std::uint32_t>(n), (part + 1) * kPart); };
    if (part < faces_p) {
      facets.face_vertex(a, b, q_cones, -1, part * kPart, last(p.triangles.size()));
    } else if (part -= faces_p; part < faces_q) {
      facets.face_vertex(b, a, p_cones, 1, part * kPart, last(q.triangles.size()));
    } else {
      part -= faces_q;
      facets.edge_edge(q_arcs, part * kPart, last(a.convex.size()));
    }
    parts[k] = facets.take();
    watch.hold(parts[k].facets.size() * (sizeof(SumFacet) + sizeof(PlaneSource)));
  });
  ReducedConvolution all;
  std::size_t count = 0;
  for (const ReducedConvolution& part : parts) count += part.facets.size();
  all.facets.reserve(count), all.planes.reserve(count);
  for (ReducedConvolution& part : parts) append(all, std::exchange(part, {}));
  return all;
}

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
