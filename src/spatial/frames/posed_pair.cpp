#include "spatial/frames/posed_pair.h"

#include <utility>

#include "spatial/convex/exact_places.h"

namespace dymsum::spatial {

using exact::BigInteger;

SolidPair solid_pair(const Mesh& p, const Mesh& q) {
  SolidPair pair{solid_operand(p.data(), p.thin_faces()), solid_operand(q.data(), q.thin_faces()), {}, {}};
  std::vector<Point3> all = pair.p.vertices;
  all.insert(all.end(), pair.q.vertices.begin(), pair.q.vertices.end());
  const GridPlaces places = grid_places(all);
  const auto share = [&](std::size_t first, std::size_t last) {
    GridPlaces some;
    some.bits = places.bits, some.exponent = places.exponent;
    const auto cut = [&](const auto& from, auto& to) {
      if (!from.empty())
        to.assign(from.begin() + static_cast<std::ptrdiff_t>(first), from.begin() + static_cast<std::ptrdiff_t>(last));
    };
    cut(places.grid, some.grid), cut(places.big, some.big);
    return some;
  };
  pair.p_places = share(0, pair.p.vertices.size());
  pair.q_places = share(pair.p.vertices.size(), all.size());
  return pair;
}

PosedSpace posed_space(const SolidPair& pair, const PosePair& poses) {
  ExactPose p = ExactPose::of(poses.p), q = ExactPose::of(poses.q);
  const BigInteger common = gcd(p.den, q.den), of_p = q.den / common, of_q = p.den / common;
  for (BigInteger& m : p.matrix) m *= of_p;
  for (BigInteger& m : q.matrix) m *= of_q;
  return {make_sum_space({pair.p_places, p.matrix}, {pair.q_places, q.matrix}, pair.p_places.exponent), p.den * of_p};
}

}  // namespace dymsum::spatial
