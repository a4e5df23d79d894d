// Solid results as the solids that they are times their least common denominator: for comparing what is made of results
// with what is made of solids in integers.
#pragma once

#include <optional>
#include <vector>

#include "dymsum/mesh.h"
#include "dymsum/solid_union.h"
#include "dymsum/spatial_sum.h"
#include "exact/big.h"
#include "random.h"
#include "spatial/sum/exact_set.h"

namespace dymsum::oracles {

/// The least common denominator of all coordinates.
inline exact::BigInteger denominator_of(const SpatialSum& sum) {
  exact::BigInteger all = 1;
  for (const auto& at : spatial::exact_set(sum).at)
    for (const exact::BigRational& c : at) all = lcm(all, exact::BigInteger(denominator(c)));
  return all;
}

/// The solid times an integer; nothing where doubles do not hold it.
inline std::optional<Mesh> solid_times(const SpatialSum& sum, const exact::BigInteger& factor) {
  const spatial::ExactSet set = spatial::exact_set(sum);
  MeshData data{{}, set.set.faces};
  for (const auto& at : set.at) {
    double near[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const exact::BigRational c = at[k] * factor;
      near[k] = exact::round_to_double(c);
      if (exact::exact_value(near[k]) != c) return std::nullopt;
    }
    data.vertices.push_back({near[0], near[1], near[2]});
  }
  Result<Mesh> mesh = Mesh::create(std::move(data));
  return mesh ? std::optional(*std::move(mesh)) : std::nullopt;
}

/// A tetrahedron with corners on a grid, less or united with another one: its vertices are fractions, mostly.
inline SpatialSum random_solid_of_fractions(Random& random) {
  const auto tetrahedron = [&]() -> Mesh {
    for (;;) {
      std::vector<Point3> corners;
      for (int k = 0; k < 4; ++k)
        corners.push_back({static_cast<double>(random.below(5)), static_cast<double>(random.below(5)),
                           static_cast<double>(random.below(5))});
      if (Result<Mesh> hull = convex_hull(corners)) return *std::move(hull);
    }
  };
  for (;;) {
    const Mesh a = tetrahedron(), b = tetrahedron();
    const Result<SpatialSum> made = random.chance(50) ? difference(a, b) : united(std::vector<Mesh>{a, b});
    if (made && !made->faces.empty()) return *made;
  }
}

}  // namespace dymsum::oracles
