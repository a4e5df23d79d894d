// Signs of how a sum's vertices lie to each other: those of exact rationals.
#include "spatial/sum/vertex_signs.h"

#include <gtest/gtest.h>

#include "dymsum/spatial_sum.h"
#include "oracles/coordinate_kinds.h"
#include "spatial/sum/random_solids.h"

namespace dymsum {
namespace {

using Exactly = std::array<Rational, 3>;

Exactly gap_of(const SpatialSum& sum, std::uint32_t from, std::uint32_t to) {
  const RationalPoint3 a = sum.exact(from), b = sum.exact(to);
  return {b.x - a.x, b.y - a.y, b.z - a.z};
}
Rational cross_component(const Exactly& u, const Exactly& v, std::size_t axis) {
  const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
  return u[i] * v[j] - u[j] * v[i];
}
int sign_of_rational(const Rational& v) { return v > Rational(0) ? 1 : v < Rational(0) ? -1 : 0; }

TEST(VertexSigns, are_those_of_exact_positions) {
  std::mt19937_64 random(417);
  int compared = 0, zeros = 0;
  for (const CoordinateKind kind : kCoordinateKinds) {
    for (int pair = 0; pair < 3; ++pair) {
      const Result<Mesh> p = Mesh::create(of_kind(random_solids::tiny_polyhedron(random), kind, random)),
                         q = Mesh::create(of_kind(random_solids::tiny_polyhedron(random), kind, random));
      if (!p.ok() || !q.ok()) continue;
      const SpatialSum sum = minkowski_sum(*p, *q).value();
      if (sum.vertices.size() < 4) continue;
      spatial::VertexSigns signs(sum);
      const auto compare = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        const Exactly u = gap_of(sum, a, b), v = gap_of(sum, a, c), w = gap_of(sum, a, d);
        Rational det(0);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const Rational n = cross_component(u, v, axis);
          EXPECT_EQ(signs.turn(a, b, c, axis), sign_of_rational(n)) << name_of(kind) << ", pair " << pair;
          det += n * w[axis];
        }
        EXPECT_EQ(signs.side(a, b, c, d), sign_of_rational(det)) << name_of(kind) << ", pair " << pair;
        ++compared, zeros += sign_of_rational(det) == 0;
      };
      const auto any = [&] { return static_cast<std::uint32_t>(random() % sum.vertices.size()); };
      for (int k = 0; k < 60; ++k) compare(any(), any(), any(), any());
      for (const SpatialFace& face : sum.faces)
        if (const auto& loop = face.loops[0]; loop.size() > 3) compare(loop[0], loop[1], loop[2], loop[3]);
    }
  }
  EXPECT_GT(compared, 800);
  EXPECT_GT(zeros, 50) << "in one plane";
}

}  // namespace
}  // namespace dymsum
