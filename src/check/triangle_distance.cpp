#include "check/triangle_distance.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/doubles.h"

namespace dymsum::check {
namespace {

using exact::BigRational;

RationalVector along(const RationalVector& a, const RationalVector& d, const BigRational& t) {
  return {a[0] + t * d[0], a[1] + t * d[1], a[2] + t * d[2]};
}

TriangleNearest nearest_of(const RationalVector& p, const RationalVector& at) {
  const RationalVector d = minus_of(p, at);
  return {dot_of(d, d), at};
}

TriangleNearest nearest_on_segment(const RationalVector& p, const RationalVector& a, const RationalVector& b) {
  const RationalVector d = minus_of(b, a);
  const BigRational t = dot_of(minus_of(p, a), d), length = dot_of(d, d);
  if (t <= 0) return nearest_of(p, a);
  if (t >= length) return nearest_of(p, b);
  return nearest_of(p, along(a, d, BigRational(t / length)));
}

/// Of a segment, relative to p, in units in which squares are no trouble.
double rough_segment(const Point3& a, const Point3& b) {
  const double dx = b.x - a.x, dy = b.y - a.y, dz = b.z - a.z, n = dx * dx + dy * dy + dz * dz;
  const double t = n > 0 ? std::clamp(-(a.x * dx + a.y * dy + a.z * dz) / n, 0.0, 1.0) : 0;
  return base::hypot3(a.x + t * dx, a.y + t * dy, a.z + t * dz);
}

}  // namespace

RationalVector minus_of(const RationalVector& a, const RationalVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
exact::BigRational dot_of(const RationalVector& a, const RationalVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
RationalVector cross_of(const RationalVector& a, const RationalVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
RationalVector normal_of(const ExactTriangle& t) { return cross_of(minus_of(t[1], t[0]), minus_of(t[2], t[0])); }

TriangleNearest nearest_on(const RationalVector& p, const ExactTriangle& t) {
  const RationalVector n = normal_of(t);
  bool above = true;
  for (std::size_t k = 0; k < 3 && above; ++k)
    above = dot_of(cross_of(minus_of(t[(k + 1) % 3], t[k]), minus_of(p, t[k])), n) >= 0;
  if (above) return nearest_of(p, along(p, n, BigRational(-dot_of(minus_of(p, t[0]), n) / dot_of(n, n))));
  std::optional<TriangleNearest> best;
  for (std::size_t k = 0; k < 3; ++k) {
    TriangleNearest next = nearest_on_segment(p, t[k], t[(k + 1) % 3]);
    if (!best || next.squared < best->squared) best = std::move(next);
  }
  return *std::move(best);
}

std::optional<SegmentsNearest> nearest_inside(const RationalVector& a0, const RationalVector& a1,
                                              const RationalVector& b0, const RationalVector& b1) {
  const RationalVector u = minus_of(a1, a0), v = minus_of(b1, b0), w = minus_of(b0, a0);
  const BigRational uu = dot_of(u, u), uv = dot_of(u, v), vv = dot_of(v, v), uw = dot_of(u, w), vw = dot_of(v, w);
  const BigRational area = uu * vv - uv * uv;
  if (area == 0) return std::nullopt;
  // s along a and t along b: the connection is at right angles to both.
  const BigRational s = (uw * vv - uv * vw) / area, t = (uv * uw - uu * vw) / area;
  if (s <= 0 || s >= 1 || t <= 0 || t >= 1) return std::nullopt;
  SegmentsNearest nearest{0, along(a0, u, s), along(b0, v, t)};
  const RationalVector d = minus_of(nearest.of_b, nearest.of_a);
  nearest.squared = dot_of(d, d);
  return nearest;
}

double rough_distance(const Point3& p, const std::array<Point3, 3>& t) {
  const auto minus = [](const Point3& a, const Point3& b) { return Point3{a.x - b.x, a.y - b.y, a.z - b.z}; };
  const auto cross = [](const Point3& a, const Point3& b) {
    return Point3{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  };
  const auto dot = [](const Point3& a, const Point3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; };
  const auto largest = [](const Point3& a) { return std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)}); };
  const auto over = [](const Point3& a, double by) { return Point3{a.x / by, a.y / by, a.z / by}; };
  std::array<Point3, 3> from, edge;  // from p; both in units in which squares are no trouble
  double far = 0, size = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    from[k] = minus(t[k], p);
    edge[k] = minus(t[(k + 1) % 3], t[k]);
    far = std::max(far, largest(from[k]));
    size = std::max(size, largest(edge[k]));
  }
  if (!(far > 0)) return far;
  for (Point3& v : from) v = over(v, far);
  if (size > 0) {
    for (Point3& v : edge) v = over(v, size);
    const Point3 n = cross(edge[0], edge[1]);
    bool above = dot(n, n) > 0x1p-40;
    for (std::size_t k = 0; k < 3 && above; ++k) above = dot(cross(edge[k], from[k]), n) <= 0;
    if (above) return far * std::abs(dot(from[0], n)) / std::sqrt(dot(n, n));
  }
  return far *
         std::min({rough_segment(from[0], from[1]), rough_segment(from[1], from[2]), rough_segment(from[2], from[0])});
}

}  // namespace dymsum::check
