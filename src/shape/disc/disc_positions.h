// A level and the positions at it: doubles near its corners, and exact ones.
#pragma once

#include <functional>
#include <string>

#include "dymsum/growing_disc.h"
#include "shape/complex/complex.h"

namespace dymsum::shape {

// Discs of a given radius that touch two sites: formulas over a number type, exact::Interval or exact::RootExpression.

template <class T>
struct Vector {
  T x, y;
};

template <class T>
Vector<T> between(Point from, Point to) {
  return {T(to.x) - T(from.x), T(to.y) - T(from.y)};
}
template <class T>
T cross(const Vector<T>& a, const Vector<T>& b) {
  return a.x * b.y - a.y * b.x;
}
template <class T>
T dot(const Vector<T>& a, const Vector<T>& b) {
  return a.x * b.x + a.y * b.y;
}

/// The normal of an edge site towards its discs times its length.
template <class T>
Vector<T> long_normal(const Site& site) {
  const Vector<T> d = between<T>(site.a, site.b);
  return {d.y, -d.x};
}

/// Solves m . x = r |m| + m . (a - origin) for both edges.
template <class T>
Vector<T> centre_of_edges(const Site& s, const Site& t, const T& r, Point origin) {
  const Vector<T> m = long_normal<T>(s), n = long_normal<T>(t);
  const T k = r * sqrt(dot(m, m)) + dot(m, between<T>(origin, s.a));
  const T l = r * sqrt(dot(n, n)) + dot(n, between<T>(origin, t.a));
  const T d = cross(m, n);
  return {(k * n.y - l * m.y) / d, (m.x * l - n.x * k) / d};
}

/// The same for edges that follow each other and turn little: no difference of nearly equal numbers.
template <class T>
Vector<T> centre_in_corner(const Site& s, const Site& t, Point corner, const T& r, Point origin) {
  const Vector<T> m = long_normal<T>(s), n = long_normal<T>(t), v = between<T>(origin, corner);
  const T a = sqrt(dot(m, m)), b = sqrt(dot(n, n)), w = r / (a * b + dot(m, n));
  return {v.x + w * (m.x * b + n.x * a), v.y + w * (m.y * b + n.y * a)};
}

/// Whether the normals of two edges are less than a right angle apart: by doubles, as either formula holds.
inline bool turn_little(const Site& s, const Site& t) {
  return (s.b.x - s.a.x) * (t.b.x - t.a.x) + (s.b.y - s.a.y) * (t.b.y - t.a.y) > 0;
}

/// With h the height of the vertex over the edge: r over the edge, sqrt(r^2 - (r - h)^2) along it from the vertex.
/// Radii ascend in the edge's direction where the edge is on the left.
template <class T>
Vector<T> centre_of_edge_and_vertex(const Site& edge, const Site& vertex, bool edge_left, const T& r, Point origin) {
  const Vector<T> m = long_normal<T>(edge);
  const T squared = dot(m, m), length = sqrt(squared);
  const T h = dot(m, between<T>(edge.a, vertex.a)) / length;
  const T along = sqrt(h * (r + r - h)) / length, up = (r - h) / length;
  const T w = edge_left ? along : -along;
  const Vector<T> v = between<T>(origin, vertex.a);
  return {v.x + m.x * up - m.y * w, v.y + m.y * up + m.x * w};
}

template <class T>
Vector<T> centre_of_vertices(Point left, Point right, const T& r, Point origin) {
  const Vector<T> d = between<T>(left, right), a = between<T>(origin, left), b = between<T>(origin, right);
  const T half = T(0.5);
  const T w = sqrt(r * r / dot(d, d) - half * half);
  return {half * (a.x + b.x) - d.y * w, half * (a.y + b.y) + d.x * w};
}

/// The centre of the disc of radius r on an edge of the complex that is not flat, relative to `origin`. Requires: its
/// radii include r.
template <class T>
Vector<T> centre_on_edge(const Complex& complex, std::uint32_t edge, const T& r, Point origin) {
  const Site& left = complex.sites[complex.edges[edge].left];
  const Site& right = complex.sites[complex.edges[edge].right];
  const bool edge_left = left.kind == Site::Kind::edge, edge_right = right.kind == Site::Kind::edge;
  if (edge_left && edge_right) {
    if (left.a == right.b && turn_little(left, right)) return centre_in_corner(left, right, left.a, r, origin);
    if (left.b == right.a && turn_little(left, right)) return centre_in_corner(left, right, left.b, r, origin);
    return centre_of_edges(left, right, r, origin);
  }
  if (edge_left) return centre_of_edge_and_vertex(left, right, true, r, origin);
  if (edge_right) return centre_of_edge_and_vertex(right, left, false, r, origin);
  return centre_of_vertices(left.a, right.a, r, origin);
}

// Vectors in intervals, and exactly when these do not decide.

template <class T>
Vector<T> minus(const Vector<T>& a, const Vector<T>& b) {
  return {a.x - b.x, a.y - b.y};
}
template <class T>
Vector<T> plus(const Vector<T>& a, const Vector<T>& b) {
  return {a.x + b.x, a.y + b.y};
}

/// The position at which a circle of radius r is crossed by that about `d`, clockwise of d or counter-clockwise; where
/// they touch, in case |d| = 2 r. Requires |d| <= 2 r.
template <class T>
Vector<T> crossing(const Vector<T>& d, const T& r, bool clockwise) {
  const T half = T(0.5);
  const T w = sqrt(r * r / dot(d, d) - half * half);
  const T v = clockwise ? -w : w;
  return {half * d.x - d.y * v, half * d.y + d.x * v};
}

struct LazyVector {
  Vector<exact::Interval> near;
  std::function<Vector<exact::RootExpression>()> exact;
};

inline int sign_of_cross(const LazyVector& a, const LazyVector& b) {
  if (const auto sign = sign_of(cross(a.near, b.near))) return *sign;
  return exact::sign_of(cross(a.exact(), b.exact()));
}
inline int sign_of_y(const LazyVector& a) {
  if (const auto sign = sign_of(a.near.y)) return *sign;
  return exact::sign_of(a.exact().y);
}

// A radius among the nodes of a complex.

/// Nodes [0, below) have smaller radii, [below, up_to) this one.
struct Level {
  std::uint32_t below = 0, up_to = 0;
  exact::RootExpression exact;
  exact::Interval near;  ///< contains it
  double radius = 0;     ///< the nearest double
  std::string text;
  bool holds(std::uint32_t node) const { return below <= node && node < up_to; }
};

/// Events are the radii of nodes beyond 0. O(n).
std::vector<DiscEvent> disc_events(const Complex& complex);
/// Error out_of_range for a negative radius, one that is no positive double, and an event that there is not.
Result<Level> level_at(const Complex& complex, const DiscRadius& r);

/// Whether an edge rises from nodes [0, cut) to one of the others or to infinity: the disc there, with `cut` between
/// two radii or just above or below one, touches on both sides of it.
inline bool crosses(const Edge& edge, std::uint32_t cut) { return edge.low < cut && edge.high >= cut; }

/// A vector by a formula, each component within 2^-43 of `scale`: intervals first, the exact expression where these are
/// wider.
template <class Formula>
Point near_vector(const Formula& formula, const Level& level, double scale) {
  const Vector<exact::Interval> v = formula(level.near);
  const double width = std::max(v.x.high() - v.x.low(), v.y.high() - v.y.low());
  if (!v.x.is_whole() && !v.y.is_whole() && width <= 0x1p-43 * scale) return {v.x.midpoint(), v.y.midpoint()};
  const Vector<exact::RootExpression> w = formula(level.exact);
  return {exact::nearest_double(w.x), exact::nearest_double(w.y)};
}

class DiscPositions {
 public:
  DiscPositions(const Complex& complex, const Level& level);

  /// The disc of this level on an edge of the complex that reaches it: at its node where that is of this radius.
  CornerDisc disc_on(std::uint32_t edge) const;
  /// Its centre, within 2^-42 of the reach.
  Point centre(const CornerDisc& disc) const;
  /// The vector to the centre from a vertex that the disc touches, within 2^-43 of the radius.
  Point centre_from(const CornerDisc& disc, Point vertex) const;
  Vector<exact::RootExpression> exact_centre_from(const CornerDisc& disc, Point origin) const;
  /// The unit normal of an edge site towards its discs.
  Point normal(const Site& site) const;
  /// The vector from a disc's centre to where it touches a site, of length radius; and that position.
  Point towards(const CornerDisc& disc, const Site& site) const;
  Point contact(const CornerDisc& disc, const Site& site) const;

  /// The largest coordinate of the region, or the radius where that is larger.
  double reach() const { return reach_; }
  /// Positions of a set are within this in each coordinate: a centre is within 2^-42 of the reach, and a contact takes
  /// a few roundings more.
  double at_error() const { return 0x1p-41 * reach_; }
  const Complex& complex() const { return complex_; }
  const Level& level() const { return level_; }

 private:
  const Complex& complex_;
  const Level& level_;
  double reach_ = 0;
};

}  // namespace dymsum::shape
