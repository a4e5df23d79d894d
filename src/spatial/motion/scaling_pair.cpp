#include "spatial/motion/scaling_pair.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "exact/int.h"

namespace dymsum::spatial {

using exact::BigInteger;

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

}  // namespace dymsum::spatial
