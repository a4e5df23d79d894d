#include "depth/exact_facet_distances.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "exact/grid.h"
#include "spatial/convex/assemble.h"
#include "spatial/mesh/rounded_vector.h"

namespace dymsum::spatial {

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

}  // namespace dymsum::spatial
