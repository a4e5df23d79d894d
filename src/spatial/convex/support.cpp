// The vertex that is extreme in a direction: the sum of those of the operands.
#include <cmath>
#include <stdexcept>

#include "exact/grid.h"
#include "spatial/convex/convex_state.h"
#include "spatial/convex/exact_places.h"
#include "spatial/mesh/rounded_vector.h"

namespace dymsum {
namespace {

using exact::Big;
using exact::BigInteger;
using exact::BigRational;
using spatial::HalfEdge;
using spatial::Polytope;
using spatial::Vec3;

/// Climbs in doubles, then exactly from there: doubles may stop short, but never for long.
std::uint32_t extreme_vertex(const Polytope& p, Vec3 direction, const exact::Vector3<Big>& exact_direction) {
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
  for (bool rises = true; rises;) {
    rises = false;
    for (const HalfEdge h : p.leaving(v)) {
      if (sign(exact::dot(exact_direction, p.edge_vector<Big>(h))) <= 0) continue;
      v = p.target(h);
      rises = true;
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
    // Turned back into the operand's own coordinates: m^T d.
    std::array<Big, 3> back;
    for (std::size_t c = 0; c < 3; ++c)
      back[c] = Big(pose.matrix[c]) * b[0] + Big(pose.matrix[3 + c]) * b[1] + Big(pose.matrix[6 + c]) * b[2];
    const exact::Vector3<Big> turned_back{back[0], back[1], back[2]};
    v[op] = extreme_vertex(s.poly(op), spatial::rounded(turned_back, -spatial::bit_length(turned_back)), turned_back);
  }
  Support result;
  result.vertex = {s.p->source_vertex[v[0]], s.q->source_vertex[v[1]]};
  const spatial::ExactPlaces places(*s.source, s.p_pose, s.q_pose);
  const spatial::BigVector x = places.of(0, result.vertex.p), y = places.of(1, result.vertex.q);
  const auto rounded = [&](std::size_t k) {
    return exact::round_to_double(BigRational(BigInteger(x[k] + y[k])) * places.unit());
  };
  result.at = {rounded(0), rounded(1), rounded(2)};
  return result;
}

}  // namespace dymsum
