#include "check/cell_cuts.h"

#include <algorithm>
#include <cmath>

namespace dymsum::check {
namespace {

using exact::BigRational;

/// The two vertices of a cell that are furthest from each other, roughly.
std::pair<const SpacePoint*, const SpacePoint*> ends_of(const SolidCell& cell) {
  std::pair<const SpacePoint*, const SpacePoint*> ends{cell.vertices[0].get(), cell.vertices[1].get()};
  double longest = -1;
  for (std::size_t i = 0; i < cell.vertices.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (const double d = length(cell.vertices[i]->near - cell.vertices[j]->near); d > longest)
        longest = d, ends = {cell.vertices[i].get(), cell.vertices[j].get()};
  return ends;
}

/// The positions that are equally far from both: 2 (b - a) x = b b - a a. Nothing where they are equal.
std::optional<std::array<BigInteger, 4>> equally_far(const RationalVector& a, const RationalVector& b) {
  if (a == b) return std::nullopt;
  RationalVector n;
  BigRational d = 0;
  BigInteger unit = 1;
  for (int k = 0; k < 3; ++k) {
    n[k] = 2 * (b[k] - a[k]);
    d += a[k] * a[k] - b[k] * b[k];
    unit = lcm(unit, BigInteger(denominator(n[k])));
  }
  unit = lcm(unit, BigInteger(denominator(d)));
  const auto integer = [&](const BigRational& v) { return BigInteger(numerator(v) * (unit / denominator(v))); };
  return std::array<BigInteger, 4>{integer(n[0]), integer(n[1]), integer(n[2]), integer(d)};
}

BigInteger squared_normal(const Plane& p) {
  return p.exact[0] * p.exact[0] + p.exact[1] * p.exact[1] + p.exact[2] * p.exact[2];
}

/// The positions on the positive sides of both planes, times these signs, that are equally far: where the ratio of the
/// lengths of their normals is a fraction, as of planes that are parallel or at right angles.
std::optional<std::array<BigInteger, 4>> equally_far(const Plane& a, int side_a, const Plane& b, int side_b) {
  const BigInteger aa = squared_normal(a), product = aa * squared_normal(b);
  BigInteger rest;
  const BigInteger root = exact::floor_root(product, rest);
  if (rest != 0) return std::nullopt;
  std::array<BigInteger, 4> form;  // a / |a| - b / |b|, times |a|^2 |b|
  for (int k = 0; k < 4; ++k) form[k] = side_a * a.exact[k] * root - side_b * b.exact[k] * aa;
  if (form[0] == 0 && form[1] == 0 && form[2] == 0) return std::nullopt;
  return form;
}

}  // namespace

std::optional<HalvedSolidCell> CellCuts::cut(const SolidCell& cell, std::uint32_t triangle, const SpacePoint& worst,
                                             int depth) {
  constexpr int kPlain = 6;
  if (depth % kPlain == kPlain - 1) return half(cell);
  const std::uint32_t other = triangles_.rough_nearest(worst.near);
  if (other != triangle)
    if (auto halves = between(cell, triangle, other, worst)) return halves;
  if (auto halves = beside(cell, triangle, worst)) return halves;
  return half(cell);
}

std::optional<HalvedSolidCell> CellCuts::between(const SolidCell& cell, std::uint32_t t, std::uint32_t u,
                                                 const SpacePoint& worst) {
  const auto beyond = [&](const Vec3& z) { return triangles_.distance_above(z, u) < triangles_.distance_above(z, t); };
  const SpacePoint* from = nullptr;
  double most = -1;
  for (const SpacePointRef& v : cell.vertices)
    if (const double d = triangles_.distance_above(v->near, t); d > most && !beyond(v->near)) most = d, from = v.get();
  if (from == nullptr || !beyond(worst.near)) return std::nullopt;
  double low = 0, high = 1;  // of the way from there to the worst one
  const auto at = [&](double s) { return (1 - s) * from->near + s * worst.near; };
  constexpr int kHalvings = 40;
  for (int k = 0; k < kHalvings; ++k) (beyond(at((low + high) / 2)) ? high : low) = (low + high) / 2;
  const Vec3 z = at(high);
  if (triangles_.distance_above(z, t) < 16 * triangles_.slack()) return std::nullopt;  // rounding says which is nearer
  const NearOnTriangle of_t = triangles_.near(z, t), of_u = triangles_.near(z, u);
  if (const auto form = bisector(t, of_t.feature, u, of_u.feature, z))
    if (auto halves = halved(cell, planes_.add(*form), planes_)) return halves;
  const Vec3 a = z - of_t.at, b = z - of_u.at;
  const Vec3 normal = 1 / length(a) * a - 1 / length(b) * b;
  constexpr double kSame = 0x1p-20;  // both are near with the same position: they have a side in common
  return length(normal) > kSame ? near_plane(cell, z, normal) : std::nullopt;
}

std::optional<std::array<BigInteger, 4>> CellCuts::bisector(std::uint32_t t, int feature_of_t, std::uint32_t u,
                                                            int feature_of_u, const Vec3& at) {
  const ExactTriangle a = triangles_.exact(t), b = triangles_.exact(u);
  if (feature_of_t == NearOnTriangle::kFace && feature_of_u == NearOnTriangle::kFace) {
    const Plane &p = planes_[planes_.add(normal_of(a), a[0])], &q = planes_[planes_.add(normal_of(b), b[0])];
    const SpacePoint z(exactly(at));
    const int side_p = side_of(p, z), side_q = side_of(q, z);
    if (side_p == 0 || side_q == 0) return std::nullopt;
    return equally_far(p, side_p, q, side_q);
  }
  if (feature_of_t < 3 && feature_of_u < 3) return equally_far(a[feature_of_t], b[feature_of_u]);
  if (feature_of_t < 3 || feature_of_u < 3 || feature_of_t == NearOnTriangle::kFace ||
      feature_of_u == NearOnTriangle::kFace)
    return std::nullopt;
  // Parallel edges are as far as a position of one and the position of the other one beside it.
  const int i = feature_of_t - 3, k = feature_of_u - 3;
  const RationalVector e = minus_of(a[(i + 1) % 3], a[i]), f = minus_of(b[(k + 1) % 3], b[k]);
  if (cross_of(e, f) != RationalVector{0, 0, 0}) return std::nullopt;
  const BigRational along = dot_of(minus_of(a[i], b[k]), f) / dot_of(f, f);
  return equally_far(a[i], {b[k][0] + along * f[0], b[k][1] + along * f[1], b[k][2] + along * f[2]});
}

/// At the side of the triangle beyond which the worst vertex lies, at right angles to it.
std::optional<HalvedSolidCell> CellCuts::beside(const SolidCell& cell, std::uint32_t t, const SpacePoint& worst) {
  const ExactTriangle a = triangles_.exact(t);
  const RationalVector n = normal_of(a);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t wall = planes_.add(cross_of(n, minus_of(a[(k + 1) % 3], a[k])), a[k]);
    if (side_of(planes_[wall], worst) * side_of(planes_[wall], SpacePoint(a[(k + 2) % 3])) >= 0) continue;
    if (auto halves = halved(cell, wall, planes_)) return halves;
  }
  return std::nullopt;
}

/// Halfway between the two vertices that are furthest from each other; exactly, where what is rounded misses the cell.
std::optional<HalvedSolidCell> CellCuts::half(const SolidCell& cell) {
  const auto [from, to] = ends_of(cell);
  if (auto halves = near_plane(cell, 0.5 * (from->near + to->near), to->near - from->near)) return halves;
  const auto form = equally_far(from->rational(), to->rational());
  return form ? halved(cell, planes_.add(*form), planes_) : std::nullopt;
}

/// By a plane near a position, at right angles to a direction, both rounded, so that numbers do not grow.
std::optional<HalvedSolidCell> CellCuts::near_plane(const SolidCell& cell, const Vec3& at, const Vec3& normal) {
  const auto [from, to] = ends_of(cell);
  const double size = length(normal), unit = std::ldexp(1, std::ilogb(length(to->near - from->near)) - 20);
  if (!(size > 0) || !std::isfinite(size) || !(unit > 0)) return std::nullopt;
  const auto rounded = [](double v, double unit) {
    const double steps = v / unit;
    return std::abs(steps) < 0x1p52 ? std::nearbyint(steps) * unit : v;
  };
  constexpr double kSteps = 0x1p-24;
  const Vec3 n{rounded(normal.x / size, kSteps), rounded(normal.y / size, kSteps), rounded(normal.z / size, kSteps)};
  const Vec3 z{rounded(at.x, unit), rounded(at.y, unit), rounded(at.z, unit)};
  if (n.x == 0 && n.y == 0 && n.z == 0) return std::nullopt;
  return halved(cell, planes_.add(exactly(n), exactly(z)), planes_);
}

}  // namespace dymsum::check
