#include "spatial/motion/posed_pair.h"

#include <algorithm>
#include <utility>

#include "exact/grid.h"

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

}  // namespace dymsum::spatial
