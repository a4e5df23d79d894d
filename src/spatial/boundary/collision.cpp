#include "spatial/boundary/collision.h"

#include <array>
#include <optional>

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

// Segments and points that are thin parts by themselves: where they cross and touch the triangles of the other operand.

/// Whether a segment of the given operand crosses the inside of a triangle of the other one.
bool Collision::segment_crosses(const Query& query, DirectionSource::Of of, std::uint32_t wedge,
                                std::uint32_t triangle) const {
  const bool in_p = of == DirectionSource::Of::p;
  const DirectionSource::Of other = in_p ? DirectionSource::Of::q : DirectionSource::Of::p;
  const Wedge& w = (in_p ? p_ : q_).wedges[wedge];
  const Triangle& t = (in_p ? q_ : p_).triangles[triangle];
  const std::vector<Vec3>&at = in_p ? space_.p() : space_.q(), &corners = in_p ? space_.q() : space_.p();
  const auto sum = [&](std::uint32_t end, std::uint32_t corner) {
    return in_p ? SumPoint{end, corner} : SumPoint{corner, end};
  };
  const auto height = [&](std::uint32_t end) {
    return query.side({sum(end, t[0]), {other, t[0], t[1]}, {other, t[0], t[2]}, false}, corners[t[1]] - corners[t[0]],
                      corners[t[2]] - corners[t[0]]);
  };
  if (height(w.from) * height(w.to) >= 0) return false;
  int twist[3];
  for (int k = 0; k < 3; ++k) {
    const std::uint32_t a = t[k], b = t[(k + 1) % 3];
    twist[k] = query.side({sum(w.from, a), {of, w.from, w.to}, {other, a, b}, false}, at[w.to] - at[w.from],
                          corners[b] - corners[a]);
  }
  return twist[0] != 0 && twist[0] == twist[1] && twist[1] == twist[2];
}

bool Collision::segments_cross(const Query& query) const {
  const Box box = query.box();
  return p_segments_.any_reflected_pair(q_tree_, box, [&](std::uint32_t i, std::uint32_t j) {
    return segment_crosses(query, DirectionSource::Of::p, p_.segments[i], j);
  }) || p_tree_.any_reflected_pair(q_segments_, box, [&](std::uint32_t i, std::uint32_t j) {
    return segment_crosses(query, DirectionSource::Of::q, q_.segments[j], i);
  });
}

void Collision::add_thin_touches(const Query& query, std::vector<Touch>& touches) const {
  const Box box = query.box();
  p_segments_.any_reflected_pair(q_tree_, box, [&](std::uint32_t i, std::uint32_t j) {
    touch_segment(query, DirectionSource::Of::p, p_.segments[i], j, touches);
    return false;
  });
  p_tree_.any_reflected_pair(q_segments_, box, [&](std::uint32_t i, std::uint32_t j) {
    touch_segment(query, DirectionSource::Of::q, q_.segments[j], i, touches);
    return false;
  });
  p_points_.any_reflected_pair(q_tree_, box, [&](std::uint32_t i, std::uint32_t j) {
    touch_end(query, DirectionSource::Of::p, p_.points[i], j, touches);
    return false;
  });
  p_tree_.any_reflected_pair(q_points_, box, [&](std::uint32_t i, std::uint32_t j) {
    touch_end(query, DirectionSource::Of::q, q_.points[j], i, touches);
    return false;
  });
}

/// A vertex of the given operand on a triangle of the other one.
void Collision::touch_end(const Query& query, DirectionSource::Of of, std::uint32_t v, std::uint32_t triangle,
                          std::vector<Touch>& touches) const {
  const bool in_p = of == DirectionSource::Of::p;
  const DirectionSource::Of other = in_p ? DirectionSource::Of::q : DirectionSource::Of::p;
  const Triangle& t = (in_p ? q_ : p_).triangles[triangle];
  const std::vector<Vec3>& corners = in_p ? space_.q() : space_.p();
  const SumPoint sum = in_p ? SumPoint{v, t[0]} : SumPoint{t[0], v};
  const PlaneSource plane{sum, {other, t[0], t[1]}, {other, t[0], t[2]}, false};
  if (query.side(plane, corners[t[1]] - corners[t[0]], corners[t[2]] - corners[t[0]]) != 0) return;
  const std::optional<Feature> its = position(query, other, triangle, v);
  const Feature mine{Feature::Kind::vertex, v};
  if (its) touches.push_back(in_p ? Touch{mine, *its} : Touch{*its, mine});
}

/// Ends on the triangle, its corners on the segment, and edges that cross the segment.
void Collision::touch_segment(const Query& query, DirectionSource::Of of, std::uint32_t wedge, std::uint32_t triangle,
                              std::vector<Touch>& touches) const {
  const bool in_p = of == DirectionSource::Of::p;
  const DirectionSource::Of other = in_p ? DirectionSource::Of::q : DirectionSource::Of::p;
  const Wedge& w = (in_p ? p_ : q_).wedges[wedge];
  const SolidOperand& solid = in_p ? q_ : p_;
  const Triangle& t = solid.triangles[triangle];
  const auto add = [&](Feature mine, Feature its) { touches.push_back(in_p ? Touch{mine, its} : Touch{its, mine}); };
  for (const std::uint32_t end : {w.from, w.to}) touch_end(query, of, end, triangle, touches);
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::uint32_t a = t[k], b = t[(k + 1) % 3];
    if (inside_segment(query, of, wedge, a)) add({Feature::Kind::wedge, wedge}, {Feature::Kind::vertex, a});
    const DirectionSource e{of, w.from, w.to}, g{other, a, b};
    if (in_p ? edges_cross(query, e, g) : edges_cross(query, g, e))
      add({Feature::Kind::wedge, wedge}, {Feature::Kind::wedge, solid.wedge_of[3 * triangle + k]});
  }
}

/// Whether edge e of P and x - g, g an edge of Q, cross between their ends, and are not parallel.
bool Collision::edges_cross(const Query& query, DirectionSource e, DirectionSource g) const {
  const Vec3 along_e = space_.p()[e.to] - space_.p()[e.from], along_g = space_.q()[g.to] - space_.q()[g.from];
  const int axis = axis_across(space_, e, g);
  if (axis < 0 || query.side({{e.from, g.from}, e, g, false}, along_e, along_g) != 0) return false;
  const DirectionSource up{DirectionSource::Of::axis, static_cast<std::uint32_t>(axis), 0};
  const auto between = [&](SumPoint first, SumPoint second, DirectionSource line, Vec3 along) {
    return query.side({first, line, up, false}, along, axis_vector(axis)) *
               query.side({second, line, up, false}, along, axis_vector(axis)) <
           0;
  };
  return between({e.from, g.from}, {e.to, g.from}, g, along_g) && between({e.from, g.from}, {e.from, g.to}, e, along_e);
}

/// Whether segments and points of both, which are thin parts by themselves, have anything in common.
bool Collision::thin_lines_meet(const Query& query) const {
  const Box box = query.box();
  const auto same = [&](std::uint32_t v, std::uint32_t w) {  // vertices of P and of Q: x is their sum
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const std::uint32_t i = (axis + 1) % 3, j = (axis + 2) % 3;
      if (query.side({{v, w}, {DirectionSource::Of::axis, i, 0}, {DirectionSource::Of::axis, j, 0}, false},
                     axis_vector(static_cast<int>(i)), axis_vector(static_cast<int>(j))) != 0)
        return false;
    }
    return true;
  };
  const auto on_p = [&](std::uint32_t wedge, std::uint32_t w) {
    const Wedge& e = p_.wedges[wedge];
    return same(e.from, w) || same(e.to, w) || inside_segment(query, DirectionSource::Of::p, wedge, w);
  };
  const auto on_q = [&](std::uint32_t wedge, std::uint32_t v) {
    const Wedge& g = q_.wedges[wedge];
    return same(v, g.from) || same(v, g.to) || inside_segment(query, DirectionSource::Of::q, wedge, v);
  };
  const auto segments = [&](std::uint32_t i, std::uint32_t j) {
    const Wedge &e = p_.wedges[p_.segments[i]], &g = q_.wedges[q_.segments[j]];
    return on_p(p_.segments[i], g.from) || on_p(p_.segments[i], g.to) || on_q(q_.segments[j], e.from) ||
           on_q(q_.segments[j], e.to) ||
           edges_cross(query, {DirectionSource::Of::p, e.from, e.to}, {DirectionSource::Of::q, g.from, g.to});
  };
  return p_segments_.any_reflected_pair(q_segments_, box, segments) ||
         p_segments_.any_reflected_pair(
             q_points_, box, [&](std::uint32_t i, std::uint32_t j) { return on_p(p_.segments[i], q_.points[j]); }) ||
         p_points_.any_reflected_pair(
             q_segments_, box, [&](std::uint32_t i, std::uint32_t j) { return on_q(q_.segments[j], p_.points[i]); }) ||
         p_points_.any_reflected_pair(
             q_points_, box, [&](std::uint32_t i, std::uint32_t j) { return same(p_.points[i], q_.points[j]); });
}

/// Whether a vertex of the other operand lies between the ends of a segment.
bool Collision::inside_segment(const Query& query, DirectionSource::Of of, std::uint32_t wedge, std::uint32_t v) const {
  const bool in_p = of == DirectionSource::Of::p;
  const Wedge& w = (in_p ? p_ : q_).wedges[wedge];
  const Vec3 along = in_p ? space_.p()[w.to] - space_.p()[w.from] : space_.q()[w.to] - space_.q()[w.from];
  const auto sum = [&](std::uint32_t end) { return in_p ? SumPoint{end, v} : SumPoint{v, end}; };
  const DirectionSource line{of, w.from, w.to};
  const auto axis_direction = [](int axis) {
    return DirectionSource{DirectionSource::Of::axis, static_cast<std::uint32_t>(axis), 0};
  };
  for (int axis = 0; axis < 3; ++axis) {
    // The side of the line, seen along the axis; nothing is where the line runs along it.
    const bool beside = axis_across(space_, line, axis_direction(axis)) >= 0;
    if (beside && query.side({sum(w.from), line, axis_direction(axis), false}, along, axis_vector(axis)) != 0)
      return false;
  }
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v2 = (axis + 2) % 3;
    if (space_.exact_det(line, axis_direction(u), axis_direction(v2)) == 0) continue;
    const auto order = [&](std::uint32_t end) {
      return query.side({sum(end), axis_direction(u), axis_direction(v2), false}, axis_vector(u), axis_vector(v2));
    };
    return order(w.from) * order(w.to) < 0;
  }
  return false;
}

namespace {

/// Two directions in a plate.
std::array<DirectionSource, 2> directions_in(DirectionSource::Of of, const SolidOperand& solid,
                                             std::uint32_t triangle) {
  const Triangle& t = solid.triangles[triangle];
  return {DirectionSource{of, t[0], t[1]}, DirectionSource{of, t[0], t[2]}};
}

/// Plates of the first operand and segments of the second one.
std::optional<std::array<std::uint32_t, 2>> plate_and_segment(const SumSpace& space, DirectionSource::Of of,
                                                              const SolidOperand& plates,
                                                              const SolidOperand& segments) {
  const DirectionSource::Of other = of == DirectionSource::Of::p ? DirectionSource::Of::q : DirectionSource::Of::p;
  for (std::uint32_t t = plates.first_plate; t < plates.triangles.size(); t += 2) {
    const auto [u, v] = directions_in(of, plates, t);
    for (std::size_t k = 0; k < segments.segments.size(); ++k) {
      const Wedge& w = segments.wedges[segments.segments[k]];
      if (space.det(u, v, {other, w.from, w.to}) != 0) return std::array{plates.face[t], segments.segment_face[k]};
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<ThinCrossing> find_thin_crossing(const SumSpace& space, const SolidOperand& p, const SolidOperand& q) {
  if (const auto found = plate_and_segment(space, DirectionSource::Of::p, p, q))
    return ThinCrossing{(*found)[0], (*found)[1]};
  if (const auto found = plate_and_segment(space, DirectionSource::Of::q, q, p))
    return ThinCrossing{(*found)[1], (*found)[0]};
  const auto p_count = static_cast<std::uint32_t>(p.triangles.size()),
             q_count = static_cast<std::uint32_t>(q.triangles.size());
  if (p.first_plate == p_count || q.first_plate == q_count) return std::nullopt;
  const auto cross = [&](std::uint32_t i, std::uint32_t j) {
    const auto [u, v] = directions_in(DirectionSource::Of::p, p, i);
    for (const DirectionSource w : directions_in(DirectionSource::Of::q, q, j))
      if (space.det(u, v, w) != 0) return true;
    return false;
  };
  // All are parallel if all of each are parallel to the first one of the other.
  for (std::uint32_t i = p.first_plate; i < p_count; i += 2)
    if (cross(i, q.first_plate)) return ThinCrossing{p.face[i], q.face[q.first_plate]};
  for (std::uint32_t j = q.first_plate; j < q_count; j += 2)
    if (cross(p.first_plate, j)) return ThinCrossing{p.face[p.first_plate], q.face[j]};
  return std::nullopt;
}

}  // namespace dymsum::spatial
