#include "spatial/motion/posed_pair.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "exact/grid.h"
#include "exact/int.h"

namespace dymsum::spatial {

using exact::BigInteger;

SolidPair solid_pair(const Mesh& p, const Mesh& q) {
  SolidPair pair{solid_operand(p.data(), p.thin_faces()), solid_operand(q.data(), q.thin_faces()), {}, {}};
  std::vector<Point3> all = pair.p.vertices;
  all.insert(all.end(), pair.q.vertices.begin(), pair.q.vertices.end());
  const GridPositions positions = grid_positions(all);
  const auto fraction = [&](std::size_t first, std::size_t last) {
    GridPositions some;
    some.bits = positions.bits, some.exponent = positions.exponent;
    const auto cut = [&](const auto& from, auto& to) {
      if (!from.empty())
        to.assign(from.begin() + static_cast<std::ptrdiff_t>(first), from.begin() + static_cast<std::ptrdiff_t>(last));
    };
    cut(positions.grid, some.grid), cut(positions.big, some.big);
    return some;
  };
  pair.p_positions = fraction(0, pair.p.vertices.size());
  pair.q_positions = fraction(pair.p.vertices.size(), all.size());
  return pair;
}

namespace {

using exact::Big;
using exact::Vector3;

Vector3<Big> mapped(const ExactPose& pose, const Vector3<Big>& v) {
  const auto row = [&](std::size_t r) {
    return Big(pose.matrix[3 * r]) * v.x + Big(pose.matrix[3 * r + 1]) * v.y + Big(pose.matrix[3 * r + 2]) * v.z;
  };
  return {row(0), row(1), row(2)};
}

/// Vertex 0 of P moved along the axis. `unit` is the exponent of the space's own unit, of which a level times `scale`
/// is a multiple.
Vector3<Big> position_at(const AxisLevel& level, const BigInteger& scale, int unit, const Vector3<Big>& p,
                         const Vector3<Big>& q) {
  const exact::Dyadic d = exact::to_dyadic(level.at);
  const unsigned shift = d.mantissa == 0 ? 0 : static_cast<unsigned>(d.exponent - unit);
  const Big at(BigInteger((BigInteger(d.mantissa) << shift) * scale));
  Vector3<Big> position = p;
  (level.axis == 0   ? position.x
   : level.axis == 1 ? position.y
                     : position.z) = at - (level.axis == 0   ? q.x
                                           : level.axis == 1 ? q.y
                                                             : q.z);
  return position;
}

}  // namespace

PosedSpace posed_space(const SolidPair& pair, const PosePair& poses, std::span<const AxisLevel> levels) {
  return posed_space(pair, ExactPose::of(poses.p), ExactPose::of(poses.q), levels);
}

PosedSpace posed_space(const SolidPair& pair, ExactPose p, ExactPose q, std::span<const AxisLevel> levels) {
  const BigInteger common = gcd(p.den, q.den), of_p = q.den / common, of_q = p.den / common, scale = p.den * of_p;
  int unit = pair.p_positions.exponent;
  for (const AxisLevel& level : levels)
    if (level.at != 0) unit = std::min(unit, exact::to_dyadic(level.at).exponent);
  const BigInteger finer = BigInteger(1) << static_cast<unsigned>(pair.p_positions.exponent - unit);
  for (BigInteger& m : p.matrix) m *= of_p * finer;
  for (BigInteger& m : q.matrix) m *= of_q * finer;
  MappedPositions of_first{pair.p_positions, p.matrix};
  if (!levels.empty()) {
    const Vector3<Big> a = mapped(p, pair.p_positions.position<Big>(0)),
                       b = mapped(q, pair.q_positions.position<Big>(0));
    for (const AxisLevel& level : levels) of_first.further.push_back(position_at(level, scale, unit, a, b));
  }
  return {make_sum_space(of_first, {pair.q_positions, q.matrix}, unit), scale};
}

namespace {

double nearest(const BigInteger& v) { return exact::to_double(exact::Big(v)); }

}  // namespace

BigVector minus(const BigVector& a, const BigVector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
BigVector cross(const BigVector& a, const BigVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
BigInteger dot(const BigVector& a, const BigVector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
bool is_zero(const BigVector& v) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

PlaneRow row_of(const MovingPlane& plane) {
  std::size_t bits = 0;
  for (const BigInteger& n : plane.n)
    if (n != 0) bits = std::max<std::size_t>(bits, msb(abs(n)));
  const auto scaled = [&](const BigInteger& v) { return std::ldexp(nearest(v), -static_cast<int>(bits)); };
  return {scaled(plane.n[0]), scaled(plane.n[1]), scaled(plane.n[2]), -scaled(plane.d1), scaled(plane.d0)};
}

ScalingPair::ScalingPair(SolidPair pair, int moving) : pair_(std::move(pair)), moving_(moving) {
  for (int op = 0; op < 2; ++op) {
    const GridPositions& from = op == 0 ? pair_.p_positions : pair_.q_positions;
    for (std::uint32_t v = 0; v < operand(op).vertices.size(); ++v) {
      const auto at = from.position<exact::Big>(v);
      exact_[op].push_back({at.x.value(), at.y.value(), at.z.value()});
      const BigVector& x = exact_[op].back();
      positions_[op].push_back({nearest(x[0]), nearest(x[1]), nearest(x[2])});
      for (const BigInteger& c : x) reach_[op] = std::max(reach_[op], std::abs(nearest(c)) * (1 + 0x1p-50));
    }
  }
}

BigVector ScalingPair::along(const DirectionSource& direction) const {
  const std::vector<BigVector>& of = exact_[direction.of == DirectionSource::Of::p ? 0 : 1];
  return minus(of[direction.to], of[direction.from]);
}

MovingPlane ScalingPair::plane(const PlaneSource& source) const {
  const BigVector u = along(source.u), v = along(source.v);
  MovingPlane plane;
  plane.n = source.reversed ? cross(v, u) : cross(u, v);
  plane.d0 = dot(plane.n, exact_fixed(source.at)), plane.d1 = dot(plane.n, exact_moved(source.at));
  return plane;
}

PosePair ScalingPair::poses(const Scale& s) const {
  PosePair poses;
  (moving_ == 0 ? poses.p : poses.q).scale = {s, s, s};
  return poses;
}

namespace {

/// conj(a) b. The products' terms are each rounded by 2^-53 of at most |a| |b|.
UnitQuaternion quotient(double aw, Vec3 a, double bw, Vec3 b) {
  return {aw * bw + dot(a, b), aw * b - bw * a - cross(a, b)};
}

}  // namespace

Vec3 scale_factors(const SolidPose& pose) {
  return {pose.scale[0].approx(), pose.scale[1].approx(), pose.scale[2].approx()};
}

double angle_of_scaling(const Vec3& from, const Vec3& to) {
  const double r[3] = {to.x / from.x, to.y / from.y, to.z / from.z};
  const auto [low, high] = std::minmax_element(r, r + 3);
  if (*low == *high) return 0;
  // A diagonal map of ratio k between its largest and its smallest factor turns by asin((k - 1) / (k + 1)) at most, and
  // so does its inverse, by which normals go.
  return std::asin(std::min(1.0, (*high - *low) / (*high + *low) + 0x1p-48)) + 0x1p-48;
}

UnitQuaternion relative_rotation(const Rotation& p, const Rotation& q) {
  const auto& a = p.quaternion();
  const auto& b = q.quaternion();
  const auto number = [](std::int64_t c) { return static_cast<double>(c); };
  const UnitQuaternion r = quotient(number(a[0]), {number(a[1]), number(a[2]), number(a[3])}, number(b[0]),
                                    {number(b[1]), number(b[2]), number(b[3])});
  const double size = std::sqrt(r.w * r.w + dot(r.v, r.v));
  return {r.w / size, (1 / size) * r.v};
}

Mat3 matrix_of(const UnitQuaternion& q) {
  const double w = q.w, x = q.v.x, y = q.v.y, z = q.v.z;
  return {Vec3{w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
          Vec3{2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
          Vec3{2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}};
}

double angle_between(const UnitQuaternion& a, const UnitQuaternion& b) {
  const UnitQuaternion d = quotient(a.w, a.v, b.w, b.v);
  return std::min(std::numbers::pi, 2 * std::atan2(length(d.v), std::abs(d.w))) + 0x1p-44;
}

}  // namespace dymsum::spatial
