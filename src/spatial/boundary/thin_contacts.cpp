// Segments and points that are thin parts by themselves: where they cross and touch the triangles of the other operand.
#include "spatial/boundary/collision_query.h"

namespace dymsum::spatial {

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

}  // namespace dymsum::spatial
