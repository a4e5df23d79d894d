// How deep a point lies in a sum: the least distance to the plane of a facet. Doubles leave few candidates, which are
// compared exactly.
#include <algorithm>
#include <cmath>
#include <limits>

#include "exact/grid.h"
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
      : o_(s.overlay), m_{spatial::pose_matrix(s.p_factors), spatial::pose_matrix(s.q_factors)} {
    const Vec3 x{point.x, point.y, point.z};
    for (int op = 0; op < 2; ++op) {
      cof_[op] = spatial::cofactors(m_[op]);
      spread_[op] = spatial::spectral_bound(cof_[op]);
      const double norm = spatial::spectral_bound(m_[op]);
      spread_[2] *= norm;
      double most = 0;
      place_[op].reserve(o_.poly(op).at.size());
      for (const Vec3& v : o_.poly(op).at) {
        most = std::max({most, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
        place_[op].push_back(op == 0 ? m_[op] * v - x : m_[op] * v);
      }
      reach_ += 2 * most * norm;
    }
    reach_ += length(x);
  }

  /// The facets that may be nearest.
  std::vector<Facet> candidates() {
    for (int op = 0; op < 2; ++op)
      for (std::uint32_t f = 0; f < o_.poly(op).face_count(); ++f)
        consider({op, f}, cof_[op] * o_.poly(op).normal[f], corner({op, f}));
    const Polytope &p = o_.poly(0), &q = o_.poly(1);
    for (std::uint32_t e = 0; e < p.edge_count(); ++e) {
      if (o_.first_crossing(0, e) == spatial::kNoCrossing) continue;
      const Vec3 along = m_[0] * p.direction[e], from = place_[0][p.origin[2 * e]];
      for (std::uint32_t id = o_.first_crossing(0, e); id != spatial::kNoCrossing; id = o_.crossing(id).next[0]) {
        const HalfEdge h = o_.crossing(id).q;
        consider({2, id}, cross(m_[1] * q.along(h), along), from + place_[1][q.origin[h]]);
      }
    }
    std::vector<Facet> near;
    for (const auto& [lower, facet] : lower_)
      if (lower <= least_upper_) near.push_back(facet);
    return near;
  }

  Vec3 direction(const Facet& facet) const {
    Vec3 n;
    if (facet.op < 2) {
      n = cof_[facet.op] * o_.poly(facet.op).normal[facet.id];
    } else {
      const spatial::Crossing& c = o_.crossing(facet.id);
      n = cross(m_[1] * o_.poly(1).along(c.q), m_[0] * o_.poly(0).direction[c.p]);
    }
    return (1 / length(n)) * n;
  }

 private:
  /// The facet with outward normal n through a corner, seen from the point. The normal errs by a few roundings of its
  /// spread, its direction by that over its length; places by a few roundings of reach_.
  void consider(const Facet& facet, Vec3 n, Vec3 corner) {
    const double product = dot(n, corner), error = 0x1p-44 * spread_[facet.op] * reach_, square = dot(n, n);
    // Nearly all are further away, which no root is needed for. Where squares are too small to tell, roots do.
    const double least = product - error, least_square = least * least;
    if (least > 0 && least_square > far_ * square && least_square > 0x1p-900) return;
    const double size = std::sqrt(square);
    double lower = -std::numeric_limits<double>::infinity();  // doubles may give no direction
    if (error < reach_ * size) {
      lower = least / size;
      least_upper_ = std::min(least_upper_, (product + error) / size);
      far_ = least_upper_ * least_upper_ * (1 + 0x1p-40);
    }
    if (lower <= least_upper_) lower_.push_back({lower, facet});
  }
  Vec3 corner(const Facet& facet) const {
    const auto [p, q] = spatial::corner_of(o_, facet.op, facet.id);
    return place_[0][p] + place_[1][q];
  }

  const Overlay& o_;
  std::array<Mat3, 2> m_, cof_;
  std::array<double, 3> spread_{0, 0, 1};   // bounds of the lengths of normals, by kind of facet
  std::array<std::vector<Vec3>, 2> place_;  // of every vertex; P's less the point
  double reach_ = 0;                        // a bound of the lengths of places, and of their sum
  // Of the facets so far: an upper bound of the least distance, a little more than its square, and lower bounds of the
  // distances of those that may have it.
  double least_upper_ = std::numeric_limits<double>::infinity(), far_ = least_upper_;
  std::vector<std::pair<double, Facet>> lower_;
};

/// The square of a distance, up to a factor that all share, with the sign of the distance: num / size.
struct SignedSquare {
  Big num, size;
  bool operator<(const SignedSquare& other) const { return (num * other.size).value() < (other.num * size).value(); }
};

/// Exact distances. Everything in integers: places as multiples of 2^exponent_ / den_.
class ExactDistances {
 public:
  ExactDistances(const ConvexSum::State& s, Point3 point) : s_(s) {
    const std::array<spatial::ExactPose, 2> pose{spatial::ExactPose::of(s.p_pose), spatial::ExactPose::of(s.q_pose)};
    const std::array<exact::Dyadic, 3> x{exact::to_dyadic(point.x), exact::to_dyadic(point.y),
                                         exact::to_dyadic(point.z)};
    exponent_ = std::min(s.p->exponent, s.q->exponent);
    for (const exact::Dyadic& c : x)
      if (c.mantissa != 0) exponent_ = std::min(exponent_, c.exponent);
    den_ = pose[0].den * pose[1].den;
    for (int op = 0; op < 2; ++op) {
      for (int r = 0; r < 3; ++r)
        m_[op][r] = {Big(pose[op].matrix[3 * r]), Big(pose[op].matrix[3 * r + 1]), Big(pose[op].matrix[3 * r + 2])};
      unit_[op] = Big(BigInteger(pose[1 - op].den << static_cast<unsigned>(s.poly(op).exponent - exponent_)));
    }
    const auto on = [&](const exact::Dyadic& c) {
      if (c.mantissa == 0) return Big::from_int64(0);
      return Big(BigInteger((den_ * c.mantissa) << static_cast<unsigned>(c.exponent - exponent_)));
    };
    x_ = {on(x[0]), on(x[1]), on(x[2])};
  }

  /// Nothing for crossings of parallel edges, which are no facets.
  std::optional<SignedSquare> signed_square(const Facet& facet) const {
    const exact::Vector3<Big> n = normal(facet);
    const Big size = exact::dot(n, n);
    if (sign(size) == 0) return std::nullopt;
    const auto [p, q] = spatial::corner_of(s_.overlay, facet.op, facet.id);
    const Big d = unit_[0] * exact::dot(n, exact::apply(m_[0], s_.p->place<Big>(p))) +
                  unit_[1] * exact::dot(n, exact::apply(m_[1], s_.q->place<Big>(q))) - exact::dot(n, x_);
    return SignedSquare{sign(d) < 0 ? Big::from_int64(0) - d * d : d * d, size};
  }
  /// The number itself.
  BigRational value(const SignedSquare& s) const {
    const auto twice = static_cast<unsigned>(2 * std::abs(exponent_));
    const BigInteger den = s.size.value() * den_ * den_;
    return exponent_ < 0 ? BigRational(s.num.value(), BigInteger(den << twice))
                         : BigRational(BigInteger(s.num.value() << twice), den);
  }

 private:
  exact::Vector3<Big> normal(const Facet& facet) const {
    if (facet.op < 2) {
      const exact::Matrix3<Big>& m = m_[facet.op];
      const exact::Matrix3<Big> cof{exact::cross(m[1], m[2]), exact::cross(m[2], m[0]), exact::cross(m[0], m[1])};
      return exact::apply(cof, s_.poly(facet.op).normal_vector<Big>(facet.id));
    }
    const spatial::Crossing& c = s_.overlay.crossing(facet.id);
    return exact::cross(exact::apply(m_[1], s_.q->edge_vector<Big>(c.q)),
                        exact::apply(m_[0], s_.p->edge_vector<Big>(2 * c.p)));
  }

  const ConvexSum::State& s_;
  std::array<exact::Matrix3<Big>, 2> m_;  // of the poses, over their own denominators
  std::array<Big, 2> unit_;               // what vertices of an operand are multiplied with
  exact::Vector3<Big> x_;
  BigInteger den_;
  int exponent_ = 0;
};

}  // namespace

namespace spatial {

std::pair<std::uint32_t, std::uint32_t> corner_of(const Overlay& o, int op, std::uint32_t id) {
  if (op == 2) return {o.poly(0).origin[2 * o.crossing(id).p], o.poly(1).origin[o.crossing(id).q]};
  const std::uint32_t mine = o.poly(op).origin[o.poly(op).first[id]], other = o.extreme(op, id);
  return op == 0 ? std::pair{mine, other} : std::pair{other, mine};
}

}  // namespace spatial

ConvexDepth ConvexSum::depth(Point3 point) const {
  Distances distances(*state_, point);
  const ExactDistances exact_distances(*state_, point);
  std::optional<SignedSquare> least;
  Facet nearest;
  for (const Facet& facet : distances.candidates()) {
    std::optional<SignedSquare> d = exact_distances.signed_square(facet);
    if (!d || (least && !(*d < *least))) continue;
    least = std::move(d);
    nearest = facet;
  }
  ConvexDepth result;
  result.inside = sign(least->num) > 0;
  if (result.inside) {
    const BigRational square = exact_distances.value(*least);
    result.depth_squared = exact::to_rational(square);
    result.depth = std::sqrt(exact::round_to_double(square));
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
