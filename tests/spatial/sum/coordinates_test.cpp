// Sums of solids whose coordinates are those of real files: the same set as that of the reference engine, and nearly
// as few exact signs as on a grid.
#include <gtest/gtest.h>

#include "dymsum/spatial_sum.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/sanitized.h"
#include "spatial/sum/random_solids.h"
#include "spatial/sum/tested_sums.h"

namespace dymsum {
namespace {

/// A torus of triangles about z.
MeshData torus(int around, int across, double big, double small) {
  MeshData m;
  const double turn = 2 * std::acos(-1.0);
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double a = turn * i / around, b = turn * j / across, r = big + small * std::cos(b);
      m.vertices.push_back({r * std::cos(a), r * std::sin(a), small * std::sin(b)});
    }
  const auto id = [&](int i, int j) { return static_cast<std::uint32_t>(i % around * across + j % across); };
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      m.faces.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      m.faces.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  return m;
}

TEST(SpatialCoordinates, of_every_kind_give_what_the_brute_engine_finds) {
  std::mt19937_64 random(3811);
  for (const CoordinateKind kind : kCoordinateKinds) {
    int compared = 0;
    for (int pair = 0; pair < oracles::rounds(12, 2); ++pair) {
      const Result<Mesh> p = Mesh::create(of_kind(random_solids::tiny_polyhedron(random), kind, random)),
                         q = Mesh::create(of_kind(random_solids::tiny_polyhedron(random), kind, random));
      if (!p.ok() || !q.ok()) continue;
      ++compared;
      const SpatialSum fast = sum(p.value(), q.value()), all = sum(p.value(), q.value(), SpatialEngine::brute);
      EXPECT_EQ(fast, all) << name_of(kind) << ", pair " << pair << " of seed 3811";
      EXPECT_EQ(fast.volume_exact(), all.volume_exact()) << name_of(kind) << ", pair " << pair;
    }
    EXPECT_GT(compared, 0) << name_of(kind);
  }
}

// Two thirds of the positions that are looked at for tight features were once candidates because nearly parallel
// features counted as parallel, and each was tested against all that nearly touches there.
TEST(SpatialCoordinates, of_turned_tori_cost_few_exact_signs_and_tests) {
  std::mt19937_64 random(1);
  for (const CoordinateKind kind : kCoordinateKinds) {
    const Mesh p = Mesh::create(of_kind(torus(16, 8, 2, 0.7), kind, random)).value(),
               q = Mesh::create(of_kind(torus(12, 6, 1, 0.3), kind, random)).value();
    const SpatialStats stats = sum(p, q).stats;
    const std::uint64_t facets = stats.face_vertex + stats.edge_edge;
    EXPECT_LT(stats.exact_signs, 100 * facets) << name_of(kind);
    EXPECT_LT(stats.tight_tests, facets) << name_of(kind);
  }
}

// cos 90 degrees is 6e-17 in doubles: one such coordinate makes the grid along its axis 2^54 times as fine.
TEST(SpatialCoordinates, along_one_axis_do_not_make_those_along_the_others_vague) {
  MeshData p = torus(16, 8, 2, 0.7), q = torus(12, 6, 1, 0.3);
  std::mt19937_64 random(1);
  p = of_kind(p, CoordinateKind::grid, random), q = of_kind(q, CoordinateKind::grid, random);
  const std::uint64_t before = sum(Mesh::create(p).value(), Mesh::create(q).value()).stats.exact_signs;
  p.vertices[40].z += std::ldexp(1, -110);
  const SpatialSum fine = sum(Mesh::create(p).value(), Mesh::create(q).value());
  EXPECT_GT(fine.stats.bits, 100);
  EXPECT_LT(fine.stats.exact_signs, 3 * before);
}

TEST(SpatialCoordinates, of_more_than_two_thousand_bits_have_a_sum) {
  const double least = 5e-324, most = 1e300;
  const auto corner = [](double size) {
    return MeshData{{{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}},
                    {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  };
  const Mesh speck = Mesh::create(corner(least)).value(), giant = Mesh::create(corner(most)).value();
  const SpatialSum grown = sum(giant, speck), by_facets = sum(giant, speck, SpatialEngine::brute);
  EXPECT_GT(by_facets.stats.bits, 2000);
  EXPECT_EQ(grown.faces.size(), 4u) << "tetrahedra of one shape";
  EXPECT_EQ(grown, by_facets);
}

}  // namespace
}  // namespace dymsum
