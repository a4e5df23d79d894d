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

/// A closed segment with ends on both sides of the plane of a closed triangle, or one of them on it: the line meets the
/// plane once, inside the triangle unless it passes the sides in different senses.
bool pass_sides_alike(const std::array<int, 3>& senses) {
  const auto [least, most] = std::minmax_element(senses.begin(), senses.end());
  return *least * *most >= 0;
}

std::array<int, 3> sides_of(const Corners& plane, const Corners& t) {
  return {orient3_sign(plane.a, plane.b, plane.c, t.a), orient3_sign(plane.a, plane.b, plane.c, t.b),
          orient3_sign(plane.a, plane.b, plane.c, t.c)};
}
bool on_one_side(const std::array<int, 3>& side) { return side[0] != 0 && side[0] == side[1] && side[0] == side[2]; }

/// A closed segment and a closed triangle, with the sides of its plane on which the ends are, not both on one of them.
bool meet(const Segment& s, const Corners& t, int p_side, int q_side) {
  if (p_side == 0 && q_side == 0) return meet_in_plane(s, t);
  return pass_sides_alike(
      {orient3_sign(s.p, s.q, t.a, t.b), orient3_sign(s.p, s.q, t.b, t.c), orient3_sign(s.p, s.q, t.c, t.a)});
}

Segment side_of(const Corners& t, std::size_t k) {
  return k == 0 ? Segment{t.a, t.b} : k == 1 ? Segment{t.b, t.c} : Segment{t.c, t.a};
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
  /// Of faces that are the triangles.
  MeetingSearch(const std::vector<Point3>& vertices, const std::vector<Triangle>& triangles)
      : vertices_(vertices), triangles_(triangles) {}
  MeetingSearch(const MeshData& data, const Triangles& triangles)
      : vertices_(data.vertices), triangles_(triangles.triangles) {
    mark_edges(data.faces, triangles.face);
  }

  std::optional<FaceMeeting> run(const BoxTree& boxes, const std::vector<std::uint32_t>& face) const {
    std::optional<FaceMeeting> first;
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
      if (first && first->face < face[i]) break;
      boxes.for_each(boxes.box(i), [&](std::uint32_t j) {
        if (face[j] <= face[i]) return;
        if (first && first->other_face <= face[j]) return;
        if (const auto at = meeting(i, j)) first = {face[i], face[j], *at};
      });
    }
    return first;
  }

  std::vector<std::array<std::uint32_t, 2>> all(const BoxTree& boxes, const std::vector<bool>& queried) const {
    std::vector<std::array<std::uint32_t, 2>> found;
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
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
  void mark_edges(const std::vector<Face>& faces, const std::vector<std::uint32_t>& face_of) {
    is_edge_.resize(3 * triangles_.size());
    std::vector<std::uint32_t> next(vertices_.size());
    for (std::size_t t = 0, f = faces.size(); t < triangles_.size(); ++t) {
      if (f != face_of[t]) {
        f = face_of[t];
        const Face& face = faces[f];
        for (std::size_t k = 0; k < face.size(); ++k) next[face[k]] = face[(k + 1) % face.size()];
      }
      const Triangle& corners = triangles_[t];
      for (std::size_t k = 0; k < 3; ++k) is_edge_[3 * t + k] = next[corners[k]] == corners[(k + 1) % 3];
    }
  }
  bool is_edge(std::uint32_t t, std::size_t k) const { return is_edge_.empty() || is_edge_[3 * t + k]; }

  const Point3& at(std::uint32_t v) const { return vertices_[v]; }
  Corners corners(const Triangle& t) const { return {at(t[0]), at(t[1]), at(t[2])}; }

  /// A common point of two triangles of different faces that they may not have.
  std::optional<Point3> meeting(std::uint32_t i, std::uint32_t j) const {
    const Triangle &s = triangles_[i], &t = triangles_[j];
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

  /// A common point of triangles without a common vertex, on a side of one of the two: any is too much. An orientation
  /// of a side of the one and a side of the other is that of these in the other order: it is found once.
  std::optional<Point3> apart_meeting(const Triangle& s, const Triangle& t) const {
    const std::array<Corners, 2> of{corners(s), corners(t)};
    std::array<std::array<int, 3>, 2> side;  // of the corners of each, of the other's plane
    for (std::size_t k = 0; k < 2; ++k) {
      side[k] = sides_of(of[1 - k], of[k]);
      if (on_one_side(side[k])) return std::nullopt;
    }
    std::array<std::array<std::optional<int>, 3>, 3> sense;  // of sides of the first and of the second
    for (std::size_t k = 0; k < 2; ++k) {
      for (std::size_t i = 0; i < 3; ++i) {
        const Segment one = side_of(of[k], i);
        const int p_side = side[k][i], q_side = side[k][(i + 1) % 3];
        if (p_side * q_side > 0) continue;
        bool met = false;
        if (p_side == 0 && q_side == 0) {
          met = meet_in_plane(one, of[1 - k]);
        } else {
          std::array<int, 3> senses;
          for (std::size_t j = 0; j < 3; ++j) {
            std::optional<int>& known = k == 0 ? sense[i][j] : sense[j][i];
            const Segment other = side_of(of[1 - k], j);
            if (!known) known = orient3_sign(one.p, one.q, other.p, other.q);
            senses[j] = *known;
          }
          met = pass_sides_alike(senses);
        }
        if (met) return position(one, of[1 - k]);
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
    const auto sides = [](const Corners& plane, const Segment& ends) {
      return std::array{orient3_sign(plane.a, plane.b, plane.c, ends.p),
                        orient3_sign(plane.a, plane.b, plane.c, ends.q)};
    };
    const auto [s_p, s_q] = sides(b, opposite_s);
    if (s_p * s_q > 0) return std::nullopt;
    const auto [t_p, t_q] = sides(a, opposite_t);
    if (t_p * t_q > 0) return std::nullopt;
    if (meet(opposite_s, b, s_p, s_q)) return position(opposite_s, b);
    if (meet(opposite_t, a, t_p, t_q)) return position(opposite_t, a);
    return std::nullopt;
  }

  /// A common point of triangles with two common vertices, the corners k and l being the others: the edge between the
  /// common ones has to be an edge of both faces, and they may not lie on each other.
  std::optional<Point3> edge_meeting(std::uint32_t i, std::uint32_t k, std::uint32_t j, std::uint32_t l) const {
    const Triangle &s = triangles_[i], &t = triangles_[j];
    const Point3 &u = at(s[(k + 1) % 3]), &v = at(s[(k + 2) % 3]), &a = at(s[k]), &b = at(t[l]);
    const Point3 midpoint{u.x / 2 + v.x / 2, u.y / 2 + v.y / 2, u.z / 2 + v.z / 2};
    if (!is_edge(i, (k + 1) % 3) || !is_edge(j, (l + 1) % 3)) return midpoint;
    if (orient3_sign(u, v, a, b) != 0) return std::nullopt;
    const exact::Axis axis = axis_of({u, v, a});
    return exact::normal_sign(u, v, a, axis) == exact::normal_sign(u, v, b, axis) ? std::optional(midpoint)
                                                                                  : std::nullopt;
  }

  const std::vector<Point3>& vertices_;
  const std::vector<Triangle>& triangles_;
  std::vector<bool> is_edge_;  // per triangle t its side from corner k on: 3 t + k; empty where all are
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
  return MeetingSearch(data, triangles).run(boxes, triangles.face);
}

std::vector<std::array<std::uint32_t, 2>> find_meetings(const MeshData& data, const Triangles& triangles,
                                                        const BoxTree& boxes, const std::vector<bool>& queried) {
  return MeetingSearch(data, triangles).all(boxes, queried);
}

std::vector<std::array<std::uint32_t, 2>> find_meetings(const std::vector<Point3>& vertices,
                                                        const std::vector<Triangle>& triangles, const BoxTree& boxes,
                                                        const std::vector<bool>& queried) {
  return MeetingSearch(vertices, triangles).all(boxes, queried);
}

}  // namespace dymsum::spatial
