#include "shape/complex/exact_complex.h"

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
template DiscOf<exact::RootExpression> disc_of(const Walks&, const DiscSource&);
template exact::Interval radius_of(const Walks&, const DiscSource&);
template exact::RootExpression radius_of(const Walks&, const DiscSource&);

}  // namespace dymsum::shape
