#include "spatial/events/plane_names.h"

#include <algorithm>

#include "exact/big.h"
#include "spatial/moving/sum_shape.h"

namespace dymsum::spatial {

using exact::BigInteger;
using exact::Residue;

namespace {

/// A triangle of the face that touches, or two edges.
PlaneSource plane_of_contact(const SolidContact& contact, const SolidPair& pair) {
  const auto triangle = [](const SolidOperand& solid, const SolidFeature& f) {
    const auto at = std::find(solid.face.begin(), solid.face.end(), f.a);
    return solid.triangles[static_cast<std::size_t>(at - solid.face.begin())];
  };
  PlaneSource plane{{contact.p.a, contact.q.a},
                    {DirectionSource::Of::p, contact.p.a, contact.p.b},
                    {DirectionSource::Of::q, contact.q.a, contact.q.b}};
  if (contact.q.kind == SolidFeature::Kind::face) {
    const Triangle t = triangle(pair.q, contact.q);
    plane = {{contact.p.a, t[0]}, {DirectionSource::Of::q, t[0], t[1]}, {DirectionSource::Of::q, t[0], t[2]}};
  }
  if (contact.p.kind == SolidFeature::Kind::face) {
    const Triangle t = triangle(pair.p, contact.p);
    plane = {{t[0], plane.at.q}, {DirectionSource::Of::p, t[0], t[1]}, {DirectionSource::Of::p, t[0], t[2]}};
  }
  return plane;
}

std::uint64_t hash_of_number(const BigInteger& v) {
  std::uint64_t h = v < 0 ? 3 : 5;
  for (BigInteger rest = abs(v); rest != 0; rest >>= 64)
    h = mixed(h, static_cast<std::uint64_t>(BigInteger(rest & BigInteger(~std::uint64_t{0}))));
  return h;
}

constexpr std::uint64_t mixed_bits(std::uint64_t v) {
  v += 0x9e3779b97f4a7c15ULL;
  v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9ULL;
  v = (v ^ (v >> 27)) * 0x94d049bb133111ebULL;
  return v ^ (v >> 31);
}

Residue value_of(const exact::RootValue& v) {
  constexpr Residue kT = 0x1d3a5b7c9e8f6421ULL % exact::kResiduePrime;
  Residue value = 0;
  for (std::size_t k = v.terms().size(); k-- > 0;)
    value = exact::plus(exact::times(value, kT), exact::residue(exact::Big(v.terms()[k])));
  return value;
}

}  // namespace

std::uint64_t plane_name(const ScalingPair& pair, const SolidContact& contact) {
  const MovingPlane plane = pair.plane(plane_of_contact(contact, pair.pair()));
  const std::array<BigInteger, 5> all{plane.n[0], plane.n[1], plane.n[2], plane.d0, plane.d1};
  BigInteger divisor = 0;
  for (const BigInteger& v : all) divisor = gcd(divisor, v);
  for (std::size_t axis = 3; axis-- > 0;)
    if (plane.n[axis] != 0) {
      divisor = plane.n[axis] < 0 ? BigInteger(-abs(divisor)) : BigInteger(abs(divisor));
      break;
    }
  std::uint64_t h = 11;
  for (const BigInteger& v : all) h = mixed(h, hash_of_number(divisor == 0 ? v : BigInteger(v / divisor)));
  return h;
}

std::uint64_t plane_name(const RotatingPair& pair, const SolidContact& contact) {
  return plane_hash(PolynomialFrame(pair, 0), plane_of_contact(contact, pair.pair));
}

std::uint64_t plane_hash(const PolynomialFrame& frame, const PlaneSource& plane) {
  const PolynomialFrame::Vector n = RotationSigns<PolynomialFrame>(frame).normal(plane);
  // From the sum of the vertices 0 on, all positions are vectors times one weight.
  const PolynomialFrame::Vector direction = frame.direction(0, 0, plane.at.p) + frame.direction(1, 0, plane.at.q);
  const Residue x[3] = {value_of(direction.x), value_of(direction.y), value_of(direction.z)};
  Residue v[4] = {value_of(n.x), value_of(n.y), value_of(n.z), 0};
  for (int k = 0; k < 3; ++k) v[3] = exact::plus(v[3], exact::times(v[k], x[k]));
  Residue lead = 0;
  for (int k = 0; k < 3 && lead == 0; ++k) lead = v[k];
  if (lead == 0) return 1;
  const Residue by = exact::inverse(lead);
  std::uint64_t hash = 0;
  for (const Residue r : v) hash = mixed_bits(hash ^ mixed_bits(exact::times(r, by)));
  return hash;
}

}  // namespace dymsum::spatial
