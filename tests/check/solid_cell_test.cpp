// Convex cells that were cut have the vertices that their planes meet in, and no others beyond these.
#include "check/solid_cell.h"

#include <gtest/gtest.h>

#include <set>

#include "oracles/random.h"
#include "oracles/sanitized.h"

namespace dymsum::oracles {
namespace {

using check::halved;
using check::PlaneTable;
using check::RationalVector;
using check::SolidCell;
using check::SpacePointRef;
using exact::BigInteger;
using exact::BigRational;

/// Positions where three of the planes meet, on no wrong side of any.
std::set<RationalVector> corners(const std::vector<SolidCell::Facet>& sides, const PlaneTable& planes) {
  std::set<RationalVector> found;
  for (std::size_t i = 0; i < sides.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k) {
        const auto &a = planes[sides[i].plane].exact, &b = planes[sides[j].plane].exact,
                   &c = planes[sides[k].plane].exact;
        const BigInteger volume = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
                                  a[2] * (b[0] * c[1] - b[1] * c[0]);
        if (volume == 0) continue;
        const SpacePointRef p = planes.meeting_of(sides[i].plane, sides[j].plane, sides[k].plane);
        const RationalVector at = p->rational();
        bool inside = true;
        for (const SolidCell::Facet& side : sides) {
          const auto& f = planes[side.plane].exact;
          const BigRational value = f[0] * at[0] + f[1] * at[1] + f[2] * at[2] + f[3];
          inside &= value.sign() * side.side >= 0;
        }
        if (inside) found.insert(at);
      }
  return found;
}

TEST(SolidCell, CutsLeaveTheCornersOfTheirPlanes) {
  Random random(41);
  std::size_t cuts = 0, on_vertices = 0;
  for (int round = 0; round < rounds(60); ++round) {
    SCOPED_TRACE(round);
    PlaneTable planes;
    SolidCell cell = check::box_cell({-2, -2, -2}, {2, 2, 2}, planes);
    std::vector<SolidCell::Facet> sides = cell.facets;
    for (int cut = 0; cut < 8; ++cut) {
      // Few coefficients: planes go through vertices and edges, and through lines of others.
      const auto number = [&](int most) { return BigInteger(random.below(2 * most + 1) - most); };
      std::array<BigInteger, 4> form{number(2), number(2), number(2), number(3)};
      if (form[0] == 0 && form[1] == 0 && form[2] == 0) continue;
      const std::uint32_t plane = planes.add(form);
      bool negative = false, positive = false;
      for (const SpacePointRef& v : cell.vertices) {
        const int side = side_of(planes[plane], *v);
        negative |= side<0, positive |= side> 0, on_vertices += side == 0;
      }
      auto halves = halved(cell, plane, planes);
      ASSERT_EQ(halves.has_value(), negative && positive);
      if (!halves) continue;
      ++cuts;
      const bool first = random.chance(50);
      cell = first ? std::move(halves->negative) : std::move(halves->positive);
      sides.push_back({plane, first ? -1 : 1});
      std::set<RationalVector> vertices;
      for (const SpacePointRef& v : cell.vertices) {
        EXPECT_TRUE(vertices.insert(v->rational()).second) << "a vertex twice";
        for (const SolidCell::Facet& side : sides) EXPECT_GE(side_of(planes[side.plane], *v) * side.side, 0);
        for (const std::uint32_t on : v->planes) EXPECT_EQ(side_of(planes[on], *v), 0);
      }
      for (const RationalVector& corner : corners(sides, planes)) EXPECT_TRUE(vertices.contains(corner));
    }
  }
  EXPECT_GT(cuts, static_cast<std::size_t>(rounds(60)));
  EXPECT_GT(on_vertices, cuts / 2);
}

TEST(SolidCell, SidesAreThoseOfExactNumbers) {
  Random random(42);
  int close = 0;
  for (int round = 0; round < rounds(2000); ++round) {
    PlaneTable planes;
    const auto number = [&] { return exact::exact_value(random.signed_unit()); };
    const RationalVector n{number(), number(), number()}, p{number(), number(), number()};
    const std::uint32_t plane = planes.add(n, p);
    RationalVector q{number(), number(), number()};
    if (round % 2 == 0) {  // on the plane, but for as little as doubles do not see
      const BigRational over = check::dot_of(n, check::minus_of(q, p)) / check::dot_of(n, n);
      for (int k = 0; k < 3; ++k) q[k] -= over * n[k];
      if (round % 4 == 0) q[0] += BigRational(random.below(3) - 1, BigInteger(1) << 70);
    }
    const auto& f = planes[plane].exact;
    const BigRational value = f[0] * q[0] + f[1] * q[1] + f[2] * q[2] + f[3];
    EXPECT_EQ(side_of(planes[plane], check::SpacePoint(q)), value.sign()) << round;
    close += value.sign() == 0;
  }
  EXPECT_GT(close, rounds(2000) / 8);
}

}  // namespace
}  // namespace dymsum::oracles
