#include "spatial/mesh/surface_crossings.h"

#include <algorithm>
#include <array>

#include "exact/orient.h"

namespace dymsum::spatial {
namespace {

using exact::orient3_sign;
using exact::orient_sign;

struct Corners {
  Point3 a, b, c;
};

struct Segment {
  Point3 p, q;
};

bool within(const Point& a, const Point& b, const Point& x) {
  return std::min(a.x, b.x) <= x.x && x.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= x.y &&
         x.y <= std::max(a.y, b.y);
}

/// Closed segments in the plane.
bool segments_meet(const Point& a, const Point& b, const Point& c, const Point& d) {
  const int c_side = orient_sign(a, b, c), d_side = orient_sign(a, b, d);
  const int a_side = orient_sign(c, d, a), b_side = orient_sign(c, d, b);
  if (c_side * d_side < 0 && a_side * b_side < 0) return true;
  return (c_side == 0 && within(a, b, c)) || (d_side == 0 && within(a, b, d)) || (a_side == 0 && within(c, d, a)) ||
         (b_side == 0 && within(c, d, b));
}

exact::Axis axis_of(const Corners& t) {
  for (const exact::Axis axis : {exact::Axis::z, exact::Axis::x}) {
    if (exact::normal_sign(t.a, t.b, t.c, axis) != 0) return axis;
  }
  return exact::Axis::y;
}

/// A segment in the plane of a triangle.
bool meet_in_plane(const Segment& s, const Corners& t) {
  const exact::Axis axis = axis_of(t);
  const Point p = dropped(s.p, axis), q = dropped(s.q, axis);
  const Point a = dropped(t.a, axis), b = dropped(t.b, axis), c = dropped(t.c, axis);
  if (segments_meet(p, q, a, b) || segments_meet(p, q, b, c) || segments_meet(p, q, c, a)) return true;
  // Without a common point with its facet edge the segment is inside or outside as a whole.
  const int side = orient_sign(a, b, p);
  return side == orient_sign(b, c, p) && side == orient_sign(c, a, p);
}

/// A closed segment and a closed triangle.
bool meet(const Segment& s, const Corners& t) {
  const int p_side = orient3_sign(t.a, t.b, t.c, s.p), q_side = orient3_sign(t.a, t.b, t.c, s.q);
  if (p_side * q_side > 0) return false;
  if (p_side == 0 && q_side == 0) return meet_in_plane(s, t);
  // The line meets the plane once, inside the triangle unless it passes its sides in different senses.
  const std::array<int, 3> sides{orient3_sign(s.p, s.q, t.a, t.b), orient3_sign(s.p, s.q, t.b, t.c),
                                 orient3_sign(s.p, s.q, t.c, t.a)};
  const auto [least, most] = std::minmax_element(sides.begin(), sides.end());
  return *least * *most >= 0;
}

/// A position near the point in which the segment meets the triangle's plane.
Point3 position(const Segment& s, const Corners& t) {
  const auto as_vector = [](const Point3& p) { return Vec3{p.x, p.y, p.z}; };
  const Vec3 p = as_vector(s.p), d = as_vector(s.q) - p, a = as_vector(t.a);
  const Vec3 normal = cross(as_vector(t.b) - a, as_vector(t.c) - a);
  const double speed = dot(normal, d);
  const double fraction = speed != 0 ? std::clamp(dot(normal, a - p) / speed, 0.0, 1.0) : 0.5;
  const Vec3 at = p + fraction * d;
  return {at.x, at.y, at.z};
}

class MeetingSearch {
 public:
  MeetingSearch(const MeshData& data, const Triangles& triangles)
      : data_(data), triangles_(triangles), is_edge_(3 * triangles.triangles.size()) {
    mark_edges();
  }

  std::optional<FaceMeeting> run(const BoxTree& boxes) const {
    std::optional<FaceMeeting> first;
    for (std::uint32_t i = 0; i < triangles_.triangles.size(); ++i) {
      if (first && first->face < triangles_.face[i]) break;
      boxes.for_each(boxes.box(i), [&](std::uint32_t j) {
        if (triangles_.face[j] <= triangles_.face[i]) return;
        if (first && first->other_face <= triangles_.face[j]) return;
        if (const auto at = meeting(i, j)) first = {triangles_.face[i], triangles_.face[j], *at};
      });
    }
    return first;
  }

  std::vector<std::array<std::uint32_t, 2>> all(const BoxTree& boxes, const std::vector<bool>& queried) const {
    std::vector<std::array<std::uint32_t, 2>> found;
    for (std::uint32_t i = 0; i < triangles_.triangles.size(); ++i) {
      if (!queried[i]) continue;
      boxes.for_each(boxes.box(i), [&](std::uint32_t j) {
        if (i == j || (queried[j] && j < i)) return;
        if (meeting(i, j)) found.push_back({std::min(i, j), std::max(i, j)});
      });
    }
    std::sort(found.begin(), found.end());
    return found;
  }

 private:
  // Marks the sides of triangles that are edges of their faces; the others run through its inside.
  void mark_edges() {
    std::vector<std::uint32_t> next(data_.vertices.size());
    for (std::size_t t = 0, f = data_.faces.size(); t < triangles_.triangles.size(); ++t) {
      if (f != triangles_.face[t]) {
        f = triangles_.face[t];
        const Face& face = data_.faces[f];
        for (std::size_t k = 0; k < face.size(); ++k) next[face[k]] = face[(k + 1) % face.size()];
      }
      const Triangle& corners = triangles_.triangles[t];
      for (std::size_t k = 0; k < 3; ++k) is_edge_[3 * t + k] = next[corners[k]] == corners[(k + 1) % 3];
    }
  }

  const Point3& at(std::uint32_t v) const { return data_.vertices[v]; }
  Corners corners(const Triangle& t) const { return {at(t[0]), at(t[1]), at(t[2])}; }

  /// A common point of two triangles of different faces that they may not have.
  std::optional<Point3> meeting(std::uint32_t i, std::uint32_t j) const {
    const Triangle &s = triangles_.triangles[i], &t = triangles_.triangles[j];
    std::array<std::uint32_t, 3> shared_s{}, shared_t{};
    int shared = 0;
    for (std::uint32_t k = 0; k < 3; ++k) {
      for (std::uint32_t l = 0; l < 3; ++l) {
        if (s[k] == t[l]) shared_s[shared] = k, shared_t[shared++] = l;
      }
    }
    if (shared == 0) return apart_meeting(s, t);
    if (shared == 1) return vertex_meeting(s, shared_s[0], t, shared_t[0]);
    if (shared == 3) return at(s[0]);
    return edge_meeting(i, 3 - shared_s[0] - shared_s[1], j, 3 - shared_t[0] - shared_t[1]);
  }

  bool one_side(const Corners& plane, const Point3& p, const Point3& q) const {
    const int side = orient3_sign(plane.a, plane.b, plane.c, p);
    return side != 0 && side == orient3_sign(plane.a, plane.b, plane.c, q);
  }
  bool one_side(const Corners& plane, const Corners& t) const {
    const int side = orient3_sign(plane.a, plane.b, plane.c, t.a);
    return side != 0 && side == orient3_sign(plane.a, plane.b, plane.c, t.b) &&
           side == orient3_sign(plane.a, plane.b, plane.c, t.c);
  }

  /// A common point of triangles without a common vertex, on a side of one of the two: any is too much.
  std::optional<Point3> apart_meeting(const Triangle& s, const Triangle& t) const {
    const Corners a = corners(s), b = corners(t);
    if (one_side(a, b) || one_side(b, a)) return std::nullopt;
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
      for (const Segment& side : {Segment{from.a, from.b}, Segment{from.b, from.c}, Segment{from.c, from.a}}) {
        if (meet(side, to)) return position(side, to);
      }
    }
    return std::nullopt;
  }

  /// A common point of triangles with one common vertex: from that, what they also share leads to the opposite side of
  /// one of the two.
  std::optional<Point3> vertex_meeting(const Triangle& s, std::uint32_t k, const Triangle& t, std::uint32_t l) const {
    const Corners a = corners(s), b = corners(t);
    const Segment opposite_s{at(s[(k + 1) % 3]), at(s[(k + 2) % 3])},
        opposite_t{at(t[(l + 1) % 3]), at(t[(l + 2) % 3])};
    if (one_side(b, opposite_s.p, opposite_s.q) || one_side(a, opposite_t.p, opposite_t.q)) return std::nullopt;
    if (meet(opposite_s, b)) return position(opposite_s, b);
    if (meet(opposite_t, a)) return position(opposite_t, a);
    return std::nullopt;
  }

  /// A common point of triangles with two common vertices, the corners k and l being the others: the edge between the
  /// common ones has to be an edge of both faces, and they may not lie on each other.
  std::optional<Point3> edge_meeting(std::uint32_t i, std::uint32_t k, std::uint32_t j, std::uint32_t l) const {
    const Triangle &s = triangles_.triangles[i], &t = triangles_.triangles[j];
    const Point3 &u = at(s[(k + 1) % 3]), &v = at(s[(k + 2) % 3]), &a = at(s[k]), &b = at(t[l]);
    const Point3 midpoint{u.x / 2 + v.x / 2, u.y / 2 + v.y / 2, u.z / 2 + v.z / 2};
    if (!is_edge_[3 * i + (k + 1) % 3] || !is_edge_[3 * j + (l + 1) % 3]) return midpoint;
    if (orient3_sign(u, v, a, b) != 0) return std::nullopt;
    const exact::Axis axis = axis_of({u, v, a});
    return exact::normal_sign(u, v, a, axis) == exact::normal_sign(u, v, b, axis) ? std::optional(midpoint)
                                                                                  : std::nullopt;
  }

  const MeshData& data_;
  const Triangles& triangles_;
  std::vector<bool> is_edge_;  // per triangle t its side from corner k on: 3 t + k
};

}  // namespace

BoxTree boxes_of(const std::vector<Point3>& vertices, const std::vector<Triangle>& triangles) {
  std::vector<Box> boxes(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const std::uint32_t v : triangles[t]) boxes[t].add(Vec3{vertices[v].x, vertices[v].y, vertices[v].z});
  }
  return BoxTree(std::move(boxes));
}

std::optional<FaceMeeting> find_meeting(const MeshData& data, const Triangles& triangles, const BoxTree& boxes) {
  return MeetingSearch(data, triangles).run(boxes);
}

std::vector<std::array<std::uint32_t, 2>> find_meetings(const MeshData& data, const Triangles& triangles,
                                                        const BoxTree& boxes, const std::vector<bool>& queried) {
  return MeetingSearch(data, triangles).all(boxes, queried);
}

}  // namespace dymsum::spatial
