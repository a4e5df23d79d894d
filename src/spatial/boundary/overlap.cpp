// Collision::overlaps: the interiors of two solids that may touch.
//
// They overlap exactly if an edge of one crosses a triangle of the other properly, or the local cones overlap at a
// point of contact that is a vertex of one or a crossing of two edges, or a shell of one that touches nothing lies
// inside the other. Where interiors overlap and boundaries meet, follow the boundary of the overlap to where both
// boundaries meet and from there to a vertex of their intersection: the cones overlap there as well.
#include <algorithm>
#include <array>
#include <tuple>

#include "spatial/boundary/collision.h"
#include "spatial/boundary/contact_cones.h"
#include "spatial/convolution/inner_cells.h"

namespace dymsum::spatial {

namespace {

/// Whether a feature lies on the boundary of an operand's solid part.
bool bounds_solid(const SolidOperand& solid, Feature f) {
  if (f.kind == Feature::Kind::triangle) return f.index < solid.first_plate;
  if (f.kind == Feature::Kind::wedge) return solid.wedges[f.index].left < solid.first_plate;
  const auto first = solid.corners.begin() + solid.corner_begin[f.index],
             last = solid.corners.begin() + solid.corner_begin[f.index + 1];
  return std::any_of(first, last, [&](std::uint32_t c) { return c / 3 < solid.first_plate; });
}

/// The shells to which a feature belongs.
void mark(const SolidOperand& solid, Feature f, std::vector<bool>& shells) {
  if (f.kind == Feature::Kind::triangle) shells[solid.shell[f.index]] = true;
  if (f.kind == Feature::Kind::wedge) {
    const Wedge& w = solid.wedges[f.index];
    shells[w.is_segment() ? solid.thin_shell[w.from] : solid.shell[w.left]] = true;
  }
  if (f.kind != Feature::Kind::vertex) return;
  if (solid.has_thin() && solid.thin_shell[f.index] != Wedge::kNone) shells[solid.thin_shell[f.index]] = true;
  for (std::uint32_t c = solid.corner_begin[f.index]; c < solid.corner_begin[f.index + 1]; ++c)
    shells[solid.shell[solid.corners[c] / 3]] = true;
}

template <class T>
void sort_unique(std::vector<T>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace

bool Collision::overlaps(const Flag& x) const {
  tests_.fetch_add(1, std::memory_order_relaxed);
  const Query query(space_, x);
  if (inner_ != nullptr && inner_->hold(query.box())) return true;
  // Deep inside the sum nearly every position shares its witness with the last one.
  thread_local std::array<std::uint32_t, 2> witness{0, 0};
  if (witness[0] < p_.triangles.size() && witness[1] < q_.triangles.size() && pierced(query, witness[0], witness[1]))
    return true;
  const auto pierces = [&](std::uint32_t i, std::uint32_t j) {
    if (!pierced(query, i, j)) return false;
    witness = {i, j};
    return true;
  };
  // First what may cross deep: where solids lie in line, most pairs touch and no more.
  if (p_tree_.any_reflected_pair(q_tree_, query.core(), pierces) || segments_cross(query) || vertices_inside(query))
    return true;
  // Where they touch is determined when no pair crosses: it takes far longer.
  struct Near {
    std::uint32_t i, j;
    Heights h;
  };
  std::vector<Near> near;
  const auto pierces_or_is_near = [&](std::uint32_t i, std::uint32_t j) {
    const Heights h = heights(query, i, j);
    if (h.apart()) return false;
    if (!pierced(query, i, j, h)) {
      near.push_back({i, j, h});
      return false;
    }
    witness = {i, j};
    return true;
  };
  if (p_tree_.any_reflected_pair(q_tree_, query.box(), pierces_or_is_near)) return true;
  std::vector<Touch> touches;
  for (const Near& pair : near) add_touches(query, pair.i, pair.j, pair.h, touches);
  add_thin_touches(query, touches);
  sort_unique(touches);
  const IndexedSolid p{p_, space_.p(), p_tree_, p_segments_}, q{q_, space_.q(), q_tree_, q_segments_};
  for (const Touch& t : touches)
    if (cones_overlap(space_, p, t.p, q, t.q)) return true;
  // Shells that touch the other one's solid part lie outside of it up to there. Others are inside or outside as a
  // whole, also those that touch thin parts, which may lie inside the solid part next to them.
  std::vector<bool> p_touched(p_.shell_vertex.size()), q_touched(q_.shell_vertex.size());
  for (const Touch& t : touches) {
    if (bounds_solid(q_, t.q)) mark(p_, t.p, p_touched);
    if (bounds_solid(p_, t.p)) mark(q_, t.q, q_touched);
  }
  for (std::size_t k = 0; k < p_touched.size(); ++k)
    if (!p_touched[k] && vertex_inside(query, DirectionSource::Of::q, p_.shell_vertex[k])) return true;
  for (std::size_t k = 0; k < q_touched.size(); ++k)
    if (!q_touched[k] && vertex_inside(query, DirectionSource::Of::p, q_.shell_vertex[k])) return true;
  return false;
}

bool Collision::touches(const Flag& x) const {
  if (overlaps(x)) return true;
  const Query query(space_, x);
  return !all_touches(query).empty() || thin_lines_meet(query);
}

std::vector<Collision::Touch> Collision::all_touches(const Query& query) const {
  std::vector<Touch> touches;
  p_tree_.any_reflected_pair(q_tree_, query.box(), [&](std::uint32_t i, std::uint32_t j) {
    if (const Heights h = heights(query, i, j); !h.apart()) add_touches(query, i, j, h, touches);
    return false;
  });
  add_thin_touches(query, touches);
  sort_unique(touches);
  return touches;
}

/// A vertex of one solid strictly inside the other one, found by doubles alone: a "no" says nothing.
bool Collision::vertices_inside(const Query& query) const {
  return std::any_of(samples_[0].begin(), samples_[0].end(),
                     [&](std::uint32_t v) { return provably_inside(query, DirectionSource::Of::q, v); }) ||
         std::any_of(samples_[1].begin(), samples_[1].end(),
                     [&](std::uint32_t v) { return provably_inside(query, DirectionSource::Of::p, v); });
}

/// x - v strictly inside the solid parts of the given operand.
bool Collision::provably_inside(const Query& query, DirectionSource::Of of, std::uint32_t v) const {
  const bool in_p = of == DirectionSource::Of::p;
  const SolidOperand& solid = in_p ? p_ : q_;
  const std::vector<Vec3>&at = in_p ? space_.p() : space_.q(), &others = in_p ? space_.q() : space_.p();
  const Vec3 point = query.at.at - others[v];
  const double margin = query.at.radius + 4 * space_.sum_radius() + space_.span() * 0x1p-44;
  Box ray;
  ray.add(point);
  ray.grow(2 * margin);
  ray.high.z = 1e300;
  bool inside = false, known = true;
  (in_p ? p_tree_ : q_tree_).for_each(ray, [&](std::uint32_t j) {
    if (!known || j >= solid.first_plate) return;
    const Triangle& t = solid.triangles[j];
    const int pass = passes_upward(point, at[t[0]], at[t[1]], at[t[2]], margin);
    known = pass >= 0;
    inside ^= pass == 1;
  });
  return known && inside;
}

namespace {

bool flush(const int (&s)[3]) { return s[0] * s[1] >= 0 && s[1] * s[2] >= 0 && s[2] * s[0] >= 0; }

}  // namespace

bool Collision::pierced(const Query& query, std::uint32_t i, std::uint32_t j) const {
  const Heights h = heights(query, i, j);
  return !h.apart() && pierced(query, i, j, h);
}

/// Whether an edge of one triangle crosses the inside of the other.
bool Collision::pierced(const Query& query, std::uint32_t i, std::uint32_t j, const Heights& h) const {
  const auto &sa = h.a, &sc = h.c;
  if (flush(sa) && flush(sc)) return false;
  const Triangle &a = p_.triangles[i], &c = q_.triangles[j];
  const std::vector<Vec3>&p = space_.p(), &q = space_.q();
  // twist[k][l]: on which side of the line of c's edge l the line of a's edge k passes.
  int twist[3][3];
  for (int k = 0; k < 3; ++k) {
    for (int l = 0; l < 3; ++l) {
      const std::uint32_t e0 = a[k], e1 = a[(k + 1) % 3], g0 = c[l], g1 = c[(l + 1) % 3];
      twist[k][l] = query.side({{e0, g0}, {DirectionSource::Of::p, e0, e1}, {DirectionSource::Of::q, g0, g1}, false},
                               p[e1] - p[e0], q[g1] - q[g0]);
    }
  }
  for (int k = 0; k < 3; ++k) {
    const int t = twist[k][0], u = twist[0][k];
    if (sa[k] * sa[(k + 1) % 3] < 0 && t != 0 && t == twist[k][1] && t == twist[k][2]) return true;
    if (sc[k] * sc[(k + 1) % 3] < 0 && u != 0 && u == twist[1][k] && u == twist[2][k]) return true;
  }
  return false;
}

/// Adds the contacts of two triangles: corners of one on the other, and edges on edges.
void Collision::add_touches(const Query& query, std::uint32_t i, std::uint32_t j, const Heights& h,
                            std::vector<Touch>& touches) const {
  touch_vertices(query, i, j, h, touches);
  touch_edges(query, i, j, h, touches);
}

/// The feature of a triangle on which a vertex of the other operand lies, which is in its plane, by the sides of its
/// edges on which the vertex is, seen along an axis across that plane.
std::optional<Feature> Collision::position(const Query& query, DirectionSource::Of of, std::uint32_t t,
                                           std::uint32_t v) const {
  const SolidOperand& solid = of == DirectionSource::Of::p ? p_ : q_;
  const Triangle& tri = solid.triangles[t];
  const std::vector<Vec3>& at = of == DirectionSource::Of::p ? space_.p() : space_.q();
  const int axis = axis_across(space_, {of, tri[0], tri[1]}, {of, tri[0], tri[2]});
  int sides[3];
  for (int k = 0; k < 3; ++k) {
    const std::uint32_t from = tri[k], to = tri[(k + 1) % 3];
    const SumPoint sum = of == DirectionSource::Of::p ? SumPoint{from, v} : SumPoint{v, from};
    sides[k] =
        query.side({sum, {of, from, to}, {DirectionSource::Of::axis, static_cast<std::uint32_t>(axis), 0}, false},
                   at[to] - at[from], axis_vector(axis));
  }
  int zeros = 0, sign = 0;
  for (const int s : sides) {
    zeros += s == 0;
    if (s == 0) continue;
    if (sign != 0 && s != sign) return std::nullopt;
    sign = s;
  }
  if (zeros == 0) return Feature{Feature::Kind::triangle, t};
  for (int k = 0; k < 3; ++k) {
    if (zeros == 1 && sides[k] == 0)
      return Feature{Feature::Kind::wedge, solid.wedge_of[3 * t + static_cast<std::uint32_t>(k)]};
    if (zeros == 2 && sides[k] == 0 && sides[(k + 1) % 3] == 0) return Feature{Feature::Kind::vertex, tri[(k + 1) % 3]};
  }
  return std::nullopt;
}

void Collision::touch_vertices(const Query& query, std::uint32_t i, std::uint32_t j, const Heights& h,
                               std::vector<Touch>& touches) const {
  const Triangle &a = p_.triangles[i], &c = q_.triangles[j];
  for (int k = 0; k < 3; ++k) {
    if (h.a[k] == 0) {
      if (const auto f = position(query, DirectionSource::Of::q, j, a[k]))
        touches.push_back({{Feature::Kind::vertex, a[k]}, *f});
    }
    if (h.c[k] == 0) {
      if (const auto f = position(query, DirectionSource::Of::p, i, c[k]))
        touches.push_back({*f, {Feature::Kind::vertex, c[k]}});
    }
  }
}

void Collision::touch_edges(const Query& query, std::uint32_t i, std::uint32_t j, const Heights& h,
                            std::vector<Touch>& touches) const {
  const Triangle &a = p_.triangles[i], &c = q_.triangles[j];
  const std::vector<Vec3>&p = space_.p(), &q = space_.q();
  // Where an edge runs along a face nothing changes at edges inside that face, before it comes to the face's edge or
  // ends. Edges on one side of the other triangle's plane do not meet it.
  const auto is_inner = [](const SolidOperand& solid, std::uint32_t side) {
    return side / 3 < solid.first_plate && solid.wedges[solid.wedge_of[side]].bend == Wedge::Bend::flat;
  };
  for (std::uint32_t k = 0; k < 3; ++k) {
    const int a_from = h.a[k], a_to = h.a[(k + 1) % 3];
    if (a_from * a_to > 0) continue;
    for (std::uint32_t l = 0; l < 3; ++l) {
      const int c_from = h.c[l], c_to = h.c[(l + 1) % 3];
      if (c_from * c_to > 0 || (c_from == 0 && c_to == 0 && is_inner(p_, 3 * i + k)) ||
          (a_from == 0 && a_to == 0 && is_inner(q_, 3 * j + l)))
        continue;
      const std::uint32_t e0 = a[k], e1 = a[(k + 1) % 3], g0 = c[l], g1 = c[(l + 1) % 3];
      const DirectionSource e{DirectionSource::Of::p, e0, e1}, g{DirectionSource::Of::q, g0, g1};
      const int axis = axis_across(space_, e, g);
      if (axis < 0) continue;  // parallel: their ends decide
      if (query.side({{e0, g0}, e, g, false}, p[e1] - p[e0], q[g1] - q[g0]) != 0) continue;
      const DirectionSource up{DirectionSource::Of::axis, static_cast<std::uint32_t>(axis), 0};
      const auto ends_on_both_sides = [&](const PlaneSource& first, const PlaneSource& second, Vec3 along) {
        return query.side(first, along, axis_vector(axis)) * query.side(second, along, axis_vector(axis)) < 0;
      };
      // The ends of e beside the line of x - g, and those of x - g beside the line of e.
      if (!ends_on_both_sides({{e0, g0}, g, up, false}, {{e1, g0}, g, up, false}, q[g1] - q[g0])) continue;
      if (!ends_on_both_sides({{e0, g0}, e, up, false}, {{e0, g1}, e, up, false}, p[e1] - p[e0])) continue;
      touches.push_back(
          {{Feature::Kind::wedge, p_.wedge_of[3 * i + k]}, {Feature::Kind::wedge, q_.wedge_of[3 * j + l]}});
    }
  }
}

}  // namespace dymsum::spatial
