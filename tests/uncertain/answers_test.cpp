// Answers for all, for some and for none against every pair of variants by definition; clearances against those of all
// pairs, and in closed form.
#include "dymsum/uncertain_answers.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "dymsum/scaling_family.h"
#include "dymsum/shapes.h"
#include "oracles/sanitized.h"
#include "sets.h"

namespace dymsum::oracles {
namespace {

/// What enumeration says, with a predicate by definition.
template <class Predicate>
void expect_enumerated(const UncertainAnswer& answer, const std::vector<Region>& ps, const std::vector<Region>& qs,
                       const Predicate& holds, std::array<int, 3>& seen) {
  std::size_t count = 0;
  for (const Region& p : ps)
    for (const Region& q : qs) count += holds(p, q);
  const Holds expected = count == ps.size() * qs.size() ? Holds::for_all
                         : count > 0                    ? Holds::for_some
                                                        : Holds::for_none;
  ++seen[static_cast<std::size_t>(expected)];
  EXPECT_EQ(answer.holds, expected);
  EXPECT_EQ(answer.yes.has_value(), count > 0);
  EXPECT_EQ(answer.no.has_value(), count < ps.size() * qs.size());
  if (answer.yes) {
    EXPECT_TRUE(holds(ps.at(answer.yes->p), qs.at(answer.yes->q)));
  }
  if (answer.no) {
    EXPECT_FALSE(holds(ps.at(answer.no->p), qs.at(answer.no->q)));
  }
}

TEST(UncertainAnswers, AreThoseOfAllPairsOfVariants) {
  Random random(11);
  std::array<int, 3> contained{}, collided{}, fitted{};
  for (int round = 0; round < rounds(50); ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    const std::vector<Region> ps = small_variants(random, 6, 1 + random.below(3)),
                              qs = small_variants(random, 2, 1 + random.below(2));
    const Uncertain p = *Uncertain::of_variants(ps), q = *Uncertain::of_variants(qs);
    std::vector<RationalPoint> tried = positions_to_try(random, -2, 8, 3);
    for (const RationalPoint& v : vertices_of(*erode(ps[0], qs[0])))
      if (tried.size() < 6) tried.push_back(v);
    for (const RationalPoint& z : tried) {
      const Pt<Big> at = big(z);
      expect_enumerated(
          *contains(p, q, z), ps, qs,
          [&](const Region& a, const Region& b) { return meets_closed(a.data(), b.data(), at); }, contained);
      expect_enumerated(
          *collides(p, q, z), ps, qs,
          [&](const Region& a, const Region& b) { return overlaps_open(a.data(), negated(b).data(), at); }, collided);
      expect_enumerated(
          *fits_at(p, q, z), ps, qs,
          [&](const Region& a, const Region& b) { return holds_closed(a.data(), b.data(), at); }, fitted);
    }
  }
  for (const auto& seen : {contained, collided, fitted})
    for (const int count : seen) EXPECT_GT(count, 5);
}

TEST(UncertainAnswers, PositionsInFractionsAreDecidedLikeOthers) {
  const Region triangle = polygon({{0, 0}, {3, 0}, {0, 1}});
  const Uncertain p = *Uncertain::known(triangle), zero = *Uncertain::known(origin());
  // On the edge from (3, 0) to (0, 1), where no doubles are: (1, 2/3).
  EXPECT_EQ(contains(p, zero, {1, ratio(2, 3)})->holds, Holds::for_all);
  EXPECT_EQ(contains(p, zero, {1, ratio(2, 3) + ratio(1, 1000000007)})->holds, Holds::for_none);
  EXPECT_EQ(contains(p, zero, {1, ratio(2, 3)}, Semantics::open)->holds, Holds::for_none);
}

TEST(UncertainAnswers, APartFitsForAllSomeOrNone) {
  Random random(12);
  std::array<int, 3> seen{};
  int common = 0, apart = 0;
  for (int round = 0; round < rounds(120); ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    const std::vector<Region> ps = small_variants(random, 5, 3), qs = small_variants(random, 3, 2);
    const Result<UncertainFit> fit = fits_anywhere(*Uncertain::of_variants(ps), *Uncertain::of_variants(qs));
    if (!fit) continue;
    expect_enumerated(
        fit->answer, ps, qs,
        [&](const Region& a, const Region& b) {
          const PlanarSum e = *erode(a, b);
          return !e.parts.empty() || !e.segments.empty() || !e.points.empty();
        },
        seen);
    if (fit->common) {
      ++common;
      EXPECT_EQ(fit->answer.holds, Holds::for_all);
      for (const Region& a : ps)
        for (const Region& b : qs) EXPECT_TRUE(holds_closed(a.data(), b.data(), big(*fit->common)));
    }
    apart += fit->answer.holds == Holds::for_all && !fit->common;
  }
  for (const int count : seen) EXPECT_GT(count, 5);
  EXPECT_GT(common, 5);
}

// The question: a part of 0.30000000000000004 in a slot of 0.3.
TEST(UncertainAnswers, APartOfThreeTenthsInASlotOfThreeTenths) {
  const Region slot = box(0, 0, 0.3, 1), part = box(0, 0, 0.1 + 0.2, 0.5);
  EXPECT_EQ(fits_anywhere(*Uncertain::known(slot), *Uncertain::known(part))->answer.holds, Holds::for_none);
  const UncertainAnswer rounded = fits_anywhere(*Uncertain::of_rounding(slot), *Uncertain::of_rounding(part))->answer;
  EXPECT_EQ(rounded.holds, Holds::for_some);
  EXPECT_EQ(rounded.yes, (VariantPair{VariantPair::kOuter, VariantPair::kInner}));
  EXPECT_EQ(rounded.no, (VariantPair{VariantPair::kInner, VariantPair::kOuter}));
  // Within 1e-12 the slot is wide enough.
  EXPECT_EQ(fits_anywhere(*Uncertain::of_band(slot, {2e-12, 1e-12}), *Uncertain::known(part))->answer.holds,
            Holds::for_all);
}

// A peg in a slot: closed forms. H7/g6, H7/k6 and H7/p6 of 20 mm, deviations of the width halved to each side.
TEST(UncertainAnswers, PegsInSlotsToIsoFits) {
  const Region slot = box(0, 0, 20, 40), peg = box(0, 0, 20, 10);
  struct Fit {
    double upper, lower;
    Holds expected;
  };
  const Tolerance h7{0.0105, 0};
  for (const Fit& f : {Fit{-0.0035, -0.01, Holds::for_all}, Fit{0.0075, 0.001, Holds::for_some},
                       Fit{0.0175, 0.011, Holds::for_none}}) {
    const Uncertain hole = *Uncertain::of_band(slot, h7), shaft = *Uncertain::of_band(peg, {f.upper, f.lower});
    EXPECT_EQ(fits_anywhere(hole, shaft)->answer.holds, f.expected);
  }
  // h6 fits with nothing to spare at one end: exactly.
  EXPECT_EQ(fits_anywhere(*Uncertain::of_band(slot, h7), *Uncertain::of_band(peg, {0, -0.0065}))->answer.holds,
            Holds::for_all);
  const Uncertain tightest = *erode(*Uncertain::of_band(slot, h7), *Uncertain::of_band(peg, {0, -0.0065}));
  EXPECT_TRUE(tightest.inner().parts.empty());
  EXPECT_EQ(tightest.inner().segments.size(), 1u);
  EXPECT_EQ(tightest.outer().parts.size(), 1u);
}

// A rod in a ring: the ring's hole is a box of 10, the rod one of 9 x 1, both in a band.
TEST(UncertainAnswers, ARodInARing) {
  const Region ring =
      *Region::create({{{box(-6, -6, 6, 6).parts()[0].outer, {{{-5, -5}, {-5, 5}, {5, 5}, {5, -5}}}}}, {}, {}});
  const Region rod = box(-4.5, -0.5, 4.5, 0.5);
  const Uncertain r = *Uncertain::of_band(ring, {0.25, -0.125}), q = *Uncertain::of_band(rod, {0.125, -0.0625});
  const UncertainClearance c = *clearance(r, q, at_point(0, 0));
  // The hole is from 9.5 to 10.25 wide, the rod from 8.875 to 9.25 long.
  EXPECT_EQ(c.least_signed(), 0.125);
  EXPECT_EQ(c.most_signed(), 0.6875);
  EXPECT_EQ(c.least.of, (VariantPair{VariantPair::kOuter, VariantPair::kOuter}));
  EXPECT_EQ(c.most.of, (VariantPair{VariantPair::kInner, VariantPair::kInner}));
  EXPECT_EQ(collides(r, q, at_point(0, 0))->holds, Holds::for_none);
  EXPECT_EQ(collides(r, q, at_point(0.25, 0))->holds, Holds::for_some);
  EXPECT_EQ(collides(r, q, at_point(1, 0))->holds, Holds::for_all);
  const UncertainClearance deep = *clearance(r, q, at_point(1, 0));
  EXPECT_EQ(deep.least_signed(), -0.875);
  EXPECT_EQ(deep.most_signed(), -0.3125);
}

double signed_of(const PlanarDistance& d) { return d.meeting == Meeting::overlapping ? -d.distance : d.distance; }

TEST(UncertainAnswers, ClearancesOfVariantsAreTheLeastAndTheMostOfAllPairs) {
  Random random(13);
  int overlapping = 0, apart = 0;
  for (int round = 0; round < rounds(60); ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    const std::vector<Region> ps = small_variants(random, 6, 2), qs = small_variants(random, 3, 2);
    const RationalPoint at{ratio(random.below(25) - 6, 2), ratio(random.below(25) - 6, 3)};
    const UncertainClearance made = *clearance(*Uncertain::of_variants(ps), *Uncertain::of_variants(qs), at);
    double least = INFINITY, most = -INFINITY;
    for (const Region& p : ps)
      for (const Region& q : qs) {
        const double d = signed_of(PlanarDepth::create(p, q)->at(at));
        least = std::min(least, d), most = std::max(most, d);
      }
    EXPECT_EQ(made.least_signed(), least);
    EXPECT_EQ(made.most_signed(), most);
    EXPECT_EQ(signed_of(PlanarDepth::create(ps[made.least.of.p], qs[made.least.of.q])->at(at)), least);
    EXPECT_EQ(signed_of(PlanarDepth::create(ps[made.most.of.p], qs[made.most.of.q])->at(at)), most);
    EXPECT_FALSE(made.least.distance.ways.empty() || made.least.distance.ways[0].contacts.empty());
    overlapping += least<0, apart += most> 0;
  }
  EXPECT_GT(overlapping, 5);
  EXPECT_GT(apart, 5);
}

// Members of bands and zones have clearances inside the interval; of sets that are known both ends are one.
TEST(UncertainAnswers, ClearancesOfMembersLieInTheInterval) {
  Random random(14);
  for (int round = 0; round < rounds(40); ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    const Region p = small_region(random, 6), q = small_region(random, 3);
    const RationalPoint at{ratio(random.below(25) - 6, 2), ratio(random.below(25) - 6, 2)};
    const Uncertain known = *Uncertain::known(p), zone = *Uncertain::of_rounding(q, std::int64_t{1} << 40);
    const UncertainClearance exact = *clearance(known, *Uncertain::known(q), at), wide = *clearance(known, zone, at);
    EXPECT_EQ(exact.least_signed(), exact.most_signed());
    EXPECT_LE(wide.least_signed(), exact.least_signed());
    EXPECT_GE(wide.most_signed(), exact.most_signed());
  }
  const Uncertain nothing = *Uncertain::of_band(box(0, 0, 1, 1), {1, -1});
  const UncertainClearance none = *clearance(nothing, *Uncertain::known(box(0, 0, 1, 1)), at_point(9, 0));
  EXPECT_EQ(none.least_signed(), 7);
  EXPECT_EQ(none.most_signed(), INFINITY);
  const Uncertain line = *Uncertain::known(*Region::create({{}, {{{0, 0}, {1, 0}}}, {}}));
  EXPECT_EQ(clearance(line, line, {}).error().code, ErrorCode::unsupported_operand);
}

}  // namespace
}  // namespace dymsum::oracles
