// Both operands have parts without volume: their open sum and what is tight, where no two of them can cross.
#include <gtest/gtest.h>

#include <cstdlib>

#include "dymsum/solids.h"
#include "dymsum/spatial_sum.h"
#include "oracles/sanitized.h"
#include "oracles/voxel_solids.h"
#include "spatial/sum/solid_cases.h"

namespace dymsum {
namespace {

using oracles::LatticeCells;
using oracles::Voxel;

int pairs_of_thin_sets(int few) {
  const char* text = std::getenv("DYMSUM_FUZZ_PAIRS");
  return text != nullptr ? std::max(few, std::atoi(text) / 10) : few;
}

/// Some cubes, and thin parts that cannot cross those of another such set: points, segments, or squares and segments
/// all along one plane.
LatticeCells random_set(std::mt19937_64& random, bool plates, int cubes) {
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<std::uint64_t>(n)); };
  LatticeCells cells;
  while (static_cast<int>(cells.size()) < cubes) cells.insert({2 * below(3) + 1, 2 * below(3) + 1, 2 * below(2) + 1});
  const int all = static_cast<int>(cells.size()) + 1 + below(3);
  for (int tries = 0; static_cast<int>(cells.size()) < all && tries < 50; ++tries) {
    const Voxel c{below(7), below(7), below(5)};
    const int dimension = c[0] % 2 + c[1] % 2 + c[2] % 2;
    if (plates ? c[2] % 2 == 0 : dimension < 2) cells.insert(c);
  }
  return cells;
}

double length_of_tight(const SpatialSum& s) {
  double total = 0;
  for (const auto& segment : s.tight_segments) total += length(s, segment);
  return total;
}

TEST(ThinPairs, of_lattice_cells_have_an_open_sum) {
  int tight = 0, checked = 0;
  for (int k = 0; k < pairs_of_thin_sets(oracles::rounds(20, 2)); ++k) {
    std::mt19937_64 random(static_cast<std::uint64_t>(4000 + k));
    const LatticeCells a = random_set(random, k % 2 == 0, 1 + k % 7), b = random_set(random, k % 2 == 0, k % 3);
    const Result<Mesh> p = Mesh::with_thin_parts(oracles::lattice_mesh(a)),
                       q = Mesh::with_thin_parts(oracles::lattice_mesh(b));
    if (!p || !q || !p->has_thin_parts() || !q->has_thin_parts()) continue;
    ++checked;
    const oracles::VoxelSum expected = oracles::lattice_sum_of_both(a, b);
    const std::string seed = "seed " + std::to_string(4000 + k);
    SpatialOptions options;
    options.semantics = Semantics::open;
    const Result<SpatialSum> made = minkowski_sum(*p, *q, options);
    ASSERT_TRUE(made.ok()) << seed << ": " << made.error().to_string();
    EXPECT_EQ(made->volume_exact(), static_cast<std::int64_t>(expected.volume)) << seed;
    EXPECT_EQ(tight_area(*made), static_cast<double>(expected.tight_faces)) << seed;
    EXPECT_EQ(length_of_tight(*made), static_cast<double>(expected.tight_edges)) << seed;
    EXPECT_EQ(made->tight_points.size(), expected.tight_points) << seed;
    EXPECT_TRUE(*made == minkowski_sum(*q, *p, options).value()) << seed;
    EXPECT_EQ(minkowski_sum(*p, *q).value().volume_exact(), static_cast<std::int64_t>(expected.volume))
        << seed << ", closed";
    options.engine = SpatialEngine::brute;
    if (k % 4 == 0) {
      EXPECT_TRUE(*made == minkowski_sum(*p, *q, options).value()) << seed << ", brute";
    }
    for (std::size_t i = 0; i < made->vertices.size() && i < 20; ++i)
      EXPECT_FALSE(contains(*p, *q, made->vertices[i], Semantics::open).value()) << seed;
    tight += expected.tight_faces + expected.tight_edges + expected.tight_points > 0;
  }
  EXPECT_GT(checked, oracles::rounds(12, 2));
  EXPECT_GT(tight, oracles::rounds(2, 2));
}

TEST(ThinPairs, a_pin_with_a_wire_in_a_slot_with_a_whisker) {
  // A block with a tunnel of 2 x 2 and a wire beside it, a bar as wide with a wire: the bar's way through is tight.
  MeshData block = tunnel(), bar = solids::box(-9, -1, -1, 9, 1, 1).data();
  for (const auto& [m, x] : {std::pair{&block, 60.0}, std::pair{&bar, -60.0}}) {
    const auto first = static_cast<std::uint32_t>(m->vertices.size());
    m->vertices.insert(m->vertices.end(), {{x, 0, 0}, {x + 1, 1, 0}});
    m->faces.push_back({first, first + 1});
  }
  SpatialOptions open;
  open.semantics = Semantics::open;
  const SpatialSum sum =
      minkowski_sum(Mesh::with_thin_parts(block).value(), Mesh::with_thin_parts(bar).value(), open).value();
  ASSERT_EQ(sum.tight_segments.size(), 1u);
  EXPECT_TRUE(sum.tight_faces.empty());
}

TEST(ThinPairs, that_can_cross_have_no_open_sum) {
  const Mesh plate = Mesh::with_thin_parts({{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, {{0, 1, 2, 3}}}).value();
  const Mesh wires = Mesh::with_thin_parts({{{0, 0, 0}, {1, 1, 0}, {1, 1, 3}}, {{0, 1}, {1, 2}}}).value();
  SpatialOptions open;
  open.semantics = Semantics::open;
  const Error error = minkowski_sum(plate, wires, open).error();
  EXPECT_EQ(error.code, ErrorCode::unsupported_operand);
  EXPECT_EQ(error.evidence.face, 0);
  EXPECT_EQ(error.evidence.other_face, 1) << "the upright one";
  const Error reversed = minkowski_sum(wires, plate, open).error();
  EXPECT_EQ(reversed.evidence.face, 1);
  EXPECT_EQ(reversed.evidence.other_face, 0);
  EXPECT_EQ(contains(plate, wires, {0, 0, 1}, Semantics::open).error().code, ErrorCode::unsupported_operand);
  EXPECT_EQ(minkowski_sum(plate, wires).value().volume_exact(), 12) << "what they sweep";
}

TEST(ThinPairs, a_solid_inside_another_one_overlaps_it_also_where_it_touches_a_wire) {
  // In a large cube lies a wire; a small cube within the large one touches it.
  MeshData large = solids::box(-9, -9, -9, 9, 9, 9).data();
  large.vertices.insert(large.vertices.end(), {{0, 0, 0}, {1, 0, 0}});
  large.faces.push_back({8, 9});
  const Mesh q = Mesh::with_thin_parts(large).value(), small = solids::box(0, 0, 0, 1, 1, 1);
  EXPECT_TRUE(contains(small, q, {0, 0, 0}, Semantics::open).value());
  EXPECT_TRUE(contains(small, q, {1, 0, 0}, Semantics::open).value());
  EXPECT_TRUE(contains(q, small, {1, 1, 1}, Semantics::open).value());
  EXPECT_FALSE(contains(small, q, {10, 0, 0}, Semantics::open).value());
}

}  // namespace
}  // namespace dymsum
