// The vertex that is extreme in a direction: the sum of those of the operands. Ties are decided by position, as then
// both are of one vertex of the sum: sums of extreme vertices may lie inside its edges and facets.
#include <cmath>
#include <stdexcept>

#include "exact/grid.h"
#include "spatial/convex/convex_state.h"
#include "spatial/convex/exact_positions.h"
#include "spatial/mesh/rounded_vector.h"

namespace dymsum {
namespace {

using exact::Big;
using exact::BigInteger;
using exact::BigRational;
using spatial::HalfEdge;
using spatial::Polytope;
using spatial::Vec3;

/// A direction, then those that decide ties.
using Directions = std::array<exact::Vector3<Big>, 4>;

bool rises(const Directions& directions, const exact::Vector3<Big>& along) {
  for (const exact::Vector3<Big>& d : directions)
    if (const int s = sign(exact::dot(d, along)); s != 0) return s > 0;
  return false;
}

/// Climbs in doubles, then exactly from there: doubles may stop short, but never for long.
std::uint32_t extreme_vertex(const Polytope& p, Vec3 direction, const Directions& directions) {
  std::uint32_t v = 0;
  for (std::size_t steps = 0; steps < p.vertex_count(); ++steps) {
    double most = 0;
    std::uint32_t best = v;
    for (const HalfEdge h : p.leaving(v)) {
      const double rise = dot(direction, p.along(h));
      if (rise <= most) continue;
      most = rise;
      best = p.target(h);
    }
    if (best == v) break;
    v = best;
  }
  for (bool climbs = true; climbs;) {
    climbs = false;
    for (const HalfEdge h : p.leaving(v)) {
      if (!rises(directions, p.edge_vector<Big>(h))) continue;
      v = p.target(h);
      climbs = true;
      break;
    }
  }
  return v;
}

}  // namespace

ConvexSum::Support ConvexSum::support(Point3 direction) const {
  const State& s = *state_;
  const std::array<double, 3> d{direction.x, direction.y, direction.z};
  for (const double c : d)
    if (!std::isfinite(c)) throw std::invalid_argument("ConvexSum::support: the direction is not finite");
  const int exponent = exact::common_exponent(d);
  std::array<Big, 3> b;
  for (std::size_t k = 0; k < 3; ++k) b[k] = exact::grid_coordinate<Big>(d[k], exponent);
  std::array<std::uint32_t, 2> v{};
  for (int op = 0; op < 2; ++op) {
    const spatial::ExactPose pose = spatial::ExactPose::of(op == 0 ? s.p_pose : s.q_pose);
    // Turned back into the operand's own coordinates: m^T d. The vertex of the sum that comes last in the order by the
    // direction, x, y and z is the sum of those of the operands.
    std::array<Big, 3> back;
    for (std::size_t c = 0; c < 3; ++c)
      back[c] = Big(pose.matrix[c]) * b[0] + Big(pose.matrix[3 + c]) * b[1] + Big(pose.matrix[6 + c]) * b[2];
    const auto row = [&](std::size_t k) {
      return exact::Vector3<Big>{Big(pose.matrix[k]), Big(pose.matrix[k + 1]), Big(pose.matrix[k + 2])};
    };
    const Directions directions{exact::Vector3<Big>{back[0], back[1], back[2]}, row(0), row(3), row(6)};
    v[op] =
        extreme_vertex(s.poly(op), spatial::rounded(directions[0], -spatial::bit_length(directions[0])), directions);
  }
  Support result;
  result.vertex = {s.p->source_vertex[v[0]], s.q->source_vertex[v[1]]};
  const spatial::ExactPositions positions(*s.source, s.p_pose, s.q_pose);
  const spatial::BigVector x = positions.of(0, result.vertex.p), y = positions.of(1, result.vertex.q);
  const auto rounded = [&](std::size_t k) {
    return exact::round_to_double(BigRational(BigInteger(x[k] + y[k])) * positions.unit());
  };
  result.at = {rounded(0), rounded(1), rounded(2)};
  return result;
}

}  // namespace dymsum
