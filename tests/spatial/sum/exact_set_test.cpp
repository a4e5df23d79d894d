// Sets with fractions for vertices as operands: nothing is rounded between operations, on all kinds of coordinates.
#include "spatial/sum/exact_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "dymsum/solid_erosion.h"
#include "dymsum/solids.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/sanitized.h"
#include "spatial/sum/random_solids.h"
#include "spatial/sum/solid_cases.h"

namespace dymsum {
namespace {

/// The least common denominator of a sum's vertices, where it is below 2^30; else 0.
std::int64_t common_denominator(const SpatialSum& sum) {
  std::int64_t all = 1;
  for (std::size_t v = 0; v < sum.vertices.size(); ++v) {
    const RationalPoint3 at = sum.exact(v);
    for (const Rational& c : {at.x, at.y, at.z}) {
      const std::string below = c.denominator();
      if (below.size() > 9) return 0;
      all = std::lcm(all, std::stoll(below));
      if (all >= std::int64_t{1} << 30) return 0;
    }
  }
  return all;
}

Mesh times(const Mesh& mesh, std::int64_t by) {
  const auto factor = static_cast<double>(by);
  return scaled(mesh, factor, factor, factor).value();
}

/// `small` times `by` is `large`, vertex by vertex, and all that is tight.
void expect_scaled(const SpatialSum& small, const SpatialSum& large, std::int64_t by) {
  const Rational factor = *Rational::of(by, 1);
  ASSERT_EQ(small.vertices.size(), large.vertices.size());
  for (std::size_t v = 0; v < small.vertices.size(); ++v) {
    const RationalPoint3 at = small.exact(v);
    EXPECT_EQ((RationalPoint3{at.x * factor, at.y * factor, at.z * factor}), large.exact(v));
    EXPECT_NEAR(small.vertices[v].x, at.x.to_double(), small.at_error);
  }
  const SpatialSum::Rounded drawn = small.drawn();
  for (std::size_t v = 0; v < drawn.vertex.size(); ++v) {
    const RationalPoint3 at = small.exact(drawn.vertex[v]);
    EXPECT_EQ(drawn.mesh.vertices[v], (Point3{at.x.to_double(), at.y.to_double(), at.z.to_double()}))
        << "the nearest doubles";
  }
  ASSERT_EQ(small.faces.size(), large.faces.size());
  for (std::size_t f = 0; f < small.faces.size(); ++f) EXPECT_EQ(small.faces[f].loops, large.faces[f].loops);
  EXPECT_EQ(small.tight_faces, large.tight_faces);
  EXPECT_EQ(small.tight_segments, large.tight_segments);
  EXPECT_EQ(small.tight_points, large.tight_points);
  EXPECT_EQ(small.volume_exact() * factor * factor * factor, large.volume_exact());
}

TEST(ExactSets, openings_and_closings_are_those_of_larger_solids_in_doubles) {
  std::mt19937_64 random(7);
  int openings = 0, closings = 0;
  for (int k = 0; k < oracles::rounds(120); ++k) {
    SCOPED_TRACE(k);
    const Mesh a = times(random_solids::valid_polyhedron(random), 3), b = random_solids::valid_polyhedron(random);
    const std::int64_t inside = common_denominator(erode(a, b).value());
    if (inside > 1) {
      ++openings;
      expect_scaled(opening(a, b).value().solid, opening(times(a, inside), times(b, inside)).value().solid, inside);
    }
    const std::int64_t outside = common_denominator(minkowski_sum(a, b).value());
    if (outside > 1) {
      ++closings;
      expect_scaled(closing(a, b).value().solid, closing(times(a, outside), times(b, outside)).value().solid, outside);
    }
  }
  EXPECT_GT(openings, oracles::rounds(10));
  EXPECT_GT(closings, oracles::rounds(10));
}

class ExactSetKinds : public testing::TestWithParam<CoordinateKind> {};

TEST_P(ExactSetKinds, three_operands_are_added_in_any_order) {
  std::mt19937_64 random(static_cast<std::uint64_t>(GetParam()) + 11);
  int fractions = 0;
  for (int k = 0; k < oracles::rounds(3, 3); ++k) {
    SCOPED_TRACE(k);
    std::vector<Mesh> operands;
    while (operands.size() < 3) {
      const Result<Mesh> made =
          Mesh::create(of_kind(random_solids::valid_polyhedron(random).data(), GetParam(), random));
      if (made) operands.push_back(*made);
    }
    const Result<SpatialSum> sum = minkowski_sum(operands);
    ASSERT_TRUE(sum.ok()) << sum.error().to_string();
    fractions += !as_mesh(minkowski_sum(operands[0], operands[1]).value()).ok();
    std::rotate(operands.begin(), operands.begin() + 1, operands.end());
    EXPECT_EQ(minkowski_sum(operands).value(), *sum);
    std::swap(operands[0], operands[1]);
    EXPECT_EQ(minkowski_sum(operands).value(), *sum);
  }
  EXPECT_GT(fractions, 0);
}

TEST_P(ExactSetKinds, sums_are_operands) {
  std::mt19937_64 random(static_cast<std::uint64_t>(GetParam()) + 21);
  const auto next = [&] {
    while (true)
      if (Result<Mesh> made = Mesh::create(of_kind(random_solids::valid_polyhedron(random).data(), GetParam(), random)))
        return *made;
  };
  int compared = 0;
  for (int k = 0; k < oracles::rounds(3, 3); ++k) {
    SCOPED_TRACE(k);
    const Mesh p = next(), q = next(), r = next();
    const Result<SpatialSum> left = minkowski_sum(minkowski_sum(p, q).value(), r),
                             right = minkowski_sum(minkowski_sum(q, r).value(), p);
    if (!left || !right) continue;
    ++compared;
    EXPECT_EQ(*left, *right);
    const Result<SpatialSum> less = erode(minkowski_sum(p, q).value(), q);
    const Result<SolidOpening> closed = closing(p, q);
    ASSERT_EQ(less.ok(), closed.ok());
    if (less) {
      EXPECT_EQ(*less, closed->solid);
    }
  }
  EXPECT_GT(compared, 0);
}

TEST(ExactSets, nothing_is_an_operand) {
  const SpatialSum nothing = erode(solids::box(0, 0, 0, 1, 1, 1), solids::box(0, 0, 0, 2, 2, 2)).value();
  EXPECT_TRUE(minkowski_sum(nothing, solids::box(0, 0, 0, 1, 1, 1)).value().faces.empty());
  EXPECT_TRUE(minkowski_sum(nothing, nothing).value().faces.empty());
  EXPECT_TRUE(erode(nothing, solids::box(0, 0, 0, 1, 1, 1)).value().faces.empty());
}

TEST_P(ExactSetKinds, openings_lie_inside_and_closings_outside) {
  std::mt19937_64 random(static_cast<std::uint64_t>(GetParam()) + 5);
  const MeshData parts = triangulated(Mesh::create(ell()).value()).mesh.data();
  int made = 0;
  for (int k = 0; k < oracles::rounds(3, 3); ++k) {
    SCOPED_TRACE(k);
    const Result<Mesh> a = Mesh::create(of_kind(parts, GetParam(), random)),
                       b = Mesh::create(of_kind(random_solids::valid_polyhedron(random).data(), GetParam(), random));
    if (!a || !b) continue;
    const Mesh small = scaled(*b, 0.125, 0.125, 0.125).value();
    const Result<SolidOpening> opened = opening(*a, small), closed = closing(*a, small);
    if (!opened || !closed) continue;
    ++made;
    EXPECT_EQ(opened->moved, 0);
    EXPECT_EQ(closed->moved, 0);
    const std::vector<Mesh> alone{*a};
    const Rational volume = minkowski_sum(alone).value().volume_exact();
    EXPECT_LE(opened->solid.volume_exact(), volume);
    EXPECT_GE(closed->solid.volume_exact(), volume);
  }
  EXPECT_GT(made, 0);
}

INSTANTIATE_TEST_SUITE_P(Kinds, ExactSetKinds, testing::ValuesIn(kCoordinateKinds),
                         [](const auto& parameter) { return test_name_of(parameter.param); });

/// Doubles next to the exact positions.
void round_vertices(spatial::ExactSet& set) {
  for (std::size_t v = 0; v < set.at.size(); ++v) {
    const auto c = [&](std::size_t axis) { return exact::round_to_double(set.at[v][axis]); };
    set.set.vertices[v] = {c(0), c(1), c(2)};
  }
}

/// All denominators of a turned rod's inner fit together have tens of thousands of bits.
TEST(ExactSets, of_long_denominators_have_their_own) {
  std::mt19937_64 random(1);
  const auto turned_rod = [&](int sides, double radius, double height) {
    return Mesh::create(of_kind(solids::cylinder(sides, radius, height).data(), CoordinateKind::turned, random))
        .value();
  };
  const Mesh rod = turned_rod(24, 0.5, 2), small = turned_rod(5, 0.2, 0.3);
  const SolidOpening opened = opening(rod, small).value();
  EXPECT_EQ(opened.moved, 0);
  const SpatialSum inner = erode(rod, small).value();
  EXPECT_EQ(erode(opened.solid, small).value(), inner) << "what fits in an opening is what fitted";
  EXPECT_LE(opened.solid.volume(), minkowski_sum(std::vector<Mesh>{rod}).value().volume());
}

/// Sums of fractions against sums of integers over their common denominator.
TEST_P(ExactSetKinds, fractions_give_what_integers_give) {
  std::mt19937_64 random(static_cast<std::uint64_t>(GetParam()) + 29);
  int compared = 0;
  for (int k = 0; k < oracles::rounds(40, 8); ++k) {
    SCOPED_TRACE(k);
    const Result<Mesh> a = Mesh::create(of_kind(random_solids::valid_polyhedron(random).data(), GetParam(), random)),
                       b = Mesh::create(of_kind(random_solids::valid_polyhedron(random).data(), GetParam(), random));
    if (!a || !b) continue;
    spatial::ExactSet p = spatial::exact_set(a->data()), q = spatial::exact_set(b->data());
    const exact::BigRational third(1, static_cast<int>(3 + 2 * (random() % 50)));
    for (spatial::ExactSet* set : {&p, &q})
      for (spatial::ExactPosition& at : set->at)
        for (exact::BigRational& c : at) c *= third;
    for (spatial::ExactSet* set : {&p, &q}) round_vertices(*set);
    const SpatialSum integers = spatial::sum_of_exact_sets(p, q, {}, 4000).value(),
                     fractions = spatial::sum_of_exact_sets(p, q, {}, 1).value();
    EXPECT_EQ(integers, fractions);
    for (std::size_t v = 0; v < integers.vertices.size(); ++v)
      EXPECT_NEAR(integers.vertices[v].x, fractions.vertices[v].x, integers.at_error + fractions.at_error);
    for (std::size_t f = 0; f < integers.faces.size(); ++f) {
      EXPECT_EQ(integers.faces[f].p, fractions.faces[f].p);
      EXPECT_EQ(integers.faces[f].shell, fractions.faces[f].shell);
    }
    ++compared;
  }
  EXPECT_GT(compared, 3);
}

/// Denominators that are multiples of the prime of residues.
TEST(ExactSets, of_denominators_without_residues) {
  const exact::BigRational unit(1, (exact::BigInteger(1) << 61) - 1);
  const auto in_units = [&](const Mesh& mesh) {
    spatial::ExactSet set = spatial::exact_set(mesh.data());
    for (spatial::ExactPosition& at : set.at)
      for (exact::BigRational& c : at) c *= unit;
    round_vertices(set);
    return set;
  };
  const Mesh p = Mesh::create(ell()).value(), q = Mesh::create(tunnel()).value();
  const SpatialSum integers = spatial::sum_of_exact_sets(in_units(p), in_units(q), {}, 4000).value(),
                   fractions = spatial::sum_of_exact_sets(in_units(p), in_units(q), {}, 1).value();
  EXPECT_EQ(integers, fractions);
  EXPECT_EQ(fractions.faces.size(), minkowski_sum(p, q).value().faces.size());
}

}  // namespace
}  // namespace dymsum
