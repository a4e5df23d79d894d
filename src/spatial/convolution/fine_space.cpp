#include "spatial/convolution/fine_space.h"

namespace dymsum::spatial {

using exact::cross;
using exact::dot;

namespace {

/// The type of a product of two.
template <class N>
std::optional<int> sign_of_product(const N& a, const N& b) {
  const std::optional<int> s = sign_of(a);
  if (!s) return s;
  const std::optional<int> t = sign_of(b);
  return t ? std::optional(*s * *t) : t;
}

}  // namespace

template <class N>
typename IntervalSpace<N>::Vector IntervalSpace<N>::direction(DirectionSource w) const {
  if (w.of == DirectionSource::Of::p) return p_[w.to] - p_[w.from];
  if (w.of == DirectionSource::Of::q) return q_[w.to] - q_[w.from];
  return {Number(w.from == 0), Number(w.from == 1), Number(w.from == 2)};
}

template <class N>
typename IntervalSpace<N>::Vector IntervalSpace<N>::along(const SumEdge& e) const {
  return e.from.q == e.to.q ? direction({DirectionSource::Of::p, e.from.p, e.to.p})
                            : direction({DirectionSource::Of::q, e.from.q, e.to.q});
}

template <class N>
typename IntervalSpace<N>::Vector IntervalSpace<N>::normal(const PlaneSource& source) const {
  return source.reversed ? cross(direction(source.v), direction(source.u))
                         : cross(direction(source.u), direction(source.v));
}

template <class N>
SumPoint IntervalSpace<N>::beside(const PointSource& point) const {
  if (point.kind == PointSource::Kind::sum) return {point.a, point.b};
  return point.kind == PointSource::Kind::edge ? edges_[point.a].from : planes_[point.a].at;
}

template <class N>
typename IntervalSpace<N>::Position IntervalSpace<N>::position(const PointSource& point, SumPoint origin) const {
  const Vector o = between(origin, beside(point));
  if (point.kind == PointSource::Kind::sum) return {o, Number(1)};
  if (point.kind == PointSource::Kind::edge) {
    const SumEdge& edge = edges_[point.a];
    const PlaneSource& plane = planes_[point.b];
    const Vector d = along(edge), n = normal(plane);
    const Number h = dot(n, between(plane.at, edge.from)), w = dot(n, d);
    return {{o.x * w - d.x * h, o.y * w - d.y * h, o.z * w - d.z * h}, w};
  }
  const PlaneSource &f = planes_[point.a], &g = planes_[point.b], &h = planes_[point.c];
  const Vector a = normal(f), b = normal(g), c = normal(h), ca = cross(c, a), ab = cross(a, b);
  const Number of_g = dot(b, between(f.at, g.at)), of_h = dot(c, between(f.at, h.at)), w = dot(b, ca);
  return {
      {o.x * w + of_g * ca.x + of_h * ab.x, o.y * w + of_g * ca.y + of_h * ab.y, o.z * w + of_g * ca.z + of_h * ab.z},
      w};
}

template <class N>
std::optional<int> IntervalSpace<N>::side(const PlaneSource& plane, SumPoint point) const {
  return sign_of(dot(normal(plane), between(plane.at, point)));
}

// Heights over the plane are taken before they are weighted: where planes are nearly one, both factors are small, and
// each is known to some digits.
template <class N>
std::optional<int> IntervalSpace<N>::side(const PlaneSource& plane, const PointSource& point) const {
  if (point.kind == PointSource::Kind::sum) return side(plane, SumPoint{point.a, point.b});
  if (point.kind == PointSource::Kind::position) return std::nullopt;
  const Vector n = normal(plane);
  const Number height = dot(n, between(plane.at, beside(point)));
  if (point.kind == PointSource::Kind::edge) {
    const SumEdge& edge = edges_[point.a];
    const PlaneSource& cut = planes_[point.b];
    const Vector d = along(edge), m = normal(cut);
    const Number w = dot(m, d);
    return sign_of_product(height * w - dot(n, d) * dot(m, between(cut.at, edge.from)), w);
  }
  const PlaneSource &f = planes_[point.a], &g = planes_[point.b], &h = planes_[point.c];
  const Vector a = normal(f), b = normal(g), c = normal(h), ca = cross(c, a), ab = cross(a, b);
  const Number w = dot(b, ca);
  return sign_of_product(
      height * w + dot(b, between(f.at, g.at)) * dot(n, ca) + dot(c, between(f.at, h.at)) * dot(n, ab), w);
}

template <class N>
std::optional<int> IntervalSpace<N>::twist(const SumEdge& a, const SumEdge& b) const {
  return sign_of(dot(cross(along(a), along(b)), between(a.from, b.from)));
}

template <class N>
std::optional<int> IntervalSpace<N>::det(PlaneId a, PlaneId b, PlaneId c) const {
  return sign_of(dot(normal(planes_[a]), cross(normal(planes_[b]), normal(planes_[c]))));
}

template <class N>
std::optional<int> IntervalSpace<N>::order(const PointSource& a, const PointSource& b, int axis) const {
  if (a.kind == PointSource::Kind::position || b.kind == PointSource::Kind::position) return std::nullopt;
  const SumPoint origin = beside(a);
  const Position x = position(a, origin), y = position(b, origin);
  const auto coordinate = [&](const Vector& v) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; };
  const std::optional<int> s = sign_of(coordinate(y.x) * x.w - coordinate(x.x) * y.w), t = sign_of_product(x.w, y.w);
  return s && t ? std::optional(*s * *t) : std::nullopt;
}

template class IntervalSpace<exact::FineInterval>;
template class IntervalSpace<exact::WideInterval>;

}  // namespace dymsum::spatial
