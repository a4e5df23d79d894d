#include "depth/touching_oracle.h"

#include <algorithm>
#include <set>

namespace dymsum::test {
namespace {

using Kind = SolidFeature::Kind;

Position minus(const Position& a, const Position& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
BigRational dot(const Position& a, const Position& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Position cross(const Position& a, const Position& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
bool is_zero(const Position& v) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }
Position along(const Position& a, const Position& b, const BigRational& s) {
  const Position d = minus(b, a);
  return {a[0] + s * d[0], a[1] + s * d[1], a[2] + s * d[2]};
}

/// A face as a polygon in space.
struct Polygon {
  std::vector<Position> at;
  Position n{};

  Polygon(const TouchingShape& shape, const Face& face) {
    for (const std::uint32_t v : face) at.push_back(shape.at[v]);
    for (std::size_t k = 0; k < at.size(); ++k) {
      const Position c = cross(at[k], next(k));
      for (std::size_t i = 0; i < 3; ++i) n[i] += c[i];
    }
  }
  const Position& next(std::size_t k) const { return at[(k + 1) % at.size()]; }
  bool in_plane(const Position& x) const { return dot(n, minus(x, at[0])) == 0; }
};

/// A feature, and a box that holds it and what rounding may do to it.
struct BoxedFeature {
  SolidFeature feature;
  std::array<double, 3> low, high;
};

bool boxes_meet(const BoxedFeature& a, const BoxedFeature& b) {
  for (std::size_t k = 0; k < 3; ++k)
    if (a.low[k] > b.high[k] || b.low[k] > a.high[k]) return false;
  return true;
}

bool on_edge(const Position& a, const Position& b, const Position& x) {
  const Position d = minus(b, a), to = minus(x, a);
  if (!is_zero(cross(d, to))) return false;
  const BigRational s = dot(d, to);
  return s > 0 && s < dot(d, d);
}

bool inside(const Polygon& f, const Position& x) {
  if (!f.in_plane(x)) return false;
  std::size_t drop = 0;
  while (f.n[drop] == 0) ++drop;
  const std::size_t i = (drop + 1) % 3, j = (drop + 2) % 3;
  bool odd = false;
  for (std::size_t k = 0; k < f.at.size(); ++k) {
    const Position &a = f.at[k], &b = f.next(k);
    if (a == x || on_edge(a, b, x)) return false;
    if ((a[j] > x[j]) != (b[j] > x[j]) && x[i] < a[i] + (x[j] - a[j]) / (b[j] - a[j]) * (b[i] - a[i])) odd = !odd;
  }
  return odd;
}

/// Where on the segment ab, in a polygon's plane, the polygon's edges end or cross its line: middles between these.
std::vector<Position> midpoints(const Polygon& f, const Position& a, const Position& b) {
  const Position d = minus(b, a), left = cross(f.n, d);
  std::vector<BigRational> cuts{0, 1};
  for (std::size_t k = 0; k < f.at.size(); ++k) {
    const BigRational u = dot(left, minus(f.at[k], a)), v = dot(left, minus(f.next(k), a));
    const auto cut = [&](const Position& x) {
      const BigRational s = dot(d, minus(x, a)) / dot(d, d);
      if (s > 0 && s < 1) cuts.push_back(s);
    };
    if (u == 0) cut(f.at[k]);
    if ((u > 0 && v < 0) || (u < 0 && v > 0)) cut(along(f.at[k], f.next(k), u / (u - v)));
  }
  std::sort(cuts.begin(), cuts.end());
  std::vector<Position> all;
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
    if (cuts[k] < cuts[k + 1]) all.push_back(along(a, b, (cuts[k] + cuts[k + 1]) / 2));
  return all;
}

bool edge_meets_face(const Position& a, const Position& b, const Polygon& f) {
  const BigRational u = dot(f.n, minus(a, f.at[0])), v = dot(f.n, minus(b, f.at[0]));
  if (u == 0 && v == 0) {
    const std::vector<Position> some = midpoints(f, a, b);
    return std::any_of(some.begin(), some.end(), [&](const Position& x) { return inside(f, x); });
  }
  return ((u > 0 && v < 0) || (u < 0 && v > 0)) && inside(f, along(a, b, u / (u - v)));
}

/// Whether near some edge of f the inside of f lies inside of g.
bool begins_inside(const Polygon& f, const Polygon& g) {
  for (std::size_t k = 0; k < f.at.size(); ++k) {
    const Position inward = cross(f.n, minus(f.next(k), f.at[k]));
    for (const Position& x : midpoints(g, f.at[k], f.next(k))) {
      if (inside(g, x)) return true;
      for (std::size_t j = 0; j < g.at.size(); ++j)
        if (on_edge(g.at[j], g.next(j), x) && dot(inward, cross(g.n, minus(g.next(j), g.at[j]))) > 0) return true;
    }
  }
  return false;
}

bool faces_meet(const Polygon& f, const Polygon& g) {
  return is_zero(cross(f.n, g.n)) && f.in_plane(g.at[0]) && (begins_inside(f, g) || begins_inside(g, f));
}

/// 1 for a segment in common, 0 for a point, -1 for nothing.
int edges_meet(const Position& a, const Position& b, const Position& c, const Position& d) {
  const Position u = minus(b, a), v = minus(d, c), w = minus(c, a), n = cross(u, v);
  if (is_zero(n)) {
    if (!is_zero(cross(u, w))) return -1;
    const BigRational s = dot(u, w), t = dot(u, minus(d, a)), all = dot(u, u), low = s < t ? s : t,
                      high = s < t ? t : s;
    return low < all && high > 0 ? 1 : -1;
  }
  if (dot(n, w) != 0) return -1;
  const BigRational all = dot(n, n), s = dot(cross(w, v), n) / all, t = dot(cross(w, u), n) / all;
  return s > 0 && s < 1 && t > 0 && t < 1 ? 0 : -1;
}

std::vector<BoxedFeature> features_of(const TouchingShape& s) {
  std::vector<BoxedFeature> all;
  const auto add = [&](const SolidFeature& feature, const auto& vertices) {
    BoxedFeature& boxed = all.emplace_back(BoxedFeature{feature, {1e9, 1e9, 1e9}, {-1e9, -1e9, -1e9}});
    for (const std::uint32_t v : vertices)
      for (std::size_t k = 0; k < 3; ++k) {
        const double c = exact::round_to_double(s.at[v][k]);
        boxed.low[k] = std::min(boxed.low[k], c - 1e-6), boxed.high[k] = std::max(boxed.high[k], c + 1e-6);
      }
  };
  for (std::uint32_t v = 0; v < s.at.size(); ++v) add({Kind::vertex, v, 0}, std::array{v});
  for (const auto& edge : s.edges) add({Kind::edge, edge[0], edge[1]}, edge);
  for (std::uint32_t f = 0; f < s.faces.size(); ++f)
    if (s.faces[f].size() > 2) add({Kind::face, f, 0}, s.faces[f]);
  return all;
}

/// The dimension in common, -1 for nothing. Requires f of no larger dimension than g.
int meet(const TouchingShape& s, const SolidFeature& f, const TouchingShape& t, const SolidFeature& g) {
  if (f.kind == Kind::vertex) return feature_holds(t, g, s.at[f.a]) ? 0 : -1;
  if (f.kind == Kind::edge && g.kind == Kind::edge) return edges_meet(s.at[f.a], s.at[f.b], t.at[g.a], t.at[g.b]);
  const Polygon face(t, t.faces[g.a]);
  if (f.kind == Kind::edge) return edge_meets_face(s.at[f.a], s.at[f.b], face) ? 1 : -1;
  return faces_meet(Polygon(s, s.faces[f.a]), face) ? 2 : -1;
}

}  // namespace

Position exact_position(const RationalPoint3& x) {
  return {exact::exact_value(x.x), exact::exact_value(x.y), exact::exact_value(x.z)};
}

TouchingShape touching_shape(const Mesh& mesh, const Position& moved) {
  TouchingShape shape;
  for (const Point3& v : mesh.vertices())
    shape.at.push_back(
        {exact::exact_value(v.x) + moved[0], exact::exact_value(v.y) + moved[1], exact::exact_value(v.z) + moved[2]});
  shape.faces = mesh.faces();
  std::set<std::array<std::uint32_t, 2>> edges;
  for (const Face& face : shape.faces)
    for (std::size_t k = 0; face.size() > 1 && k < face.size(); ++k) {
      const std::uint32_t a = face[k], b = face[(k + 1) % face.size()];
      edges.insert({std::min(a, b), std::max(a, b)});
    }
  shape.edges.assign(edges.begin(), edges.end());
  return shape;
}

bool feature_holds(const TouchingShape& shape, const SolidFeature& f, const Position& x) {
  if (f.kind == Kind::vertex) return shape.at[f.a] == x;
  if (f.kind == Kind::edge) return on_edge(shape.at[f.a], shape.at[f.b], x);
  return inside(Polygon(shape, shape.faces[f.a]), x);
}

std::map<std::pair<SolidFeature, SolidFeature>, int> touching_by_definition(const TouchingShape& p,
                                                                            const TouchingShape& q) {
  std::map<std::pair<SolidFeature, SolidFeature>, int> all;
  const std::vector<BoxedFeature> of_q = features_of(q);
  for (const BoxedFeature& one : features_of(p))
    for (const BoxedFeature& other : of_q) {
      if (!boxes_meet(one, other)) continue;
      const SolidFeature &f = one.feature, &g = other.feature;
      const int dimension = f.kind <= g.kind ? meet(p, f, q, g) : meet(q, g, p, f);
      if (dimension >= 0) all[{f, g}] = dimension;
    }
  return all;
}

}  // namespace dymsum::test
