// How deep a point lies in a sum: the least distance to the plane of a facet. Doubles leave few candidates, which are compared exactly.
#include <algorithm>
#include <cmath>
#include <limits>

#include "spatial/convex/assemble.h"
#include "spatial/convex/convex_state.h"
#include "spatial/convex/mixed_volume.h"

namespace dymsum {
namespace {

using exact::Big;
using exact::BigInteger;
using exact::BigRational;
using spatial::HalfEdge;
using spatial::Mat3;
using spatial::Overlay;
using spatial::Polytope;
using spatial::Vec3;

/// A facet of the generic sum: a face of an operand and its extreme vertex, or a crossing.
struct Facet {
  int op = 0;  // 0, 1: face of P, of Q; 2: crossing
  std::uint32_t id = 0;
};

/// Distances in doubles, with bounds of their errors.
class Distances {
 public:
  Distances(const ConvexSum::State& s, Point3 point)
      : o_(s.overlay), m_{spatial::pose_matrix(s.p_factors), spatial::pose_matrix(s.q_factors)}, x_{point.x, point.y, point.z} {
    for (int op = 0; op < 2; ++op) {
      cof_[op] = spatial::cofactors(m_[op]);
      spread_[op] = spatial::spectral_bound(cof_[op]);
      double most = 0;
      for (const Vec3& v : o_.poly(op).at) most = std::max(most, length(v));
      norm_[op] = spatial::spectral_bound(m_[op]);
      reach_ += most * norm_[op];
    }
    reach_ += length(x_);
  }

  /// The signed distance of the point below the plane and a bound of its error; infinity as the bound where doubles give no direction.
  std::pair<double, double> of(const Facet& facet) const {
    const auto [n, spread] = normal(facet);
    const double size = length(n);
    // The normal errs by a few roundings of `spread`, its direction by that over its length; places by a few roundings of reach_.
    const double error = 0x1p-44 * spread / size * reach_;
    if (!(error < reach_)) return {0, std::numeric_limits<double>::infinity()};
    return {dot((1 / size) * n, corner(facet) - x_), error};
  }
  Vec3 direction(const Facet& facet) const {
    const Vec3 n = normal(facet).first;
    return (1 / length(n)) * n;
  }

 private:
  std::pair<Vec3, double> normal(const Facet& facet) const {
    if (facet.op < 2) return {cof_[facet.op] * o_.poly(facet.op).normal[facet.id], spread_[facet.op]};
    const spatial::Crossing& c = o_.crossing(facet.id);
    const Vec3 a = m_[1] * o_.poly(1).along(c.q), b = m_[0] * o_.poly(0).along(2 * c.p);
    return {cross(a, b), norm_[0] * norm_[1]};
  }
  Vec3 corner(const Facet& facet) const {
    const auto [p, q] = spatial::corner_of(o_, facet.op, facet.id);
    return m_[0] * o_.poly(0).at[p] + m_[1] * o_.poly(1).at[q];
  }

  const Overlay& o_;
  std::array<Mat3, 2> m_, cof_;
  std::array<double, 2> norm_{}, spread_{};
  Vec3 x_;
  double reach_ = 0;
};

/// The exact square of a distance with the sign of the distance; nothing for crossings of parallel edges, which are no facets.
class ExactDistances {
 public:
  ExactDistances(const ConvexSum::State& s, Point3 point) : s_(s), places_(*s.source, s.p_pose, s.q_pose) {
    for (int op = 0; op < 2; ++op) {
      const spatial::ExactPose pose = spatial::ExactPose::of(op == 0 ? s.p_pose : s.q_pose);
      for (int r = 0; r < 3; ++r) m_[op][r] = {Big(pose.matrix[3 * r]), Big(pose.matrix[3 * r + 1]), Big(pose.matrix[3 * r + 2])};
    }
    x_ = {exact::exact_value(point.x), exact::exact_value(point.y), exact::exact_value(point.z)};
  }

  std::optional<BigRational> signed_square(const Facet& facet) const {
    const exact::Vector3<Big> n = normal(facet);
    const Big size = exact::dot(n, n);
    if (sign(size) == 0) return std::nullopt;
    const auto [p, q] = spatial::corner_of(s_.overlay, facet.op, facet.id);
    const spatial::BigVector a = places_.of(0, s_.p->source_vertex[p]), b = places_.of(1, s_.q->source_vertex[q]);
    BigRational d = 0;
    const std::array<const Big*, 3> c{&n.x, &n.y, &n.z};
    for (std::size_t k = 0; k < 3; ++k) d += BigRational(c[k]->value()) * (BigRational(BigInteger(a[k] + b[k])) * places_.unit() - x_[k]);
    const BigRational square = d * d / BigRational(size.value());
    return d < 0 ? BigRational(-square) : square;
  }

 private:
  exact::Vector3<Big> normal(const Facet& facet) const {
    if (facet.op < 2) {
      const exact::Matrix3<Big>& m = m_[facet.op];
      const exact::Matrix3<Big> cof{exact::cross(m[1], m[2]), exact::cross(m[2], m[0]), exact::cross(m[0], m[1])};
      return exact::apply(cof, s_.poly(facet.op).normal_vector<Big>(facet.id));
    }
    const spatial::Crossing& c = s_.overlay.crossing(facet.id);
    return exact::cross(exact::apply(m_[1], s_.q->edge_vector<Big>(c.q)), exact::apply(m_[0], s_.p->edge_vector<Big>(2 * c.p)));
  }

  const ConvexSum::State& s_;
  spatial::ExactPlaces places_;
  std::array<exact::Matrix3<Big>, 2> m_;
  std::array<BigRational, 3> x_;
};

template <class F>
void for_each_facet(const Overlay& o, F&& f) {
  for (int op = 0; op < 2; ++op)
    for (std::uint32_t i = 0; i < o.poly(op).face_count(); ++i) f(Facet{op, i});
  for (std::uint32_t e = 0; e < o.poly(0).edge_count(); ++e)
    for (std::uint32_t id = o.first_crossing(0, e); id != spatial::kNoCrossing; id = o.crossing(id).next[0]) f(Facet{2, id});
}

/// The facets that may be nearest.
std::vector<Facet> candidates(const ConvexSum::State& s, const Distances& distances) {
  std::vector<std::pair<double, Facet>> lower;
  double least_upper = std::numeric_limits<double>::infinity();
  for_each_facet(s.overlay, [&](const Facet& facet) {
    const auto [d, error] = distances.of(facet);
    if (d - error > least_upper) return;
    lower.push_back({d - error, facet});
    least_upper = std::min(least_upper, d + error);
  });
  std::vector<Facet> near;
  for (const auto& [d, facet] : lower)
    if (d <= least_upper) near.push_back(facet);
  return near;
}

}  // namespace

namespace spatial {

std::pair<std::uint32_t, std::uint32_t> corner_of(const Overlay& o, int op, std::uint32_t id) {
  if (op == 2) return {o.poly(0).origin[2 * o.crossing(id).p], o.poly(1).origin[o.crossing(id).q]};
  const std::uint32_t mine = o.poly(op).origin[o.poly(op).first[id]], other = o.extreme(op, id);
  return op == 0 ? std::pair{mine, other} : std::pair{other, mine};
}

}  // namespace spatial

ConvexDepth ConvexSum::depth(Point3 point) const {
  const Distances distances(*state_, point);
  const ExactDistances exact_distances(*state_, point);
  std::optional<BigRational> least;
  Facet nearest;
  for (const Facet& facet : candidates(*state_, distances)) {
    std::optional<BigRational> d = exact_distances.signed_square(facet);
    if (!d || (least && *least <= *d)) continue;
    least = std::move(d);
    nearest = facet;
  }
  ConvexDepth result;
  result.inside = *least > 0;
  if (result.inside) {
    result.depth_squared = exact::to_rational(*least);
    result.depth = std::sqrt(exact::round_to_double(*least));
  }
  const Vec3 n = distances.direction(nearest);
  result.direction = {n.x, n.y, n.z};
  const Overlay& o = state_->overlay;
  if (nearest.op == 2) {
    const spatial::Crossing& c = o.crossing(nearest.id);
    result.p = spatial::edge_feature(*state_->p, state_->p->origin[2 * c.p], state_->p->target(2 * c.p));
    result.q = spatial::edge_feature(*state_->q, state_->q->origin[c.q], state_->q->target(c.q));
  } else {
    const SolidFeature face = spatial::face_feature(state_->poly(nearest.op), nearest.id);
    const SolidFeature vertex = spatial::vertex_feature(state_->poly(1 - nearest.op), o.extreme(nearest.op, nearest.id));
    result.p = nearest.op == 0 ? face : vertex;
    result.q = nearest.op == 0 ? vertex : face;
  }
  return result;
}

Result<ConvexDepth> penetration_depth(const Mesh& p, const Mesh& q, const SolidPose& p_pose, const SolidPose& q_pose, Point3 q_moved_by) {
  Result<ConvexSum> sum = ConvexSum::create(p, negated(q));
  if (!sum) return sum.error();
  ConvexSum difference = std::move(sum).value();
  difference.set(p_pose, q_pose);
  return difference.depth(q_moved_by);
}

}  // namespace dymsum
