// Slices of results whose vertices are fractions are those of the same solids in integers, divided by the scale.
#include <gtest/gtest.h>

#include "dymsum/solid_slice.h"
#include "dymsum/solids.h"
#include "oracles/random.h"
#include "oracles/sanitized.h"
#include "oracles/scaled_solid.h"

namespace dymsum::oracles {
namespace {

using exact::BigInteger;
using exact::BigRational;

/// All corners of a section, as they are listed, times a number.
std::vector<std::array<BigRational, 2>> corners_of(const SolidSlice& slice, const BigInteger& by) {
  std::vector<std::array<BigRational, 2>> all;
  const auto add = [&](const SumVertex& v) {
    const RationalPoint at = slice.section.exact(v);
    EXPECT_LE(std::abs(v.at.x - at.x.to_double()), slice.section.at_error + 1e-300);
    EXPECT_LE(std::abs(v.at.y - at.y.to_double()), slice.section.at_error + 1e-300);
    all.push_back({exact::exact_value(at.x) * by, exact::exact_value(at.y) * by});
  };
  for (const SumPart& part : slice.section.parts) {
    for (const SumVertex& v : part.outer.vertices) add(v);
    for (const SumRing& hole : part.holes)
      for (const SumVertex& v : hole.vertices) add(v);
  }
  for (const SumSegment& s : slice.section.segments) add(s.from), add(s.to);
  for (const SumVertex& v : slice.section.points) add(v);
  for (const SumSegment& s : slice.section.tight_segments) add(s.from), add(s.to);
  for (const SumVertex& v : slice.section.tight_points) add(v);
  return all;
}

TEST(SliceOfResult, IsThatOfTheSolidInIntegers) {
  Random random(2042);
  int sections = 0, long_ones = 0;
  for (int round = 0; round < rounds(80); ++round) {
    SCOPED_TRACE(round);
    const SpatialSum p = random_solid_of_fractions(random), q = random_solid_of_fractions(random);
    const BigInteger scale = lcm(denominator_of(p), denominator_of(q));
    const std::optional<Mesh> p_whole = solid_times(p, scale), q_whole = solid_times(q, scale);
    if (scale == 1 || !p_whole || !q_whole) continue;
    long_ones += scale > 1000;
    for (const double z : {0.0, 1.0, 2.5, 4.0, 5.25, 8.0}) {
      const BigRational height = exact::exact_value(z) * scale;
      const double whole_z = exact::round_to_double(height);
      if (exact::exact_value(whole_z) != height) continue;
      const Result<SolidSlice> found = slice_of_sum(p, q, z), expected = slice_of_sum(*p_whole, *q_whole, whole_z);
      ASSERT_TRUE(found.ok() && expected.ok());
      EXPECT_EQ(corners_of(*found, scale), corners_of(*expected, 1)) << z;
      EXPECT_EQ(found->touching.size(), expected->touching.size());
      sections += !found->section.parts.empty();
    }
  }
  EXPECT_GT(sections, rounds(80));
  EXPECT_GT(long_ones, 0);
}

TEST(SliceOfResult, HeightsThatAreFinerThanTheGridAreExact) {
  const Mesh wedge = *convex_hull(std::vector<Point3>{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3}});
  const SpatialSum part = *intersection(wedge, solids::box(-1, -1, -1, 5, 5, 1.0 / 3));
  const Mesh dot = solids::box(0, 0, 0, 1, 1, 1);
  for (const double z : {0.1, 0x1p-60, 1.1}) {
    const SolidSlice slice = *slice_of_sum(part, dot, z);
    ASSERT_EQ(slice.section.parts.size(), 1U) << z;
    // Both at the height at which the wedge is widest: z of P from max(0, z - 1) on.
    const BigRational low = z > 1 ? BigRational(exact::exact_value(z) - 1) : BigRational(0), side = 3 - low;
    const BigRational area = side * side / 2 + 2 * side + 1;
    EXPECT_EQ(exact::exact_value(slice.section.area_exact()), area) << z;
  }
  EXPECT_TRUE(slice_of_sum(part, dot, 2).value().section.parts.empty());
}

}  // namespace
}  // namespace dymsum::oracles
