#include <optional>

#include "spatial/boundary/collision_query.h"

namespace dymsum::spatial {

namespace {

std::vector<Box> segment_boxes(const std::vector<Vec3>& at, const SolidOperand& solid, double radius) {
  std::vector<Box> boxes;
  for (const std::uint32_t w : solid.segments) {
    Box box;
    box.add(at[solid.wedges[w].from]), box.add(at[solid.wedges[w].to]);
    box.grow(radius);
    boxes.push_back(box);
  }
  return boxes;
}

std::vector<Box> point_boxes(const std::vector<Vec3>& at, const SolidOperand& solid, double radius) {
  std::vector<Box> boxes;
  for (const std::uint32_t v : solid.points) {
    boxes.emplace_back().add(at[v]);
    boxes.back().grow(radius);
  }
  return boxes;
}

/// Vertices here and there.
std::vector<std::uint32_t> some_corners(const SolidOperand& solid) {
  constexpr std::size_t kSome = 8;
  std::vector<std::uint32_t> corners;
  for (const SupportCone& cone : solid.cones) corners.push_back(cone.vertex);
  std::vector<std::uint32_t> some;
  for (std::size_t k = 0; k < std::min(kSome, corners.size()); ++k)
    some.push_back(corners[k * corners.size() / std::min(kSome, corners.size())]);
  return some;
}

/// An end of the interval that a triangle has on another one's plane: on the facet edge from corner k to k + 1, along
/// which the height rises by the sign `rise`.
struct End {
  int facet_edge = 0, rise = 0;
};
struct Chord {
  End from, to;
};

/// The chord, from the signs of the heights of the corners, which run counter-clockwise about n, in the direction n x
/// (the other plane's normal).
std::optional<Chord> chord(const int (&s)[3]) {
  const bool above = s[0] > 0 || s[1] > 0 || s[2] > 0, below = s[0] < 0 || s[1] < 0 || s[2] < 0;
  const bool on = s[0] == 0 || s[1] == 0 || s[2] == 0;
  if (!on && !(above && below)) return std::nullopt;
  if (!above && !below) return std::nullopt;  // one plane: their neighbours decide
  Chord result;
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3, before = (k + 2) % 3;
    if (s[k] * s[next] < 0) (s[k] > 0 ? result.to : result.from) = {k, s[next]};
    if (s[k] != 0) continue;
    const End here = s[next] != 0 ? End{k, s[next]} : End{before, -s[before]};
    const bool end = s[before] == 0 ? s[next] < 0 : s[before] > 0;
    if (s[before] == s[next]) result = {here, here};
    else (end ? result.to : result.from) = here;
  }
  return result;
}

}  // namespace

Collision::Collision(const SumSpace& space, const SolidOperand& p, const SolidOperand& q, const InnerCells* inner)
    : space_(space),
      p_(p),
      q_(q),
      p_tree_(boxes_of(space.p(), p.triangles, space.sum_radius())),
      q_tree_(boxes_of(space.q(), q.triangles, space.sum_radius())),
      p_segments_(segment_boxes(space.p(), p, space.sum_radius())),
      q_segments_(segment_boxes(space.q(), q, space.sum_radius())),
      p_points_(point_boxes(space.p(), p, space.sum_radius())),
      q_points_(point_boxes(space.q(), q, space.sum_radius())),
      samples_{some_corners(p), some_corners(q)},
      inner_(inner) {}

bool Collision::meets(const Flag& x) const {
  tests_.fetch_add(1, std::memory_order_relaxed);
  const Query query(space_, x);
  if (inner_ != nullptr && inner_->hold(query.box())) return true;
  if (p_tree_.any_reflected_pair(q_tree_, query.box(),
                                 [&](std::uint32_t i, std::uint32_t j) { return triangles_meet(query, i, j); }))
    return true;
  if (segments_cross(query)) return true;
  for (const std::uint32_t v : p_.shell_vertex)
    if (vertex_inside(query, DirectionSource::Of::q, v)) return true;
  for (const std::uint32_t v : q_.shell_vertex)
    if (vertex_inside(query, DirectionSource::Of::p, v)) return true;
  return false;
}

/// The signs of the corners of triangle a of P over x - c, c of Q, and of those of x - c over a. The normal of x - c is
/// taken as that of c, by the same order of corners: it points inward. All heights are sides of x.
Collision::Heights Collision::heights(const Query& query, std::uint32_t i, std::uint32_t j) const {
  Heights h;
  const Triangle &a = p_.triangles[i], &c = q_.triangles[j];
  const std::vector<Vec3>&p = space_.p(), &q = space_.q();
  const Vec3 ua = p[a[1]] - p[a[0]], va = p[a[2]] - p[a[0]], uc = q[c[1]] - q[c[0]], vc = q[c[2]] - q[c[0]];
  const DirectionSource wa = {DirectionSource::Of::p, a[0], a[1]}, wa2 = {DirectionSource::Of::p, a[0], a[2]},
                        wc = {DirectionSource::Of::q, c[0], c[1]}, wc2 = {DirectionSource::Of::q, c[0], c[2]};
  for (int k = 0; k < 3; ++k) h.c[k] = query.side({{a[0], c[k]}, wa, wa2, false}, ua, va);
  if ((h.c[0] > 0 && h.c[1] > 0 && h.c[2] > 0) || (h.c[0] < 0 && h.c[1] < 0 && h.c[2] < 0)) {
    h.a[0] = h.a[1] = h.a[2] = 1;  // apart: they do not matter
    return h;
  }
  // n . (a_k - x + c_0) = -(n . (x - a_k - c_0)).
  for (int k = 0; k < 3; ++k) h.a[k] = -query.side({{a[k], c[0]}, wc, wc2, false}, uc, vc);
  return h;
}

bool Collision::Heights::apart() const {
  const auto one_side = [](const int(&s)[3]) {
    return (s[0] > 0 && s[1] > 0 && s[2] > 0) || (s[0] < 0 && s[1] < 0 && s[2] < 0);
  };
  return one_side(a) || one_side(c);
}

bool Collision::triangles_meet(const Query& query, std::uint32_t i, std::uint32_t j) const {
  const Triangle &a = p_.triangles[i], &c = q_.triangles[j];
  const std::vector<Vec3>&p = space_.p(), &q = space_.q();
  const Heights h = heights(query, i, j);
  const std::optional<Chord> chord_c = chord(h.c);
  if (!chord_c) return false;
  const std::optional<Chord> chord_a = chord(h.a);
  if (!chord_a) return false;
  // The corners of x - c run clockwise about uc x vc reflected, that is counter-clockwise about it: a point reflection
  // keeps orientation within a plane. So chord_a runs along n_a x n_c, and chord_c along n_c x n_a.
  const auto later = [&](End x, End y) {  // the sign of the way from x on a's edge to y on c's, along n_a x n_c
    const std::uint32_t e0 = a[x.facet_edge], e1 = a[(x.facet_edge + 1) % 3], g0 = c[y.facet_edge],
                        g1 = c[(y.facet_edge + 1) % 3];
    const Vec3 e = p[e1] - p[e0], g = q[g1] - q[g0];
    // det(e, -g, (x - g0) - e0) with e and -g the ways along both facet edges.
    const int twist =
        -query.side({{e0, g0}, {DirectionSource::Of::p, e0, e1}, {DirectionSource::Of::q, g0, g1}, false}, e, g);
    return -twist * x.rise * y.rise;
  };
  const Chord& f = *chord_a;
  const Chord g{chord_c->to, chord_c->from};
  // They meet unless one ends before the other begins.
  return later(f.from, g.to) >= 0 && later(f.to, g.from) <= 0;
}

namespace {

/// The sign of x over the upright plane through an edge, with ties broken as if x were moved by an infinitesimal along
/// the first axis, and a smaller one along the second.
template <class Side>
int upright(const SumSpace& space, const PlaneSource& plane, Side side) {
  if (const int s = side(plane)) return s;
  if (const int s = space.exact_normal(plane, 0)) return s;
  return space.exact_normal(plane, 1);
}

}  // namespace

/// x - v in the given solid, v a vertex of the other one: an odd number of the solid's triangles above it.
bool Collision::vertex_inside(const Query& query, DirectionSource::Of of, std::uint32_t v) const {
  const bool in_p = of == DirectionSource::Of::p;
  const SolidOperand& solid = in_p ? p_ : q_;
  const std::vector<Vec3>&at = in_p ? space_.p() : space_.q(), &others = in_p ? space_.q() : space_.p();
  const auto sum = [&](std::uint32_t corner) { return in_p ? SumPoint{corner, v} : SumPoint{v, corner}; };
  bool inside = false;
  Box ray;
  ray.add(query.at.at - others[v]);
  ray.grow(query.at.radius + 4 * space_.sum_radius() + space_.span() * 0x1p-50);
  ray.high.z = 1e300;
  (in_p ? p_tree_ : q_tree_).for_each(ray, [&](std::uint32_t j) {
    const Triangle& c = solid.triangles[j];
    int turn[3];
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = c[k], b = c[(k + 1) % 3];
      const PlaneSource plane{sum(a), {of, a, b}, {DirectionSource::Of::axis, 2, 0}, false};
      turn[k] = upright(space_, plane, [&](const PlaneSource& s) { return query.side(s, at[b] - at[a], {0, 0, 1}); });
    }
    if (turn[0] == 0 || turn[0] != turn[1] || turn[1] != turn[2]) return;
    const PlaneSource plane{sum(c[0]), {of, c[0], c[1]}, {of, c[0], c[2]}, false};
    const int up = space_.exact_normal(plane, 2);
    if (query.side(plane, at[c[1]] - at[c[0]], at[c[2]] - at[c[0]]) * up < 0) inside = !inside;
  });
  return inside;
}

}  // namespace dymsum::spatial
