#include "spatial/scaling/sum_shape.h"

#include <algorithm>
#include <map>

#include "exact/residue.h"

namespace dymsum::spatial {

using exact::BigInteger;

namespace {

std::uint64_t mixed(std::uint64_t h, std::uint64_t v) {
  h ^= v + 0x9e3779b97f4a7c15ULL + (h << 6) + (h >> 2);
  h ^= h >> 31, h *= 0x7fb5d329728ea185ULL, h ^= h >> 27, h *= 0x81dadef4bc2dd44dULL;
  return h ^ (h >> 33);
}
std::uint64_t mixed_list(std::uint64_t seed, std::vector<std::uint64_t>& values) {
  std::sort(values.begin(), values.end());
  for (const std::uint64_t v : values) seed = mixed(seed, v);
  return mixed(seed, values.size());
}
std::uint64_t name_of_number(const BigInteger& v) {
  std::uint64_t h = v < 0 ? 3 : 5;
  for (BigInteger rest = abs(v); rest != 0; rest >>= 64)
    h = mixed(h, static_cast<std::uint64_t>(BigInteger(rest & BigInteger(~std::uint64_t{0}))));
  return h;
}

/// Of a cyclic list, wherever it begins.
std::uint64_t cyclic_hash(const std::vector<std::uint64_t>& ring) {
  const std::size_t n = ring.size();
  std::size_t i = 0, j = 1, k = 0;
  while (i < n && j < n && k < n) {
    const std::uint64_t a = ring[(i + k) % n], b = ring[(j + k) % n];
    if (a == b) {
      ++k;
      continue;
    }
    (a > b ? i : j) += k + 1;
    if (i == j) ++j;
    k = 0;
  }
  std::uint64_t h = n;
  for (std::size_t m = 0; m < n; ++m) h = mixed(h, ring[(std::min(i, j) + m) % n]);
  return h;
}

std::uint64_t name_of_feature(const SolidFeature& f) {
  return mixed(mixed(static_cast<std::uint64_t>(f.kind), f.a), f.b);
}
std::uint64_t name_of_contacts(const std::vector<SolidContact>& contacts) {
  std::uint64_t h = 7;
  for (const SolidContact& c : contacts) h = mixed(mixed(h, name_of_feature(c.p)), name_of_feature(c.q));
  return h;
}

using Loops = std::vector<std::vector<std::uint32_t>>;

/// V - E + F of every shell; a face with h holes counts 1 - h.
std::vector<std::int64_t> euler_numbers(const SpatialSum& sum) {
  std::vector<std::int64_t> euler(sum.shells);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> vertices;
  for (const SpatialFace& face : sum.faces) {
    euler[face.shell] += 2 - static_cast<std::int64_t>(face.loops.size());
    for (const auto& loop : face.loops)
      for (const std::uint32_t v : loop) vertices.emplace_back(face.shell, v);
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  for (const auto& [shell, v] : vertices) ++euler[shell];
  for (const SpatialEdge& edge : sum.edges) {
    std::vector<std::uint32_t> shells;
    for (const std::uint32_t f : edge.faces) shells.push_back(sum.faces[f].shell);
    std::sort(shells.begin(), shells.end());
    // Where the boundary touches itself along an edge it counts once for every two faces.
    for (std::size_t k = 0; k < shells.size(); k += 2) --euler[shells[k]];
  }
  std::sort(euler.begin(), euler.end());
  return euler;
}

}  // namespace

SumShapes::SumShapes(const Mesh& p, const Mesh& q, int moving) : p_(&p), q_(&q), moving_(moving) {
  std::vector<Point3> all = p.vertices();
  all.insert(all.end(), q.vertices().begin(), q.vertices().end());
  places_ = grid_places(all);
}

SumShapes::Big3 SumShapes::place(int operand, std::uint32_t v) const {
  const auto at = places_.place<exact::Big>(operand == 0 ? v : v + static_cast<std::uint32_t>(p_->vertices().size()));
  return {at.x.value(), at.y.value(), at.z.value()};
}

std::vector<std::uint32_t> SumShapes::vertices_of(int operand, const SolidFeature& feature) const {
  if (feature.kind == SolidFeature::Kind::vertex) return {feature.a};
  if (feature.kind == SolidFeature::Kind::edge) return {feature.a, feature.b};
  return (operand == 0 ? p_ : q_)->faces()[feature.a];
}

/// The hyperplane n . x = d0 + s d1 of what two features make, in lowest terms.
std::uint64_t SumShapes::plane_name(const SolidContact& contact) const {
  const std::vector<std::uint32_t> a = vertices_of(0, contact.p), b = vertices_of(1, contact.q);
  const auto minus = [](const Big3& u, const Big3& v) { return Big3{u[0] - v[0], u[1] - v[1], u[2] - v[2]}; };
  const auto cross3 = [](const Big3& u, const Big3& v) {
    return Big3{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  };
  const auto is_zero = [](const Big3& u) { return u[0] == 0 && u[1] == 0 && u[2] == 0; };
  std::vector<Big3> ways;
  for (std::size_t k = 1; k < a.size(); ++k) ways.push_back(minus(place(0, a[k]), place(0, a[0])));
  if (contact.p.kind != SolidFeature::Kind::face)
    for (std::size_t k = 1; k < b.size(); ++k) ways.push_back(minus(place(1, b[k]), place(1, b[0])));
  Big3 n{0, 0, 0};
  for (std::size_t k = 1; k < ways.size() && is_zero(n); ++k) n = cross3(ways[0], ways[k]);
  const auto dot3 = [&](const Big3& u) -> BigInteger { return n[0] * u[0] + n[1] * u[1] + n[2] * u[2]; };
  const BigInteger of_p = dot3(place(0, a[0])), of_q = dot3(place(1, b[0]));
  std::array<BigInteger, 5> all{n[0], n[1], n[2], moving_ == 0 ? of_q : of_p, moving_ == 0 ? of_p : of_q};
  BigInteger divisor = 0;
  for (const BigInteger& v : all) divisor = gcd(divisor, v);
  for (int axis = 2; axis >= 0; --axis)
    if (n[static_cast<std::size_t>(axis)] != 0) {
      divisor = n[static_cast<std::size_t>(axis)] < 0 ? BigInteger(-abs(divisor)) : BigInteger(abs(divisor));
      break;
    }
  std::uint64_t h = 11;
  for (const BigInteger& v : all) h = mixed(h, name_of_number(divisor == 0 ? v : BigInteger(v / divisor)));
  return h;
}

SumShape SumShapes::of(const SpatialSum& sum) const {
  SumShape shape;
  shape.topology.euler = euler_numbers(sum);
  shape.topology.tight = {sum.tight_faces.size(), sum.tight_segments.size(), sum.tight_points.size()};
  std::vector<std::uint64_t> plane;
  std::map<SolidContact, std::uint64_t> known;
  const auto name = [&](const SolidContact& c) {
    const auto [at, fresh] = known.try_emplace(c, 0);
    if (fresh) at->second = plane_name(c);
    return at->second;
  };
  for (const SpatialFace& face : sum.faces) plane.push_back(name({face.p, face.q}));
  std::vector<std::vector<std::uint64_t>> around(sum.vertices.size());
  for (std::size_t f = 0; f < sum.faces.size(); ++f)
    for (const auto& loop : sum.faces[f].loops)
      for (const std::uint32_t v : loop) around[v].push_back(plane[f]);
  std::vector<std::uint64_t> vertex;
  for (std::vector<std::uint64_t>& faces : around) vertex.push_back(mixed_list(13, faces));
  const auto edge_name = [&](std::uint32_t a, std::uint32_t b) {
    const std::pair ends{std::min(a, b), std::max(a, b)};
    const auto at = std::lower_bound(sum.edges.begin(), sum.edges.end(), ends, [](const SpatialEdge& e, const auto& v) {
      return std::pair{e.from, e.to} < v;
    });
    std::vector<std::uint64_t> faces;
    if (at != sum.edges.end() && at->from == ends.first && at->to == ends.second)
      for (const std::uint32_t f : at->faces) faces.push_back(plane[f]);
    return mixed_list(17, faces);
  };
  const auto loops_name = [&](const Loops& loops) {
    std::vector<std::uint64_t> names;
    for (const auto& loop : loops) {
      std::vector<std::uint64_t> ring;
      for (std::size_t k = 0; k < loop.size(); ++k)
        ring.push_back(mixed(vertex[loop[k]], edge_name(loop[k], loop[(k + 1) % loop.size()])));
      names.push_back(cyclic_hash(ring));
    }
    return mixed_list(19, names);
  };
  std::vector<std::vector<std::uint64_t>> shells(sum.shells);
  for (std::size_t f = 0; f < sum.faces.size(); ++f)
    shells[sum.faces[f].shell].push_back(mixed(plane[f], loops_name(sum.faces[f].loops)));
  std::vector<std::uint64_t> parts;
  for (std::vector<std::uint64_t>& faces : shells) parts.push_back(mixed_list(23, faces));
  for (std::size_t t = 0; t < sum.tight_faces.size(); ++t)
    parts.push_back(mixed(mixed(29, name(sum.tight_face_contacts[t][0])), loops_name(sum.tight_faces[t])));
  for (const auto& contacts : sum.tight_segment_contacts) parts.push_back(mixed(31, name_of_contacts(contacts)));
  for (const auto& contacts : sum.tight_point_contacts) parts.push_back(mixed(37, name_of_contacts(contacts)));
  shape.hash = mixed_list(41, parts);
  return shape;
}

}  // namespace dymsum::spatial
