#include "spatial/convolution/fine_space.h"

namespace dymsum::spatial {

using exact::cross;
using exact::dot;

namespace {

/// Of a product of two.
std::optional<int> sign_of_product(const FineSpace::Number& a, const FineSpace::Number& b) {
  const std::optional<int> s = sign_of(a);
  if (!s) return s;
  const std::optional<int> t = sign_of(b);
  return t ? std::optional(*s * *t) : t;
}

}  // namespace

FineSpace::Vector FineSpace::direction(Way w) const {
  if (w.of == Way::Of::p) return p_[w.to] - p_[w.from];
  if (w.of == Way::Of::q) return q_[w.to] - q_[w.from];
  return {Number(w.from == 0), Number(w.from == 1), Number(w.from == 2)};
}

FineSpace::Vector FineSpace::along(const SumEdge& e) const {
  return e.from.q == e.to.q ? direction({Way::Of::p, e.from.p, e.to.p}) : direction({Way::Of::q, e.from.q, e.to.q});
}

FineSpace::Vector FineSpace::normal(const PlaneSource& source) const {
  return source.reversed ? cross(direction(source.v), direction(source.u))
                         : cross(direction(source.u), direction(source.v));
}

FineSpace::Position FineSpace::position(const PointSource& point) const {
  if (point.kind == PointSource::Kind::sum) return {sum({point.a, point.b}), Number(1)};
  if (point.kind == PointSource::Kind::edge) {
    const SumEdge& edge = edges_[point.a];
    const PlaneSource& plane = planes_[point.b];
    const Vector from = sum(edge.from), d = along(edge), n = normal(plane);
    const Number h = dot(n, from - sum(plane.at)), w = dot(n, d);
    return {{from.x * w - d.x * h, from.y * w - d.y * h, from.z * w - d.z * h}, w};
  }
  const PlaneSource* planes[3] = {&planes_[point.a], &planes_[point.b], &planes_[point.c]};
  Vector n[3];
  Number d[3];
  for (int k = 0; k < 3; ++k) n[k] = normal(*planes[k]), d[k] = dot(n[k], sum(planes[k]->at));
  const Vector bc = cross(n[1], n[2]), ca = cross(n[2], n[0]), ab = cross(n[0], n[1]);
  return {{d[0] * bc.x + d[1] * ca.x + d[2] * ab.x, d[0] * bc.y + d[1] * ca.y + d[2] * ab.y,
           d[0] * bc.z + d[1] * ca.z + d[2] * ab.z},
          dot(n[0], bc)};
}

std::optional<int> FineSpace::side(const PlaneSource& plane, SumPoint point) const {
  return sign_of(dot(normal(plane), sum(point) - sum(plane.at)));
}

std::optional<int> FineSpace::side(const PlaneSource& plane, const PointSource& point) const {
  if (point.kind == PointSource::Kind::sum) return side(plane, SumPoint{point.a, point.b});
  if (point.kind == PointSource::Kind::place) return std::nullopt;
  const Position at = position(point);
  const Vector o = sum(plane.at);
  const Vector gap{at.x.x - o.x * at.w, at.x.y - o.y * at.w, at.x.z - o.z * at.w};
  return sign_of_product(dot(normal(plane), gap), at.w);
}

std::optional<int> FineSpace::twist(const SumEdge& a, const SumEdge& b) const {
  return sign_of(dot(cross(along(a), along(b)), sum(b.from) - sum(a.from)));
}

std::optional<int> FineSpace::det(PlaneId a, PlaneId b, PlaneId c) const {
  return sign_of(dot(normal(planes_[a]), cross(normal(planes_[b]), normal(planes_[c]))));
}

std::optional<int> FineSpace::order(const PointSource& a, const PointSource& b, int axis) const {
  if (a.kind == PointSource::Kind::place || b.kind == PointSource::Kind::place) return std::nullopt;
  const Position x = position(a), y = position(b);
  const auto coordinate = [&](const Vector& v) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; };
  const std::optional<int> s = sign_of(coordinate(y.x) * x.w - coordinate(x.x) * y.w), t = sign_of_product(x.w, y.w);
  return s && t ? std::optional(*s * *t) : std::nullopt;
}

}  // namespace dymsum::spatial
