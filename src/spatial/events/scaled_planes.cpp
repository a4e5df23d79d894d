#include "spatial/events/scaled_planes.h"

#include "spatial/moving/shape_hashes.h"

namespace dymsum::spatial {

using exact::BigInteger;

namespace {

std::uint64_t name_of_number(const BigInteger& v) {
  std::uint64_t h = v < 0 ? 3 : 5;
  for (BigInteger rest = abs(v); rest != 0; rest >>= 64)
    h = mixed(h, static_cast<std::uint64_t>(BigInteger(rest & BigInteger(~std::uint64_t{0}))));
  return h;
}

}  // namespace

ScaledPlanes::ScaledPlanes(const Mesh& p, const Mesh& q, int moving) : p_(&p), q_(&q), moving_(moving) {
  std::vector<Point3> all = p.vertices();
  all.insert(all.end(), q.vertices().begin(), q.vertices().end());
  places_ = grid_places(all);
}

ScaledPlanes::Big3 ScaledPlanes::place(int operand, std::uint32_t v) const {
  const auto at = places_.place<exact::Big>(operand == 0 ? v : v + static_cast<std::uint32_t>(p_->vertices().size()));
  return {at.x.value(), at.y.value(), at.z.value()};
}

std::vector<std::uint32_t> ScaledPlanes::vertices_of(int operand, const SolidFeature& feature) const {
  if (feature.kind == SolidFeature::Kind::vertex) return {feature.a};
  if (feature.kind == SolidFeature::Kind::edge) return {feature.a, feature.b};
  return (operand == 0 ? p_ : q_)->faces()[feature.a];
}

ScaledPlanes::Big3 ScaledPlanes::normal(const std::vector<std::uint32_t>& of_p, const std::vector<std::uint32_t>& of_q,
                                        bool face_of_p) const {
  const auto minus = [](const Big3& u, const Big3& v) { return Big3{u[0] - v[0], u[1] - v[1], u[2] - v[2]}; };
  const auto cross3 = [](const Big3& u, const Big3& v) {
    return Big3{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  };
  std::vector<Big3> ways;
  for (std::size_t k = 1; k < of_p.size(); ++k) ways.push_back(minus(place(0, of_p[k]), place(0, of_p[0])));
  if (!face_of_p)
    for (std::size_t k = 1; k < of_q.size(); ++k) ways.push_back(minus(place(1, of_q[k]), place(1, of_q[0])));
  Big3 n{0, 0, 0};
  for (std::size_t k = 1; k < ways.size() && n == Big3{0, 0, 0}; ++k) n = cross3(ways[0], ways[k]);
  return n;
}

std::uint64_t ScaledPlanes::name(const SolidContact& contact) const {
  const std::vector<std::uint32_t> a = vertices_of(0, contact.p), b = vertices_of(1, contact.q);
  const Big3 n = normal(a, b, contact.p.kind == SolidFeature::Kind::face);
  const auto dot3 = [&](const Big3& u) -> BigInteger { return n[0] * u[0] + n[1] * u[1] + n[2] * u[2]; };
  const BigInteger of_p = dot3(place(0, a[0])), of_q = dot3(place(1, b[0]));
  const std::array<BigInteger, 5> all{n[0], n[1], n[2], moving_ == 0 ? of_q : of_p, moving_ == 0 ? of_p : of_q};
  BigInteger divisor = 0;
  for (const BigInteger& v : all) divisor = gcd(divisor, v);
  for (std::size_t axis = 3; axis-- > 0;)
    if (n[axis] != 0) {
      divisor = n[axis] < 0 ? BigInteger(-abs(divisor)) : BigInteger(abs(divisor));
      break;
    }
  std::uint64_t h = 11;
  for (const BigInteger& v : all) h = mixed(h, name_of_number(divisor == 0 ? v : BigInteger(v / divisor)));
  return h;
}

}  // namespace dymsum::spatial
