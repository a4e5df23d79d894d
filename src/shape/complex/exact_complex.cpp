#include "shape/complex/exact_complex.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "exact/orient.h"

namespace dymsum::shape {
namespace {

template <class T>
struct Position {
  T x, y;
};

template <class T>
Position<T> position(const BoundaryPoint& p) {
  if constexpr (std::is_same_v<T, exact::Interval>) {
    return {p.ix, p.iy};
  } else if constexpr (std::is_same_v<T, exact::FineInterval>) {
    return {T(p.ix), T(p.iy)};
  } else {
    return {T(p.x), T(p.y)};
  }
}

template <class T>
T value_at(const Quadratic<T>& f, const T& x) {
  return (f.a * x + f.b) * x + f.c;
}

template <class T>
DiscOf<T> disc_along(const Walks& walks, const DiscSource& d) {
  const Formulas<T> formulas(walks);
  const auto f = formulas.frame(d.section.site);
  const T u = formulas.value(d.section, d.mark), r = value_at(formulas.radius_along(f, d.other), u);
  const T length2 = T(f.length2);
  const Position<T> a = position<T>(walks.points[f.a]);
  return {a.x + (u * T(f.d.x) + r * T(f.n.x)) / length2, a.y + (u * T(f.d.y) + r * T(f.n.y)) / length2,
          r / sqrt(length2)};
}

template <class T>
DiscOf<T> disc_about(const Walks& walks, const DiscSource& d) {
  const Formulas<T> formulas(walks);
  const T x = formulas.value(d.section, d.mark);
  const T g = value_at(formulas.curvature_about(d.section, d.other), x), xx = x * x;
  const Vec<T> w = turned_back(Vec<T>{(T(1) - xx) / g, T(2) * x / g}, (4 - d.section.axis) % 4);
  const Position<T> v = position<T>(walks.points[walks.ends[d.section.site].a]);
  return {v.x + w.x, v.y + w.y, (T(1) + xx) / g};
}

template <class T>
DiscOf<T> disc_between(const Walks& walks, const DiscSource& d) {
  const std::uint32_t a = walks.ends[d.section.site].a, b = walks.ends[d.other].a;
  const Position<T> p = position<T>(walks.points[a]), q = position<T>(walks.points[b]);
  const auto v = Formulas<T>(walks).between(a, b);
  return {(p.x + q.x) / T(2), (p.y + q.y) / T(2), sqrt(T(dot(v, v))) / T(2)};
}

}  // namespace

template <class T>
DiscOf<T> disc_of(const Walks& walks, const DiscSource& d) {
  if (d.kind == DiscSource::Kind::corner) {
    const Position<T> p = position<T>(walks.points[d.point]);
    return {p.x, p.y, T(0)};
  }
  if (d.kind == DiscSource::Kind::neck) return disc_between<T>(walks, d);
  return walks.is_edge(d.section.site) ? disc_along<T>(walks, d) : disc_about<T>(walks, d);
}

template <class T>
T radius_of(const Walks& walks, const DiscSource& d) {
  return disc_of<T>(walks, d).radius;
}

template DiscOf<exact::Interval> disc_of(const Walks&, const DiscSource&);
template DiscOf<exact::FineInterval> disc_of(const Walks&, const DiscSource&);
template DiscOf<exact::RootExpression> disc_of(const Walks&, const DiscSource&);
template exact::Interval radius_of(const Walks&, const DiscSource&);
template exact::FineInterval radius_of(const Walks&, const DiscSource&);
template exact::RootExpression radius_of(const Walks&, const DiscSource&);

namespace {

using exact::RootExpression;

RootExpression grid_unit(const Walks& walks) { return RootExpression(std::ldexp(1.0, walks.grid_exponent)); }

/// The discs of one edge of a complex at a radius. Sites: one that is an edge if there is one.
class OnEdge {
 public:
  OnEdge(const Complex& complex, std::uint32_t edge) : walks_(complex.exact->walks), edge_(complex.edges[edge]) {
    const bool left = walks_.is_edge(edge_.left) || !walks_.is_edge(edge_.right);
    s_ = left ? edge_.left : edge_.right;
    j_ = left ? edge_.right : edge_.left;
    forwards_ = left;
  }

  /// The centre in grid units. The radius grows along s if `forwards`, against it if not.
  ExactPoint centre(const RootExpression& r) const {
    if (!walks_.is_edge(s_)) return between_vertices(r);
    const auto f = formulas_.frame(s_);
    const RootExpression length2(f.length2), scaled = r * sqrt(length2);
    const auto p = formulas_.local(f, walks_.ends[j_].a);
    const RootExpression u = walks_.is_edge(j_) ? along_line(f, scaled) : along_parabola(p, scaled);
    const BoundaryPoint& a = walks_.points[f.a];
    return {RootExpression(a.x) + (u * RootExpression(f.d.x) + scaled * RootExpression(f.n.x)) / length2,
            RootExpression(a.y) + (u * RootExpression(f.d.y) + scaled * RootExpression(f.n.y)) / length2};
  }

 private:
  using F = Formulas<RootExpression>;

  RootExpression along_line(const F::Frame& f, const RootExpression& scaled) const {
    const Quadratic<RootExpression> q = formulas_.radius_along(f, j_);
    return (scaled - q.c) / q.b;
  }
  RootExpression along_parabola(const Vec<exact::BigInteger>& p, const RootExpression& scaled) const {
    const RootExpression y(p.y), half = sqrt(y * (RootExpression(2) * scaled - y));
    return forwards_ ? RootExpression(p.x) + half : RootExpression(p.x) - half;
  }
  /// The centre lies from the midpoint perpendicularly to the vector from s to j: forwards, s on the left, is to its
  /// left.
  ExactPoint between_vertices(const RootExpression& r) const {
    const BoundaryPoint &p = walks_.points[walks_.ends[s_].a], &q = walks_.points[walks_.ends[j_].a];
    const auto d = formulas_.between(walks_.ends[s_].a, walks_.ends[j_].a);
    const RootExpression d2(dot(d, d)), h = sqrt(r * r / d2 - RootExpression(1) / RootExpression(4));
    const RootExpression k = forwards_ ? h : -h, two(2);
    return {RootExpression(exact::BigInteger(p.x + q.x)) / two - k * RootExpression(d.y),
            RootExpression(exact::BigInteger(p.y + q.y)) / two + k * RootExpression(d.x)};
  }

  const Walks& walks_;
  F formulas_{walks_};
  Edge edge_;
  std::uint32_t s_ = 0, j_ = 0;
  bool forwards_ = true;
};

Point rounded(const ExactPoint& p) { return {exact::nearest_double(p.x), exact::nearest_double(p.y)}; }

}  // namespace

RootExpression exact_radius(const Complex& complex, std::uint32_t node) {
  const ExactComplex& exact = *complex.exact;
  return radius_of<RootExpression>(exact.walks, exact.discs[node]) * grid_unit(exact.walks);
}

int compare_radius(const Complex& complex, std::uint32_t node, const Rational& r) {
  const ExactComplex& exact = *complex.exact;
  const exact::Interval& near = exact.radii[node];
  const exact::Interval unit(std::ldexp(1.0, exact.walks.unit_exponent));
  const exact::BigRational value = exact::exact_value(r);
  if (const std::optional<int> sign = sign_of(near * unit - exact::Interval(value))) return *sign;
  return exact::compare(exact_radius(complex, node), RootExpression(value));
}

std::uint32_t nodes_below(const Complex& complex, const Rational& r) {
  std::uint32_t low = 0, high = static_cast<std::uint32_t>(complex.nodes.size());
  while (low < high) {
    const std::uint32_t midpoint = (low + high) / 2;
    compare_radius(complex, midpoint, r) < 0 ? low = midpoint + 1 : high = midpoint;
  }
  return low;
}

std::uint32_t nodes_up_to(const Complex& complex, const Rational& r) {
  std::uint32_t low = 0, high = static_cast<std::uint32_t>(complex.nodes.size());
  while (low < high) {
    const std::uint32_t midpoint = (low + high) / 2;
    compare_radius(complex, midpoint, r) <= 0 ? low = midpoint + 1 : high = midpoint;
  }
  return low;
}

ExactDisc exact_disc(const Complex& complex, std::uint32_t node) {
  const ExactComplex& exact = *complex.exact;
  const DiscOf<RootExpression> d = disc_of<RootExpression>(exact.walks, exact.discs[node]);
  const RootExpression unit = grid_unit(exact.walks);
  return {{d.x * unit, d.y * unit}, d.radius * unit};
}

ExactPoint exact_contact(const Complex& complex, std::uint32_t site, const ExactPoint& centre) {
  const Site& s = complex.sites[site];
  const RootExpression ax(s.a.x), ay(s.a.y);
  if (s.kind == Site::Kind::vertex) return {ax, ay};
  const RootExpression dx = RootExpression(s.b.x) - ax, dy = RootExpression(s.b.y) - ay;
  const RootExpression k = ((centre.x - ax) * dx + (centre.y - ay) * dy) / (dx * dx + dy * dy);
  return {ax + k * dx, ay + k * dy};
}

std::vector<Contact> contacts_of(const Complex& complex, std::uint32_t node) {
  const ExactDisc disc = exact_disc(complex, node);
  std::vector<Contact> out;
  for (const std::uint32_t s : complex.exact->contacts[node])
    out.push_back({s, rounded(exact_contact(complex, s, disc.centre))});
  return out;
}

ExactPoint exact_centre_on_edge(const Complex& complex, std::uint32_t edge, const Rational& r) {
  if (complex.edges[edge].flat) throw std::invalid_argument("discs of a flat edge are not told by their radius");
  const RootExpression unit = grid_unit(complex.exact->walks);
  const ExactPoint c = OnEdge(complex, edge).centre(RootExpression(exact::exact_value(r)) / unit);
  return {c.x * unit, c.y * unit};
}

DiscOnEdge disc_on_edge(const Complex& complex, std::uint32_t edge, const Rational& r) {
  const ExactPoint c = exact_centre_on_edge(complex, edge, r);
  const Edge& e = complex.edges[edge];
  return {rounded(c), rounded(exact_contact(complex, e.left, c)), rounded(exact_contact(complex, e.right, c))};
}

}  // namespace dymsum::shape
