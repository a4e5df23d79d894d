// How deep a point lies in a sum: the least distance to the plane of a facet. Doubles leave few candidates, which are
// compared exactly.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "exact/big.h"
#include "exact/grid.h"
#include "exact/int.h"
#include "exact/rounding_bound.h"
#include "spatial/convex/convex_sum.h"
#include "spatial/convex/exact_positions.h"
#include "spatial/convex/facet_corners.h"
#include "spatial/gauss/overlay.h"
#include "spatial/mesh/vec3.h"

namespace dymsum::spatial {
namespace {

// The facets of the generic sum of two convex solids, by what makes them.

/// A face of an operand with its extreme vertex, or a crossing.
struct GenericFacet {
  int op = 0;  ///< 0, 1: face `id` of P, of Q; 2: crossing `id`
  std::uint32_t id = 0;
};

// Distances of a point to the planes of facets, in doubles with bounds of their errors.

/// A vector 2^exponent v; every component has relative error below 2^-50.
struct ScaledVector {
  Vec3 v;
  int exponent = 0;
};

/// Everything is scaled by one power of two so that the largest of these is about 1: the extents of the posed operands,
/// the position of the sum of their first vertices as seen from the point. So nothing overflows, and what vanishes is
/// far below the bounds of errors, whatever the sizes of the solids.
class FacetDistances {
 public:
  /// `base`: the position of vertex 0 of P plus vertex 0 of Q, less the point.
  FacetDistances(const Overlay& overlay, const PosedDoubles& p, const PosedDoubles& q, const ScaledVector& base);

  /// The facets that may be nearest.
  std::vector<GenericFacet> candidates();

 private:
  void consider(const GenericFacet& facet, Vec3 n, Vec3 corner);
  Vec3 corner(const GenericFacet& facet) const;

  const Overlay& o_;
  std::array<Mat3, 2> map_, cofactors_;        // up to positive factors
  std::array<double, 3> spread_{0, 0, 1};      // bounds of the lengths of normals, by kind of facet
  std::array<std::vector<Vec3>, 2> position_;  // of every vertex, seen from vertex 0, P's also from the point
  double reach_ = 0;                           // a bound of the lengths of positions, and of their sum
  // What is known of the facets so far: an upper bound of the least distance, a little more than its square, and lower
  // bounds of the distances of those that may have it.
  double least_upper_ = std::numeric_limits<double>::infinity(), far_ = least_upper_;
  std::vector<std::pair<double, GenericFacet>> lower_;
};

// Matrices err by 16 u of their entries and unit vectors by 8: normals, sums of three products, by 27 of entries that
// make up sqrt(3) of the spread; those across two edges by twice as much and the product of norms: 128. Positions err
// by 16 + 16 of the reach.
constexpr int kNormal = 128, kPosition = 32;

// The error of normal times position over the normal's length, times spread and reach over that length: the normal's
// error counts again in the length; three products and their sum, the quotient and the root.
constexpr double kDistanceError = exact::rounding_bound(2 * kNormal + kPosition + 3 + 2, 512);

// Squares above this have lost nothing to underflow.
constexpr double kNotSmall = 0x1p-900;

// Norms are at least 1, as each matrix has an entry in [1, 2), so spreads are; of the three lengths that make reach_
// one is at least 1/2. All numbers are at most 2^20, and what underflows loses at most 2^-1000.
FacetDistances::FacetDistances(const Overlay& overlay, const PosedDoubles& p, const PosedDoubles& q,
                               const ScaledVector& base)
    : o_(overlay), map_{p.map, q.map}, cofactors_{p.cofactors, q.cofactors} {
  const std::array<int, 2> exponent{o_.poly(0).size + p.exponent, o_.poly(1).size + q.exponent};
  int top = std::max(exponent[0], exponent[1]);
  const double far = length(base.v);
  if (far > 0) top = std::max(top, base.exponent + std::ilogb(far));
  const Vec3 from{std::ldexp(base.v.x, base.exponent - top), std::ldexp(base.v.y, base.exponent - top),
                  std::ldexp(base.v.z, base.exponent - top)};
  reach_ = 1.01 * length(from);
  for (int op = 0; op < 2; ++op) {
    spread_[op] = spectral_bound(cofactors_[op]);
    const double norm = spectral_bound(map_[op]);
    spread_[2] *= norm;
    reach_ += 1.74 * std::ldexp(norm, exponent[op] - top);  // a vertex is at most sqrt(3) units from vertex 0
    const Mat3 to_position = scaled_by_power(map_[op], exponent[op] - top);
    position_[op].reserve(o_.poly(op).vertex_count());
    for (const Vec3& v : o_.poly(op).from_first)
      position_[op].push_back(op == 0 ? to_position * v + from : to_position * v);
  }
}

std::vector<GenericFacet> FacetDistances::candidates() {
  for (int op = 0; op < 2; ++op)
    for (std::uint32_t f = 0; f < o_.poly(op).face_count(); ++f)
      consider({op, f}, cofactors_[op] * o_.poly(op).normal[f], corner({op, f}));
  const Polytope &p = o_.poly(0), &q = o_.poly(1);
  for (std::uint32_t e = 0; e < p.edge_count(); ++e) {
    if (o_.first_crossing(0, e) == kNoCrossing) continue;
    const Vec3 along = map_[0] * p.direction[e], from = position_[0][p.origin[2 * e]];
    for (std::uint32_t id = o_.first_crossing(0, e); id != kNoCrossing; id = o_.crossing(id).next[0]) {
      const HalfEdge h = o_.crossing(id).q;
      consider({2, id}, cross(map_[1] * q.along(h), along), from + position_[1][q.origin[h]]);
    }
  }
  std::vector<GenericFacet> near;
  for (const auto& [lower, facet] : lower_)
    if (lower <= least_upper_) near.push_back(facet);
  return near;
}

// The facet with outward normal n through a corner, seen from the point.
void FacetDistances::consider(const GenericFacet& facet, Vec3 n, Vec3 corner) {
  const double product = dot(n, corner), error = kDistanceError * spread_[facet.op] * reach_, square = dot(n, n);
  // Nearly all are further away, which no root is needed for. Where squares are too small to tell, roots do.
  const double least = product - error, least_square = least * least;
  if (least > 0 && least_square > far_ * square && least_square > kNotSmall) return;
  const double size = std::sqrt(square);
  double lower = -std::numeric_limits<double>::infinity();  // doubles may give no direction
  if (error < reach_ * size) {
    lower = least / size;
    least_upper_ = std::min(least_upper_, (product + error) / size);
    far_ = least_upper_ * least_upper_ * exact::kOutwards;
  }
  if (lower <= least_upper_) lower_.push_back({lower, facet});
}

Vec3 FacetDistances::corner(const GenericFacet& facet) const {
  const auto [p, q] = corner_of(o_, facet.op, facet.id);
  return position_[0][p] + position_[1][q];
}

// Exact distances of a point to the planes of facets.

/// The square of a distance, up to a factor that all share, with the sign of the distance: num / size.
struct SignedSquare {
  exact::Big num, size;
  bool operator<(const SignedSquare& other) const { return (num * other.size).value() < (other.num * size).value(); }
};

/// Everything in integers: places as multiples of 2^exponent / den.
class ExactFacetDistances {
 public:
  ExactFacetDistances(const spatial::ConvexState& s, Point3 point);

  /// Nothing for crossings of parallel edges, which are no facets.
  std::optional<SignedSquare> signed_square(const GenericFacet& facet) const;
  /// The number itself.
  exact::BigRational value(const SignedSquare& s) const;
  /// An outward normal.
  exact::Vector3<exact::Big> normal(const GenericFacet& facet) const;
  /// The position of vertex 0 of P plus vertex 0 of Q, less the point.
  ScaledVector base() const;

 private:
  exact::Vector3<exact::Big> position(std::uint32_t p, std::uint32_t q) const;

  const spatial::ConvexState& s_;
  std::array<exact::Matrix3<exact::Big>, 2> m_;  // of the poses, over their own denominators
  std::array<exact::Big, 2> unit_;               // what vertices of an operand are multiplied with
  exact::Vector3<exact::Big> x_;
  exact::BigInteger den_;
  int exponent_ = 0;
};

using exact::Big;

using exact::BigInteger;

using exact::BigRational;

ExactFacetDistances::ExactFacetDistances(const spatial::ConvexState& s, Point3 point) : s_(s) {
  const std::array<ExactPose, 2> pose{ExactPose::of(s.p_pose), ExactPose::of(s.q_pose)};
  const std::array<exact::Dyadic, 3> x{exact::to_dyadic(point.x), exact::to_dyadic(point.y), exact::to_dyadic(point.z)};
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

exact::Vector3<Big> ExactFacetDistances::position(std::uint32_t p, std::uint32_t q) const {
  const auto a = exact::apply(m_[0], s_.p->position<Big>(p)), b = exact::apply(m_[1], s_.q->position<Big>(q));
  const auto sum = [&](const Big& u, const Big& v) { return unit_[0] * u + unit_[1] * v; };
  return exact::Vector3<Big>{sum(a.x, b.x), sum(a.y, b.y), sum(a.z, b.z)} - x_;
}

std::optional<SignedSquare> ExactFacetDistances::signed_square(const GenericFacet& facet) const {
  const exact::Vector3<Big> n = normal(facet);
  const Big size = exact::dot(n, n);
  if (sign(size) == 0) return std::nullopt;
  const auto [p, q] = corner_of(s_.overlay, facet.op, facet.id);
  const Big d = exact::dot(n, position(p, q));
  return SignedSquare{sign(d) < 0 ? -(d * d) : d * d, size};
}

BigRational ExactFacetDistances::value(const SignedSquare& s) const {
  const auto twice = static_cast<unsigned>(2 * std::abs(exponent_));
  const BigInteger den = s.size.value() * den_ * den_;
  return exponent_ < 0 ? BigRational(s.num.value(), BigInteger(den << twice))
                       : BigRational(BigInteger(s.num.value() << twice), den);
}

exact::Vector3<Big> ExactFacetDistances::normal(const GenericFacet& facet) const {
  if (facet.op < 2) {
    const exact::Matrix3<Big>& m = m_[facet.op];
    const exact::Matrix3<Big> cof{exact::cross(m[1], m[2]), exact::cross(m[2], m[0]), exact::cross(m[0], m[1])};
    return exact::apply(cof, s_.poly(facet.op).normal_vector<Big>(facet.id));
  }
  const Crossing& c = s_.overlay.crossing(facet.id);
  return exact::cross(exact::apply(m_[1], s_.q->edge_vector<Big>(c.q)),
                      exact::apply(m_[0], s_.p->edge_vector<Big>(2 * c.p)));
}

// A quotient of two numbers that are scaled to about 1 and rounded once each.
ScaledVector ExactFacetDistances::base() const {
  const exact::Vector3<Big> at = position(0, 0);
  const int top = bit_length(at), bottom = bit_length(Big(den_));
  const double den = rounded(Big(den_), -bottom);
  return {(1 / den) * rounded(at, -top), top - bottom + exponent_};
}

}  // namespace
}  // namespace dymsum::spatial

namespace dymsum {

// How deep a point lies in a sum: the least distance to the plane of a facet. Doubles leave few candidates, which are
// compared exactly.

namespace {

using spatial::GenericFacet;
using spatial::Vec3;

bool is_finite(Point3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

void name_features(const spatial::ConvexState& s, const GenericFacet& facet, ConvexDepth& depth) {
  const spatial::Overlay& o = s.overlay;
  if (facet.op == 2) {
    const spatial::Crossing& c = o.crossing(facet.id);
    depth.p = spatial::edge_feature(*s.p, s.p->origin[2 * c.p], s.p->target(2 * c.p));
    depth.q = spatial::edge_feature(*s.q, s.q->origin[c.q], s.q->target(c.q));
    return;
  }
  std::vector<spatial::VertexPair> corners;
  const spatial::FacetFeatures features = spatial::append_face(o, facet.op, facet.id, corners);
  depth.p = features.p;
  depth.q = features.q;
}

/// Edges whose arcs do not truly cross span a part of a facet that a face makes, which is as near.
bool is_part_of_another(const spatial::Overlay& o, const GenericFacet& facet) {
  return facet.op == 2 && !spatial::crosses_properly(o, o.crossing(facet.id));
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
  if (!is_finite(point)) throw std::invalid_argument("ConvexSum::depth: the point is not finite");
  const spatial::ExactFacetDistances exact_distances(*state_, point);
  spatial::FacetDistances distances(state_->overlay, spatial::PosedDoubles(state_->p_factors),
                                    spatial::PosedDoubles(state_->q_factors), exact_distances.base());
  std::optional<spatial::SignedSquare> least;
  GenericFacet nearest;
  for (const GenericFacet& facet : distances.candidates()) {
    std::optional<spatial::SignedSquare> d = exact_distances.signed_square(facet);
    if (!d || (least && !(*d < *least)) || is_part_of_another(state_->overlay, facet)) continue;
    least = std::move(d);
    nearest = facet;
  }
  ConvexDepth result;
  result.inside = sign(least->num) > 0;
  if (result.inside) {
    const exact::BigRational square = exact_distances.value(*least);
    result.depth_squared = exact::to_rational(square);
    result.depth = exact::root_to_double(square);
  }
  const Vec3 n = spatial::unit(exact_distances.normal(nearest));
  result.direction = {n.x, n.y, n.z};
  name_features(*state_, nearest, result);
  return result;
}

Result<ConvexDepth> penetration_depth(const Mesh& p, const Mesh& q, const SolidPose& p_pose, const SolidPose& q_pose,
                                      Point3 q_moved_by) {
  if (!is_finite(q_moved_by)) return Error{ErrorCode::not_finite, "the translation is not finite", {}};
  Result<ConvexSum> sum = ConvexSum::create(p, negated(q));
  if (!sum) return sum.error();
  ConvexSum difference = std::move(sum).value();
  difference.set(p_pose, q_pose);
  return difference.depth(q_moved_by);
}

}  // namespace dymsum
