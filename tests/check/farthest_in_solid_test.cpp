// The furthest position of a solid from another one: where it is known, by many positions, and by each triangle.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "check/near_triangles.h"
#include "dymsum/penetration_depth.h"
#include "dymsum/set_check.h"
#include "dymsum/solid_union.h"
#include "dymsum/solids.h"
#include "oracles/random.h"
#include "oracles/sanitized.h"

namespace dymsum::oracles {
namespace {

using check::NearTriangles;
using check::RationalVector;
using exact::BigRational;
using spatial::Vec3;

Rational fraction(std::int64_t num, std::int64_t den = 1) { return *Rational::of(num, den); }
Mesh cube(double size) { return solids::box(0, 0, 0, size, size, size); }
const Mesh& origin() {
  static const Mesh point = *Mesh::with_thin_parts({{{0, 0, 0}}, {{0}}});
  return point;
}

/// A solid turned by about 30 degrees about each axis, its coordinates rounded.
Mesh turned(const Mesh& mesh, bool single) {
  const double c = std::cos(M_PI / 6), s = 0.5;
  MeshData data = triangulated(mesh).mesh.data();
  for (Point3& p : data.vertices) {
    p = {c * p.x - s * p.y, s * p.x + c * p.y, p.z};
    p = {p.x, c * p.y - s * p.z, s * p.y + c * p.z};
    if (single) p = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
  }
  return *Mesh::create(std::move(data));
}

TEST(FarthestInSolid, ASlotIsFilledUpToItsMiddle) {
  // Furthest are all positions of a rectangle between its walls.
  const SpatialSum slotted = *difference(cube(10), solids::box(2, -1, 3, 3, 11, 11));
  const SolidSetCheck check = *check_set(slotted, cube(10));
  EXPECT_TRUE(check.contains() == true && check.surplus.exact);
  EXPECT_EQ(check.surplus.squared, fraction(1, 4));
  EXPECT_EQ(check.surplus.at.x, fraction(5, 2));
  EXPECT_EQ(check.within(fraction(1, 2)), CheckVerdict::right);
  EXPECT_EQ(check.within(fraction(499999, 1000000)), CheckVerdict::wrong);
}

TEST(FarthestInSolid, ACavityIsFilledUpToItsInside) {
  const SpatialSum hollow = *difference(cube(10), solids::box(2, 2, 2, 5, 6, 7));
  const SolidSetCheck check = *check_set(hollow, cube(10));
  EXPECT_TRUE(check.surplus.exact);
  EXPECT_EQ(check.surplus.squared, fraction(9, 4));
  EXPECT_EQ(check.surplus.distance, 1.5);
}

TEST(FarthestInSolid, ACentreThatIsNoFractionIsBoundedClosely) {
  // The largest ball in the tetrahedron of the axes: its radius is 6 / (3 + sqrt 3) for sides of 6.
  const Mesh tetrahedron =
      *Mesh::create({{{1, 1, 1}, {7, 1, 1}, {1, 7, 1}, {1, 1, 7}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}});
  const SolidSetCheck check = *check_set(*difference(cube(10), tetrahedron), cube(10));
  const double radius = 6 / (3 + std::sqrt(3.0));
  EXPECT_FALSE(check.surplus.exact);
  EXPECT_LE(check.surplus.distance, radius * (1 + 0x1p-50));
  EXPECT_GE(check.surplus.at_most, radius * (1 - 0x1p-50));
  EXPECT_LE(check.surplus.at_most - check.surplus.distance, 0x1p-29 * radius);
  EXPECT_EQ(check.within(fraction(1267, 1000)), CheckVerdict::wrong);
  EXPECT_EQ(check.within(fraction(1268, 1000)), CheckVerdict::right);
}

/// Positions of `a` on a grid, and how far they are from b: no further than the bound says; and the furthest position
/// is one of a, as far as it says.
void expect_furthest(const SpatialSum& a, const SpatialSum& b, const SolidExcess& excess, double step) {
  EXPECT_GE(excess.at_most, excess.distance);
  // Where sets differ by rounding to single precision alone, slivers end the work before the bound is close.
  if (excess.distance > 0x1p-20) {
    EXPECT_LE(excess.at_most, excess.distance * (1 + 0x1p-29));
  }
  if (excess.set.faces.empty()) return;
  SolidDepth depth = *SolidDepth::create(b, origin());
  EXPECT_TRUE(*contains(excess.set, origin(), excess.at));
  EXPECT_EQ(depth.at(excess.at).squared, excess.squared);
  std::vector<RationalPoint3> grid;
  for (double x = -4; x <= 4; x += step)
    for (double y = -4; y <= 4; y += step)
      for (double z = -4; z <= 4; z += step) grid.push_back({*Rational::of(x), *Rational::of(y), *Rational::of(z)});
  const std::vector<bool> inside = *contains_each(a, origin(), grid);
  for (std::size_t k = 0; k < grid.size(); ++k) {
    if (!inside[k]) continue;
    const SolidDistance d = depth.at(grid[k]);
    if (d.meeting == Meeting::apart) {
      EXPECT_LE(d.distance, excess.at_most * (1 + 0x1p-50));
    }
  }
}

TEST(FarthestInSolid, OfManyBoxesNoPositionIsFurther) {
  // Boxes on a small grid: faces and edges coincide, and whole faces are equally far.
  Random random(20261130);
  int inside = 0;
  for (int round = 0; round < rounds(16); ++round) {
    SCOPED_TRACE(round);
    const auto corner = [&] { return random.below(7) - 3.0; };
    const auto solid = [&] {
      std::vector<Mesh> parts;
      for (int k = 0; k < 3; ++k) {
        const double x = corner(), y = corner(), z = corner();
        parts.push_back(solids::box(x, y, z, x + 1 + random.below(3), y + 1 + random.below(2), z + 0.5));
      }
      return *united(parts);
    };
    const SpatialSum a = solid(), b = solid();
    const SolidSetCheck check = *check_set(a, b);
    expect_furthest(a, b, check.missing, 1.3);
    expect_furthest(b, a, check.surplus, 1.3);
    inside += !check.missing.exact;
  }
  EXPECT_LT(inside, rounds(16));
}

TEST(FarthestInSolid, OfTurnedBodiesNoPositionIsFurther) {
  for (const bool single : {false, true}) {
    const SpatialSum slotted = *difference(turned(solids::box(-2, -2, -2, 2, 2, 2), single),
                                           turned(solids::box(-1, -1, -1, 1.5, 1, 3), single));
    const SpatialSum shifted = *united(std::vector<Mesh>{turned(solids::box(-2, -2, -2, 2, 2, -1), single),
                                                         turned(solids::box(-2, -2, -2, -1, 2, 2), single)});
    const SolidSetCheck check = *check_set(slotted, shifted);
    expect_furthest(slotted, shifted, check.missing, 1.9);
    expect_furthest(shifted, slotted, check.surplus, 1.9);
  }
}

TEST(FarthestInSolid, NearestTrianglesAreThoseOfAll) {
  Random random(7);
  const Mesh star = turned(solids::triakis_icosahedron(2), false);
  const spatial::ExactSet set = spatial::exact_set(star.data());
  const NearTriangles near(set, 4);
  for (int round = 0; round < rounds(60); ++round) {
    Vec3 p{4 * random.signed_unit(), 4 * random.signed_unit(), 4 * random.signed_unit()};
    if (round % 3 == 0) {  // a vertex: as far from several
      const Point3& v = star.data().vertices[static_cast<std::size_t>(random.below(32))];
      p = {v.x, v.y, v.z};
    }
    const RationalVector at{exact::exact_value(p.x), exact::exact_value(p.y), exact::exact_value(p.z)};
    std::optional<BigRational> least;
    for (std::uint32_t t = 0; t < set.set.faces.size(); ++t) {
      const BigRational squared = check::nearest_on(at, near.exact(t)).squared;
      const BigRational above = exact::exact_value(near.distance_above(p, t));
      EXPECT_LE(squared, above * above);
      EXPECT_LE(above, exact::exact_value(exact::root_to_double(squared) * (1 + 0x1p-40) + 2 * near.slack()));
      if (!least || squared < *least) least = squared;
    }
    EXPECT_EQ(near.nearest(at, p).squared, *least);
    const double rough = near.distance_above(p, near.rough_nearest(p));
    EXPECT_LE(rough, exact::root_to_double(*least) * (1 + 0x1p-40) + 2 * near.slack());
  }
}

}  // namespace
}  // namespace dymsum::oracles
