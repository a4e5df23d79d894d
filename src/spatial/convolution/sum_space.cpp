#include "spatial/convolution/sum_space.h"

#include <algorithm>

namespace dymsum::spatial {

namespace {

// One product and one sum of doubles round by at most 2^-53 of the result each; 16 times that covers every expression
// below.
constexpr double kRounding = 0x1p-49;

struct Value {
  double v = 0, error = 0;
};

/// The height of a point over a plane and its bound.
Value height(const Plane& plane, Vec3 at, double radius) {
  return {dot(plane.n, at) - plane.d, plane.slack + plane.norm1 * radius};
}

int sign_of(Value h) { return h.v > h.error ? 1 : h.v < -h.error ? -1 : 0; }

}  // namespace

EdgeId SumSpace::add_edges(std::span<const SumEdge> edges) {
  const auto first = static_cast<EdgeId>(edges_.size());
  edges_.insert(edges_.end(), edges.begin(), edges.end());
  return first;
}

bool SumSpace::made_from(PlaneId plane, SumPoint point) const {
  const PlaneSource& source = plane_sources_[plane];
  // From `at` along u, along v, or along both, where these are of different operands.
  SumPoint at = source.at;
  for (const DirectionSource* direction : {&source.u, &source.v}) {
    if (direction->of == DirectionSource::Of::p && point.p == direction->to && at.p == direction->from)
      at.p = direction->to;
    if (direction->of == DirectionSource::Of::q && point.q == direction->to && at.q == direction->from)
      at.q = direction->to;
  }
  return at == point;
}

int SumSpace::side(PlaneId plane, SumPoint point) const {
  const int s = sign_of(height(planes_[plane], approx(point), sum_radius_));
  return s != 0 || made_from(plane, point) ? s : exact_side(plane, point);
}

int SumSpace::side(PlaneId plane, const PointSource& point, const Approx& at) const {
  const int s = sign_of(height(planes_[plane], at.at, at.radius));
  if (s != 0) return s;
  if (point.kind == PointSource::Kind::planes && (point.a == plane || point.b == plane || point.c == plane)) return 0;
  if (point.kind == PointSource::Kind::edge && (point.b == plane || made_from(plane, EdgeId{point.a}))) return 0;
  if (point.kind == PointSource::Kind::sum && made_from(plane, SumPoint{point.a, point.b})) return 0;
  return exact_side(plane, point);
}

int SumSpace::det(PlaneId a, PlaneId b, PlaneId c) const {
  const Vec3 &n = planes_[a].n, &m = planes_[b].n, &k = planes_[c].n;
  // Components are at most 1 and relatively within 2^-51 of the exact ones: six products of three, rounded along the
  // way.
  const double v = dot(cross(n, m), k);
  if (v > 0x1p-45) return 1;
  if (v < -0x1p-45) return -1;
  return exact_det(a, b, c);
}

Vec3 SumSpace::approx(DirectionSource w) const {
  if (w.of == DirectionSource::Of::p) return p_[w.to] - p_[w.from];
  if (w.of == DirectionSource::Of::q) return q_[w.to] - q_[w.from];
  return {w.from == 0 ? 1.0 : 0.0, w.from == 1 ? 1.0 : 0.0, w.from == 2 ? 1.0 : 0.0};
}

int SumSpace::det(DirectionSource u, DirectionSource v, DirectionSource w) const {
  const Vec3 a = approx(u), b = approx(v), c = approx(w);
  const auto size = [&](Vec3 d) { return std::abs(d.x) + std::abs(d.y) + std::abs(d.z) + 4 * sum_radius_; };
  const double A = size(a), B = size(b), C = size(c), value = dot(cross(a, b), c);
  if (computed_exactly(A, B, C)) return value > 0 ? 1 : value < 0 ? -1 : 0;
  const double error = A * B * C * 0x1p-48 + 8 * sum_radius_ * (A * B + B * C + C * A);
  return value > error ? 1 : value < -error ? -1 : exact_det(u, v, w);
}

Approx SumSpace::approximate(const PointSource& point) const {
  if (point.kind == PointSource::Kind::sum) return {approx(SumPoint{point.a, point.b}), sum_radius_};
  if (point.kind == PointSource::Kind::position) return exact_approximation(point);
  const double limit = span_ * 0x1p-30;
  if (point.kind == PointSource::Kind::edge) {
    const SumEdge& edge = edges_[point.a];
    const Plane& plane = planes_[point.b];
    const Vec3 from = approx(edge.from), to = approx(edge.to);
    const Value a = height(plane, from, sum_radius_), b = height(plane, to, sum_radius_);
    // The point is from + t (to - from), t = a / (a - b) in [0, 1] wherever an edge is cut.
    const double gap = a.v - b.v, gap_error = a.error + b.error + std::abs(gap) * kRounding;
    if (std::abs(gap) > 8 * gap_error) {
      const double t = a.v / gap;
      const double t_error =
          (a.error + std::abs(t) * gap_error) / (std::abs(gap) - gap_error) + std::abs(t) * kRounding;
      const Vec3 d = to - from;
      const double reach = std::abs(d.x) + std::abs(d.y) + std::abs(d.z) + 4 * sum_radius_;
      const double radius = sum_radius_ + reach * t_error + (1 + std::abs(t)) * (span_ * kRounding + 4 * sum_radius_);
      if (radius < limit) return {from + t * d, radius};
    }
    return exact_approximation(point);
  }
  const Plane &a = planes_[point.a], &b = planes_[point.b], &c = planes_[point.c];
  const Vec3 bc = cross(b.n, c.n), ca = cross(c.n, a.n), ab = cross(a.n, b.n);
  const double w = dot(a.n, bc);
  constexpr double w_error = 0x1p-45;
  if (std::abs(w) > 8 * w_error) {
    // Cramer's rule: components of the products are at most 2, each off by 2^-47; offsets are off by less than 2^-49 of
    // the span times the sizes of the normal's components.
    const Vec3 x = a.d * bc + b.d * ca + c.d * ab;
    const double x_error =
        (std::abs(a.d) + std::abs(b.d) + std::abs(c.d)) * 0x1p-45 + (a.norm1 + b.norm1 + c.norm1) * span_ * 0x1p-48;
    const Vec3 at = (1 / w) * x;
    const double size = std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)});
    const double radius = (x_error + size * w_error) / (std::abs(w) - w_error) + size * kRounding;
    if (radius < limit) return {at, radius};
  }
  return exact_approximation(point);
}

exact::BigRational SumSpace::world_coordinate(const PointSource& point, int axis) const {
  const Line& line = lines_[axis];
  exact::BigRational v = exact_coordinate(point, axis);
  const exact::BigInteger power = exact::BigInteger(1) << std::abs(line.exponent);
  if (line.exponent >= 0) v *= power;
  else v /= power;
  return v + exact::exact_value(line.p_offset) + exact::exact_value(line.q_offset);
}

}  // namespace dymsum::spatial
