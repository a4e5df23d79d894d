// Solids that are not known exactly, against all their variants: by voxels, by enumeration, by random members.
#include "dymsum/uncertain_solid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "dymsum/set_check.h"
#include "dymsum/solid_erosion.h"
#include "dymsum/solid_union.h"
#include "dymsum/solids.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/random.h"
#include "oracles/sanitized.h"
#include "oracles/voxel_solids.h"
#include "spatial/boolean/winding_oracle.h"

namespace dymsum::oracles {
namespace {

Mesh solid_of(const Voxels& voxels) { return voxels.empty() ? Mesh() : Mesh::create(voxel_mesh(voxels)).value(); }

/// Some voxels of a grid, so that the solid is valid whatever they are.
Voxels some_voxels(Random& random, int size, int percent) {
  Voxels all;
  for (int x = 0; x < size; ++x)
    for (int y = 0; y < size; ++y)
      for (int z = 0; z < size; ++z)
        if (random.chance(percent)) all.insert({x, y, z});
  if (all.empty()) all.insert({0, 0, 0});
  return all;
}
std::vector<Voxels> variants_of(Random& random, int size, int count, int percent = 75) {
  std::vector<Voxels> variants{some_voxels(random, size, percent)};
  while (static_cast<int>(variants.size()) < count) {
    Voxels next = variants[0];
    const Voxel cell{random.below(size), random.below(size), random.below(size)};
    if (next.count(cell) != 0 && next.size() > 1) next.erase(cell);
    else next.insert(cell);
    variants.push_back(next);
  }
  return variants;
}
std::vector<Mesh> solids_of(const std::vector<Voxels>& all) {
  std::vector<Mesh> solids;
  for (const Voxels& one : all) solids.push_back(solid_of(one));
  return solids;
}

/// A position in half steps.
using HalfSteps = std::array<int, 3>;
RationalPoint3 position(const HalfSteps& h) {
  return {*Rational::of(h[0], 2), *Rational::of(h[1], 2), *Rational::of(h[2], 2)};
}
HalfSteps some_position(Random& random, int from, int to) {
  const auto one = [&] { return 2 * from + random.below(2 * (to - from) + 1); };
  return {one(), one(), one()};
}

bool any_pair(const Voxels& p, const Voxels& q, const std::function<bool(const Voxel&, const Voxel&)>& holds) {
  return std::any_of(p.begin(), p.end(), [&](const Voxel& a) {
    return std::any_of(q.begin(), q.end(), [&](const Voxel& b) { return holds(a, b); });
  });
}
bool in_sum(const Voxels& p, const Voxels& q, const HalfSteps& at) {
  return any_pair(p, q, [&](const Voxel& a, const Voxel& b) {
    for (std::size_t k = 0; k < 3; ++k)
      if (at[k] < 2 * (a[k] + b[k]) || at[k] > 2 * (a[k] + b[k]) + 4) return false;
    return true;
  });
}
bool overlap(const Voxels& p, const Voxels& q, const HalfSteps& at) {
  return any_pair(p, q, [&](const Voxel& a, const Voxel& b) {
    for (std::size_t k = 0; k < 3; ++k)
      if (std::abs(2 * b[k] + at[k] - 2 * a[k]) >= 2) return false;
    return true;
  });
}
/// Every eighth of each moved cube lies in P.
bool lies_inside(const Voxels& p, const Voxels& q, const HalfSteps& at) {
  for (const Voxel& b : q)
    for (int e = 0; e < 8; ++e) {
      Voxel of_p{};
      for (std::size_t k = 0; k < 3; ++k)
        of_p[k] = static_cast<int>(std::floor((2 * b[k] + at[k] + ((e >> k) & 1)) / 2.0));
      if (p.count(of_p) == 0) return false;
    }
  return true;
}

Holds expected(const std::vector<Voxels>& p, const std::vector<Voxels>& q,
               const std::function<bool(const Voxels&, const Voxels&)>& holds) {
  std::size_t yes = 0;
  for (const Voxels& a : p)
    for (const Voxels& b : q) yes += holds(a, b) ? 1 : 0;
  return yes == 0 ? Holds::for_none : yes == p.size() * q.size() ? Holds::for_all : Holds::for_some;
}

bool contained(const SpatialOperand& inner, const SpatialOperand& outer) {
  return difference(inner, outer).value().faces.empty();
}

TEST(UncertainSolid, InnerAndOuterOfVariantsAreThoseByVoxels) {
  Random random(1);
  int differ = 0;
  for (int round = 0; round < rounds(30); ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    std::vector<Voxels> cells;
    for (int k = 0; k < 3; ++k) cells.push_back(some_voxels(random, 3, 60));
    Voxels common, any;
    for (const Voxels& one : cells) any.insert(one.begin(), one.end());
    for (const Voxel& cell : any)
      if (std::all_of(cells.begin(), cells.end(), [&](const Voxels& v) { return v.count(cell) != 0; }))
        common.insert(cell);
    const UncertainSolid u = *UncertainSolid::of_variants(solids_of(cells));
    EXPECT_EQ(u.inner().volume_exact(), Rational(static_cast<std::int64_t>(common.size())));
    EXPECT_EQ(u.outer().volume_exact(), Rational(static_cast<std::int64_t>(any.size())));
    if (!common.empty()) {
      EXPECT_TRUE(check_set(SpatialOperand(u.inner()), solid_of(common)).value().equal());
    }
    EXPECT_TRUE(check_set(SpatialOperand(u.outer()), solid_of(any)).value().equal());
    EXPECT_EQ(u.doubtful().value().volume_exact(), Rational(static_cast<std::int64_t>(any.size() - common.size())));
    differ += u.exact() ? 0 : 1;
  }
  EXPECT_GT(differ, rounds(20));
}

TEST(UncertainSolid, AnswersAreThoseOfAllPairsOfVoxels) {
  Random random(2);
  std::array<std::array<int, 3>, 3> met{};
  for (int round = 0; round < rounds(20); ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    const std::vector<Voxels> p = variants_of(random, 3, 2, 92), q = variants_of(random, 2, 2, 35);
    const UncertainSolid of_p = *UncertainSolid::of_variants(solids_of(p)),
                         of_q = *UncertainSolid::of_variants(solids_of(q));
    for (int k = 0; k < 4; ++k) {
      const HalfSteps z = some_position(random, -1, 6), at = some_position(random, -1, 3),
                      near = some_position(random, 0, 1);
      const auto same = [&](const UncertainAnswer& answer, std::size_t question, const auto& holds) {
        EXPECT_EQ(answer.holds, expected(p, q, holds)) << "question " << question;
        EXPECT_EQ(answer.yes.has_value(), answer.holds != Holds::for_none);
        EXPECT_EQ(answer.no.has_value(), answer.holds != Holds::for_all);
        if (answer.holds == Holds::for_some) {
          EXPECT_TRUE(holds(p.at(answer.yes->p), q.at(answer.yes->q)));
          EXPECT_FALSE(holds(p.at(answer.no->p), q.at(answer.no->q)));
        }
        ++met[question][static_cast<std::size_t>(answer.holds)];
      };
      same(*contains(of_p, of_q, position(z)), 0, [&](const Voxels& a, const Voxels& b) { return in_sum(a, b, z); });
      same(*collides(of_p, of_q, position(at)), 1, [&](const Voxels& a, const Voxels& b) { return overlap(a, b, at); });
      if (of_q.inner().faces.empty()) continue;
      same(*fits_at(of_p, of_q, position(near)), 2,
           [&](const Voxels& a, const Voxels& b) { return lies_inside(a, b, near); });
    }
  }
  for (std::size_t question = 0; question < 3; ++question)
    for (std::size_t holds = 0; holds < 3; ++holds) EXPECT_GT(met[question][holds], 0) << question << ' ' << holds;
}

TEST(UncertainSolid, OperationsLieAroundThoseOfEveryPairOfVariants) {
  Random random(3);
  for (int round = 0; round < rounds(12); ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    const std::vector<Mesh> p = solids_of(variants_of(random, 3, 2)), q = solids_of(variants_of(random, 2, 2));
    const UncertainSolid of_p = *UncertainSolid::of_variants(p), of_q = *UncertainSolid::of_variants(q);
    const auto around = [&](const UncertainSolid& made, const SpatialSum& one) {
      EXPECT_TRUE(contained(made.inner(), one));
      EXPECT_TRUE(contained(one, made.outer()));
    };
    for (const Mesh& a : p)
      for (const Mesh& b : q) {
        around(*minkowski_sum(of_p, of_q), *minkowski_sum(a, b));
        around(*united(of_p, of_q), *united(std::vector<Mesh>{a, b}));
        around(*intersection(of_p, of_q), *intersection(a, b));
        around(*difference(of_p, of_q), *difference(a, b));
        if (const auto made = erode(of_p, of_q)) around(*made, *erode(a, b));
      }
    // The outer sum is exactly the union of all sums.
    std::vector<SpatialSum> sums;
    for (const Mesh& a : p)
      for (const Mesh& b : q) sums.push_back(*minkowski_sum(a, b));
    const std::vector<SpatialOperand> all(sums.begin(), sums.end());
    EXPECT_TRUE(check_set(SpatialOperand(*united(all)), minkowski_sum(of_p, of_q)->outer()).value().equal());
  }
}

/// Triangles alone, so that all kinds of coordinates leave it valid; one apex is pushed in.
Mesh dented(CoordinateKind kind, std::mt19937_64& random) {
  MeshData data = solids::dipyramid(5, 2, 3).data();
  const auto top = std::max_element(data.vertices.begin(), data.vertices.end(),
                                    [](const Point3& a, const Point3& b) { return a.z < b.z; });
  top->z = -0.5;
  return Mesh::create(of_kind(data, kind, random)).value();
}

Mesh moved_by(const Mesh& solid, Point3 by) {
  MeshData data = solid.data();
  for (Point3& v : data.vertices) v = {v.x + by.x, v.y + by.y, v.z + by.z};
  return Mesh::create(data).value();
}

TEST(UncertainSolid, MembersOfBandsLieBetweenItsSetsAndWiderBandsAreWider) {
  std::mt19937_64 source(4);
  for (const CoordinateKind kind : kCoordinateKinds) {
    SCOPED_TRACE(name_of(kind));
    const Mesh nominal = dented(kind, source);
    const double within = 0.0625;
    const UncertainSolid band = *UncertainSolid::of_band(nominal, {0.25, -0.25}, within),
                         wide = *UncertainSolid::of_band(nominal, {0.5, -0.375}, within);
    EXPECT_TRUE(contained(band.inner(), nominal) && contained(nominal, band.outer()));
    EXPECT_TRUE(contained(wide.inner(), band.inner()) && contained(band.outer(), wide.outer()));
    EXPECT_FALSE(band.exact());
    EXPECT_EQ(band.error(), within);
    // A solid that is moved by less than the deviation is a member.
    Random random(4);
    for (int k = 0; k < rounds(4); ++k) {
      const Point3 by{0.14 * random.signed_unit(), 0.14 * random.signed_unit(), 0.14 * random.signed_unit()};
      const Mesh member = moved_by(nominal, by);
      EXPECT_TRUE(contained(band.inner(), member) && contained(member, band.outer()));
    }
    // The sets reach as far as the ball, and no further than the error says.
    const auto top = [](const auto& vertices) {
      double z = -INFINITY;
      for (const Point3& v : vertices) z = std::max(z, v.z);
      return z;
    };
    const double reach = top(band.outer().vertices) - top(nominal.vertices());
    EXPECT_GE(reach, 0.25 - 1e-9);
    EXPECT_LE(reach, 0.25 + within + 1e-9);
  }
}

TEST(UncertainSolid, MembersOfBoxesLieBetweenItsSets) {
  std::mt19937_64 source(5);
  Random random(5);
  for (const CoordinateKind kind : kCoordinateKinds) {
    SCOPED_TRACE(name_of(kind));
    const Mesh nominal = dented(kind, source);
    std::vector<std::array<double, 6>> boxes;
    for (const Point3& v : nominal.vertices()) {
      const double r = random.chance(30) ? 0 : 0.03125 * (1 + random.below(3));
      boxes.push_back({v.x - r, v.y - r, v.z - r, v.x + r, v.y + r / 2, v.z + r});
    }
    const UncertainSolid zones = *UncertainSolid::of_boxes(nominal, boxes);
    EXPECT_TRUE(contained(zones.inner(), nominal) && contained(nominal, zones.outer()));
    const ExactSurface inner = exact_surface(zones.inner()), outer = exact_surface(zones.outer());
    int looked = 0, doubtful = 0;
    for (int k = 0; k < rounds(6); ++k) {
      MeshData data = nominal.data();
      for (std::size_t v = 0; v < boxes.size(); ++v) {
        const auto in = [&](std::size_t axis) {
          const double t = (random.signed_unit() + 1) / 2, a = boxes[v][axis], b = boxes[v][axis + 3];
          return std::clamp(a + t * (b - a), a, b);
        };
        data.vertices[v] = {in(0), in(1), in(2)};
      }
      const Mesh member = Mesh::create(data).value();
      EXPECT_TRUE(contained(zones.inner(), member) && contained(member, zones.outer()));
      // The same at positions near the surface, by winding numbers in rational arithmetic.
      const ExactSurface surface = exact_surface(member.data());
      for (const Face& f : data.faces) {
        Point3 c{};
        for (const std::uint32_t v : f)
          c = {c.x + data.vertices[v].x / 3, c.y + data.vertices[v].y / 3, c.z + data.vertices[v].z / 3};
        const double away = 0.1 * random.signed_unit();
        const RationalVector at = exact_of(Point3{c.x + away, c.y - away, c.z + away});
        const auto a = winding_at(inner, at), b = winding_at(surface, at), o = winding_at(outer, at);
        if (!a || !b || !o) continue;
        EXPECT_LE(*a, *b);
        EXPECT_LE(*b, *o);
        ++looked, doubtful += *a != *o ? 1 : 0;
      }
    }
    EXPECT_GT(looked, 0);
    EXPECT_GT(doubtful, 0);
  }
}

TEST(UncertainSolid, MembersOfRoundingLieBetweenItsSets) {
  std::mt19937_64 source(6);
  Random random(6);
  for (const CoordinateKind kind : {CoordinateKind::decimals, CoordinateKind::turned, CoordinateKind::turned_far}) {
    SCOPED_TRACE(name_of(kind));
    const Mesh nominal = dented(kind, source);
    const UncertainSolid rounded = *UncertainSolid::of_rounding(nominal, 2);
    EXPECT_FALSE(rounded.exact());
    for (int k = 0; k < rounds(4, 2); ++k) {
      MeshData data = nominal.data();
      const auto off = [&](double v) {
        for (int steps = random.below(3); steps > 0; --steps) v = std::nextafter(v, random.chance(50) ? 1e9 : -1e9);
        return v;
      };
      for (Point3& v : data.vertices) v = {off(v.x), off(v.y), off(v.z)};
      const Mesh member = Mesh::create(data).value();
      EXPECT_TRUE(contained(rounded.inner(), member) && contained(member, rounded.outer()));
    }
  }
}

TEST(UncertainSolid, ASlotOfThreeTenthsTakesAPartThatIsOneDigitWiderForSome) {
  const Mesh slot = solids::box(0, 0, 0, 0.3, 1, 1), part = solids::box(0, 0, 0, 0.1 + 0.2, 0.5, 0.5);
  const UncertainSolid known_slot = *UncertainSolid::known(slot), known_part = *UncertainSolid::known(part);
  EXPECT_EQ(fits_anywhere(known_slot, known_part)->answer.holds, Holds::for_none);
  EXPECT_EQ(fits_anywhere(*UncertainSolid::of_rounding(slot), known_part)->answer.holds, Holds::for_some);
}

TEST(UncertainSolid, ASlotAndAPegHaveTheClearancesOfTheirWidths) {
  const Mesh slot = solids::box(0, 0, 0, 4, 4, 4);
  const std::vector<Mesh> pegs{solids::box(5, 1, 1, 6, 2, 2), solids::box(3.75, 1, 1, 6, 2, 2),
                               solids::box(4, 1, 1, 6, 2, 2)};
  const UncertainSolid wall = *UncertainSolid::known(slot), peg = *UncertainSolid::of_variants(pegs);
  const UncertainSolidClearance found = *clearance(wall, peg, {});
  EXPECT_EQ(found.least_signed(), -0.25);
  EXPECT_EQ(found.most_signed(), 1);
  EXPECT_EQ(found.least.of, (VariantPair{0, 1}));
  EXPECT_EQ(found.most.of, (VariantPair{0, 0}));
  EXPECT_FALSE(found.least.distance.ways.at(0).contacts.empty());
  EXPECT_EQ(collides(wall, peg, {})->holds, Holds::for_some);
  EXPECT_EQ(collides(wall, peg, {Rational(1), {}, {}})->holds, Holds::for_none);
  // With deviations of a quarter, balls reaching at most 1/64 further.
  const UncertainSolid band = *UncertainSolid::of_band(slot, {0.25, -0.25}, 0x1p-6);
  const UncertainSolidClearance bounds = *clearance(band, *UncertainSolid::known(pegs[0]), {});
  EXPECT_LE(bounds.least_signed(), 0.75);
  EXPECT_GE(bounds.least_signed(), 0.75 - 0x1p-6);
  EXPECT_GE(bounds.most_signed(), 1.25);
  EXPECT_LE(bounds.most_signed(), 1.25 + 0x1p-6);
}

TEST(UncertainSolid, WithoutToleranceResultsAreThoseOfSolidsTightFeaturesIncluded) {
  const Mesh slot = solids::box(0, 0, 0, 2, 4, 4), part = solids::box(0, 0, 0, 2, 1, 1);
  const UncertainSolid p = *UncertainSolid::of_band(slot, {}), q = *UncertainSolid::of_rounding(part, 0);
  EXPECT_TRUE(p.exact() && q.exact());
  const UncertainSolid positions = *erode(p, q);
  EXPECT_TRUE(positions.exact());
  EXPECT_EQ(positions.inner(), *erode(slot, part));
  EXPECT_EQ(positions.inner().tight_faces.size(), 1u);
  const UncertainSolidFit fit = *fits_anywhere(p, q);
  EXPECT_EQ(fit.answer.holds, Holds::for_all);
  EXPECT_EQ(fits_at(p, q, *fit.common)->holds, Holds::for_all);
  EXPECT_EQ(fits_at(p, q, {*Rational::of(1, 1000), {}, {}})->holds, Holds::for_none);
  EXPECT_EQ(minkowski_sum(p, q)->outer(), *minkowski_sum(slot, part));
}

TEST(UncertainSolid, WhatIsWrongIsSaid) {
  const Mesh cube = solids::box(0, 0, 0, 1, 1, 1), far = solids::box(5, 0, 0, 6, 1, 1);
  EXPECT_EQ(UncertainSolid::of_variants({}).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(UncertainSolid::of_band(cube, {-1, 1}).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(UncertainSolid::of_band(cube, {NAN, 0}).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(UncertainSolid::of_rounding(cube, -1).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(UncertainSolid::of_boxes(cube, {}).error().code, ErrorCode::out_of_range);
  std::vector<std::array<double, 6>> boxes(8, {0, 0, 0, 1, 1, 0.5});
  const Error off = UncertainSolid::of_boxes(cube, boxes).error();
  EXPECT_EQ(off.code, ErrorCode::out_of_range);
  ASSERT_TRUE(off.evidence.vertex.has_value());
  EXPECT_EQ(cube.vertices()[static_cast<std::size_t>(*off.evidence.vertex)].z, 1);
  const Error apart = UncertainSolid::between(far, cube).error();
  EXPECT_EQ(apart.code, ErrorCode::out_of_range);
  EXPECT_TRUE(apart.evidence.x && *apart.evidence.x >= 5);
  const Mesh point = Mesh::with_thin_parts({{{0, 0, 0}}, {{0}}}).value();
  EXPECT_EQ(UncertainSolid::known(point).error().code, ErrorCode::unsupported_operand);
  const UncertainSolid disjoint = *UncertainSolid::of_variants({cube, far});
  EXPECT_EQ(erode(*UncertainSolid::known(cube), disjoint).error().code, ErrorCode::unsupported_operand);
}

}  // namespace
}  // namespace dymsum::oracles
