// Discs of a given radius that touch two sites: formulas over a number type, exact::Interval or exact::RootExpression.
#pragma once

#include "shape/complex/complex.h"

namespace dymsum::shape {

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

}  // namespace dymsum::shape
