// Results as operands: what is tight in an inner fit counts in the next operation, in every form that results have.
#include <gtest/gtest.h>

#include <random>

#include "dymsum/solid_erosion.h"
#include "dymsum/solid_offset.h"
#include "dymsum/solid_sum_io.h"
#include "dymsum/solid_union.h"
#include "dymsum/solids.h"
#include "dymsum/spatial_operand.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/sanitized.h"
#include "oracles/voxel_solids.h"
#include "spatial/sum/random_solids.h"
#include "spatial/sum/solid_cases.h"
#include "spatial/sum/tested_sums.h"

namespace dymsum {
namespace {

using oracles::LatticeCells;
using oracles::Voxel;
using oracles::Voxels;

const Mesh kOnePoint = Mesh::with_thin_parts({{{0, 0, 0}}, {{0}}}).value();

/// The regular part of a set, as a result.
SpatialSum as_result(const Mesh& mesh) { return united(std::span(&mesh, 1)).value(); }

std::size_t tight_count(const SpatialSum& s) {
  return s.tight_faces.size() + s.tight_segments.size() + s.tight_points.size();
}

/// A plate 10 x 6 x 2 with a slot 1 wide through it from above, a blade that just fits into the slot, and what fits.
struct Slot {
  Mesh plate = [] {
    Voxels voxels;
    for (int x = 0; x < 10; ++x)
      for (int y = 0; y < 6; ++y)
        for (int z = 0; z < 2; ++z)
          if (y < 2 || y > 3 || z == 0) voxels.insert({x, y, z});
    return Mesh::create(oracles::voxel_mesh(voxels)).value();
  }();
  Mesh tool = solids::box(0, 0, 0, 1, 2, 2);  // as wide and as high as the walls
  SpatialSum fit = erode(plate, tool).value();
};

TEST(ResultOperands, a_tool_that_just_fits_keeps_what_it_reaches) {
  const Slot slot;
  ASSERT_EQ(slot.fit.tight_segments.size(), 2u) << "along both walls";
  ASSERT_TRUE(slot.fit.faces.empty());
  const SpatialSum again = minkowski_sum(slot.fit, slot.tool).value();
  EXPECT_EQ(again.volume_exact(), 2 * 10 * 2 * 2);
  EXPECT_EQ(again, opening(slot.plate, slot.tool).value().solid);
  EXPECT_EQ(minkowski_sum(slot.tool, slot.fit).value(), again);
  EXPECT_EQ(minkowski_sum(slot.fit, as_result(slot.tool)).value(), again);
  const SpatialSum read = parse_solid_sum(solid_sum_to_json(slot.fit), "fit").value();
  EXPECT_EQ(minkowski_sum(read, slot.tool).value(), again);
  SpatialOptions regular;
  regular.semantics = Semantics::regular;
  EXPECT_TRUE(minkowski_sum(slot.fit, slot.tool, regular).value().faces.empty()) << "the regular part is empty";
}

TEST(ResultOperands, a_position_without_room_is_part_of_the_set) {
  const Slot slot;
  const auto at = [](int x, int y, int z) {
    return RationalPoint3{*Rational::of(x, 2), *Rational::of(y, 2), *Rational::of(z, 2)};
  };
  EXPECT_TRUE(contains(slot.fit, kOnePoint, at(3, 0, 0)).value());
  EXPECT_TRUE(contains(slot.fit, kOnePoint, at(3, 8, 0)).value());
  EXPECT_FALSE(contains(slot.fit, kOnePoint, at(3, 1, 0)).value());
  EXPECT_TRUE(contains(slot.fit, slot.tool, at(3, 1, 1)).value());
  EXPECT_TRUE(contains(slot.fit, slot.tool, at(3, 1, 1), Semantics::open).value()) << "inside of what is swept";
  EXPECT_FALSE(contains(slot.fit, slot.tool, at(3, 5, 1)).value());
}

TEST(ResultOperands, what_is_tight_within_a_sum_adds_nothing) {
  // A block with a tunnel, swept by the peg that fits: the way through is tight, and inside of the closed sum.
  const Mesh block = Mesh::create(tunnel()).value(), peg = solids::box(-9, -1, -1, 9, 1, 1);
  const SpatialSum swept = minkowski_sum(block, peg).value();
  ASSERT_GT(tight_count(swept), 0u);
  const Mesh cube = solids::box(0, 0, 0, 1, 1, 1);
  EXPECT_EQ(minkowski_sum(swept, cube).value(), minkowski_sum(as_mesh(swept).value(), cube).value());
  EXPECT_EQ(tight_count(minkowski_sum(swept, kOnePoint).value()), 0u);
}

Voxels random_set(const Voxel& size, int fraction, std::mt19937_64& random) {
  Voxels set;
  for (int x = 0; x < size[0]; ++x)
    for (int y = 0; y < size[1]; ++y)
      for (int z = 0; z < size[2]; ++z)
        if (static_cast<int>(random() % 100) < fraction) set.insert({x, y, z});
  if (set.empty()) set.insert({0, 0, 0});
  return set;
}

/// Whether closed cells lie in a union of closed cubes: the doubled box around `at` + b, half cells counted as whole.
bool holds(const Voxels& a, const LatticeCells& b, const Voxel& at) {
  const auto in_a = [&](const Voxel& cell) {
    for (int k = 0; k < 8; ++k) {
      Voxel v;
      for (int i = 0; i < 3; ++i) {
        const bool odd = cell[i] % 2 != 0;
        v[i] = odd ? (cell[i] - 1) / 2 : cell[i] / 2 - ((k >> i) & 1);
        if (odd && cell[i] < 0) v[i] = (cell[i] - 1) / 2;
      }
      if (a.contains(v)) return true;
    }
    return false;
  };
  for (const Voxel& c : b) {
    Voxel low, high;
    for (int i = 0; i < 3; ++i) {
      const int half = std::abs(c[i] % 2);
      low[i] = at[i] + c[i] - half, high[i] = at[i] + c[i] + half;
    }
    for (int x = low[0]; x <= high[0]; ++x)
      for (int y = low[1]; y <= high[1]; ++y)
        for (int z = low[2]; z <= high[2]; ++z)
          if (!in_a({x, y, z})) return false;
  }
  return true;
}

LatticeCells closed_cells(const Voxels& voxels) {
  LatticeCells cells;
  for (const Voxel& v : voxels) cells.insert({2 * v[0] + 1, 2 * v[1] + 1, 2 * v[2] + 1});
  return cells;
}

/// The closed cells of the inner fit, by definition.
LatticeCells lattice_fit(const Voxels& a, const LatticeCells& b) {
  LatticeCells fit;
  for (int x = -8; x <= 8; ++x)
    for (int y = -8; y <= 8; ++y)
      for (int z = -8; z <= 8; ++z)
        if (holds(a, b, {x, y, z})) fit.insert({x, y, z});
  return fit;
}

void expect_size(const SpatialSum& made, const oracles::VoxelSum& expected, const std::string& seed) {
  EXPECT_EQ(made.volume_exact(), static_cast<std::int64_t>(expected.volume)) << seed;
  EXPECT_EQ(tight_area(made), static_cast<double>(expected.tight_faces)) << seed;
  double edges = 0;
  for (const auto& segment : made.tight_segments) edges += length(made, segment);
  EXPECT_EQ(edges, static_cast<double>(expected.tight_edges)) << seed;
  EXPECT_EQ(made.tight_points.size(), expected.tight_points) << seed;
}

TEST(ResultOperands, sums_of_two_inner_fits_are_those_of_lattice_cells) {
  int both_tight = 0;
  for (int k = 0; k < fuzz_pairs(oracles::rounds(16, 3)); ++k) {
    std::mt19937_64 random(static_cast<std::uint64_t>(900 + k));
    const Voxels a = random_set({3, 3, 2}, 85, random), b = random_set({1, 2, 1}, 70, random),
                 c = random_set({3, 2, 2}, 90, random), d = random_set({2, 1, 1}, 70, random);
    const auto mesh = [](const Voxels& v) { return Mesh::create(oracles::voxel_mesh(v)); };
    const Result<Mesh> ma = mesh(a), mb = mesh(b), mc = mesh(c), md = mesh(d);
    if (!ma || !mb || !mc || !md) continue;
    const std::string seed = "seed " + std::to_string(900 + k);
    const SpatialSum first = erode(*ma, *mb).value(), second = erode(*mc, *md).value();
    const LatticeCells p = lattice_fit(a, closed_cells(b)), q = lattice_fit(c, closed_cells(d));
    const oracles::VoxelSum expected = p.empty() || q.empty() ? oracles::VoxelSum{} : oracles::closed_lattice_sum(p, q);
    const SpatialSum made = minkowski_sum(first, second).value();
    const bool thin = tight_count(first) > 0 && tight_count(second) > 0;
    if (thin) expect_size(made, expected, seed);
    else EXPECT_EQ(made.volume_exact(), static_cast<std::int64_t>(expected.volume)) << seed;
    EXPECT_EQ(made, minkowski_sum(second, first).value()) << seed;
    both_tight += thin;
  }
  EXPECT_GT(both_tight, oracles::rounds(3, 1));
}

TEST(ResultOperands, parts_without_volume_fit_where_all_of_them_do) {
  int tight = 0;
  for (int k = 0; k < fuzz_pairs(oracles::rounds(16, 4)); ++k) {
    std::mt19937_64 random(static_cast<std::uint64_t>(1200 + k));
    const Voxels a = random_set({3, 3, 2}, 80, random);
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<std::uint64_t>(n)); };
    LatticeCells b;
    if (k % 2 == 0) b.insert({1, 1, 1});
    for (int j = 0; j < 1 + k % 3; ++j) b.insert({below(4), below(4), below(3)});
    const Result<Mesh> p = Mesh::create(oracles::voxel_mesh(a)), q = Mesh::with_thin_parts(oracles::lattice_mesh(b));
    if (!p || !q) continue;
    const std::string seed = "seed " + std::to_string(1200 + k);
    const LatticeCells fits = lattice_fit(a, b);
    const SpatialSum made = erode(*p, *q).value();
    const oracles::VoxelSum expected =
        fits.empty() ? oracles::VoxelSum{} : oracles::closed_lattice_sum(fits, LatticeCells{{0, 0, 0}});
    expect_size(made, expected, seed);
    tight += tight_count(made) > 0;
    if (!fits.empty()) {
      const SpatialSum opened = opening(*p, *q).value().solid;
      const oracles::VoxelSum all = oracles::closed_lattice_sum(fits, b);
      EXPECT_EQ(opened.volume_exact(), static_cast<std::int64_t>(all.volume)) << seed;
    }
  }
  EXPECT_GT(tight, oracles::rounds(3, 1));
}

TEST(ResultOperands, what_is_tight_holds_no_solid) {
  const Slot slot;
  const Mesh crumb = solids::box(0, 0, 0, 0.25, 0.25, 0.25);
  EXPECT_EQ(erode(slot.fit, crumb).value(), SpatialSum());
  const Error both = erode(slot.fit, slot.fit).error();
  EXPECT_EQ(both.code, ErrorCode::unsupported_operand);
  EXPECT_NE(both.message.find("both operands"), std::string::npos);
}

TEST(ResultOperands, erosion_by_what_is_tight_is_that_by_its_parts) {
  const Slot slot;
  // by two segments 9 long and 4 apart: A eroded by one of them, twice
  const Mesh large = solids::box(0, 0, 0, 20, 20, 5);
  EXPECT_EQ(erode(large, slot.fit).value().volume_exact(), 11 * 16 * 5);
  const SpatialSum opened = opening(large, slot.fit).value().solid;
  EXPECT_EQ(opened.volume_exact(), 20 * 20 * 5);
}

class ResultKinds : public testing::TestWithParam<CoordinateKind> {};

TEST_P(ResultKinds, a_solid_fits_into_itself_in_one_position_which_counts) {
  std::mt19937_64 random(static_cast<std::uint64_t>(GetParam()) + 77);
  int made = 0;
  for (int k = 0; k < oracles::rounds(2, 2); ++k) {
    SCOPED_TRACE(k);
    const Result<Mesh> p = Mesh::create(of_kind(random_solids::valid_polyhedron(random).data(), GetParam(), random)),
                       q = Mesh::create(of_kind(random_solids::valid_polyhedron(random).data(), GetParam(), random));
    if (!p || !q) continue;
    const SpatialSum position = erode(*p, *p).value();
    ASSERT_EQ(position.tight_points.size(), 1u);
    EXPECT_EQ(position.exact(position.tight_points[0]), RationalPoint3{});
    const SpatialSum again = minkowski_sum(position, *p).value();
    EXPECT_EQ(again, minkowski_sum(kOnePoint, *p).value());
    EXPECT_EQ(again.volume_exact(), as_result(*p).volume_exact());
    // and in fractions: their sum fits into itself
    const SpatialSum both = minkowski_sum(*p, *q).value();
    const SpatialSum there = erode(both, both).value();
    ASSERT_EQ(there.tight_points.size(), 1u);
    EXPECT_EQ(minkowski_sum(there, both).value().volume_exact(), both.volume_exact());
    ++made;
  }
  EXPECT_GT(made, 0);
}

TEST_P(ResultKinds, opening_is_the_sum_with_what_fits) {
  std::mt19937_64 random(static_cast<std::uint64_t>(GetParam()) + 99);
  int tight = 0;
  for (int k = 0; k < oracles::rounds(3, 3); ++k) {
    SCOPED_TRACE(k);
    const Result<Mesh> a =
        Mesh::create(of_kind(triangulated(Mesh::create(ell()).value()).mesh.data(), GetParam(), random));
    if (!a) continue;
    // a piece of it, which fits in one position at least
    const std::array<double, 6> box = bounds(*a);
    const Result<Mesh> b = translated(*a, -box[0], 0, 0);
    if (!b) continue;
    const Result<SpatialSum> fit = erode(*a, *b);
    if (!fit) continue;
    EXPECT_EQ(opening(*a, *b).value().solid, minkowski_sum(*fit, *b).value());
    const SpatialSum read = parse_solid_sum(solid_sum_to_json(*fit), "fit").value();
    EXPECT_EQ(minkowski_sum(read, *b).value(), minkowski_sum(*fit, *b).value());
    tight += tight_count(*fit) > 0;
  }
  if (GetParam() == CoordinateKind::grid) {
    EXPECT_GT(tight, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, ResultKinds, testing::ValuesIn(kCoordinateKinds),
                         [](const auto& parameter) { return test_name_of(parameter.param); });

TEST(ResultOperands, are_taken_by_boolean_operations) {
  const Mesh a =
      Mesh::create({{{0, 0, 0}, {7, 0, 0}, {0, 5, 0}, {0, 0, 3}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}})
          .value();
  const Mesh b = solids::box(0, 0, 0, 0.25, 0.25, 0.25);
  const SpatialSum inner = erode(a, b).value();  // sevenths and fifths
  ASSERT_FALSE(as_mesh(inner).ok());
  EXPECT_EQ(intersection(inner, a).value(), intersection(a, inner).value());
  EXPECT_EQ(intersection(inner, a).value().volume_exact(), inner.volume_exact());
  EXPECT_TRUE(difference(inner, a).value().faces.empty());
  const SpatialSum shell = difference(a, inner).value();
  EXPECT_EQ(shell.volume_exact() + inner.volume_exact(), as_result(a).volume_exact());
  EXPECT_EQ(symmetric_difference(inner, a).value(), shell);
  const SpatialOperand both[]{shell, inner};
  SpatialOptions regular;
  regular.semantics = Semantics::regular;
  EXPECT_EQ(united(both, regular).value(), as_result(a));
  EXPECT_FALSE(united(both).value().tight_faces.empty()) << "the wall between two open sets";
  EXPECT_TRUE(intersection(both).value().faces.empty());
  EXPECT_EQ(difference(a, std::span(both), regular).value(), SpatialSum());
  EXPECT_TRUE(difference(a, std::span(both)).value().faces.empty());
  EXPECT_EQ(offset(inner, -0.125, 0.03).value().solid.shells, 1u);
}

}  // namespace
}  // namespace dymsum
