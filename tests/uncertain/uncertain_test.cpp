// Uncertain regions against all their variants: by definition, by enumeration, by random members.
#include "dymsum/uncertain.h"

#include <gtest/gtest.h>

#include <cmath>

#include "dymsum/growing_disc.h"
#include "dymsum/orientation_sum.h"
#include "dymsum/shapes.h"
#include "dymsum/sum_locator.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/sanitized.h"
#include "sets.h"

namespace dymsum::oracles {
namespace {

TEST(Uncertain, InnerAndOuterOfVariantsAreThoseByDefinition) {
  Random random(1);
  int both = 0, some = 0, none = 0;
  for (int round = 0; round < rounds(40); ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    std::vector<Region> variants;
    for (int k = 0; k < 3; ++k) variants.push_back(small_region(random, 5, false));
    const Uncertain u = *Uncertain::of_variants(variants);
    const SumLocator inner(u.inner()), outer(u.outer());
    std::vector<RationalPoint> tried = positions_to_try(random, -1, 6, 30);
    for (const PlanarSum* set : {&u.inner(), &u.outer()})
      for (const RationalPoint& v : vertices_of(*set)) tried.push_back(v);
    for (const RationalPoint& z : tried) {
      int count = 0;
      for (const Region& v : variants) count += meets_closed(v.data(), origin().data(), big(z));
      EXPECT_EQ(inner.contains_rational(z), count == 3);
      EXPECT_EQ(outer.contains_rational(z), count > 0);
      both += count == 3, some += count > 0 && count < 3, none += count == 0;
    }
  }
  EXPECT_GT(both, 30);
  EXPECT_GT(some, 30);
  EXPECT_GT(none, 30);
}

TEST(Uncertain, SumsOfVariantsAreWhatAllSumsHaveInCommonAndTheirUnion) {
  Random random(2);
  int pieces = 0;
  for (int round = 0; round < rounds(80); ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    const std::vector<Region> variants = small_variants(random, 6, 2 + random.below(3));
    const Region q = small_region(random, 4, false);
    const Uncertain list = *Uncertain::of_variants(variants), known = *Uncertain::known(q);
    const bool first = random.chance(50), reflect = random.chance(50);
    const auto sum = [&](const auto& a, const auto& b) {
      return reflect ? nfp(first ? a : b, first ? b : a) : minkowski_sum(first ? a : b, first ? b : a);
    };
    const Uncertain made = *sum(list, known);
    std::vector<PlanarSum> sums;
    for (const Region& v : variants) sums.push_back(*sum(v, q));
    const std::vector<PlanarOperand> all(sums.begin(), sums.end());
    const PlanarSum common = *intersection(all), any = *united(all);
    EXPECT_TRUE(lies_in(made.inner(), common) && lies_in(common, made.inner()));
    EXPECT_TRUE(lies_in(made.outer(), any) && lies_in(any, made.outer()));
    pieces += !made.exact();
    // By definition, too.
    const SumLocator inner(made.inner());
    for (const RationalPoint& z : positions_to_try(random, reflect ? -5 : 0, 10, 10)) {
      bool in_all = true;
      for (const Region& v : variants) {
        const Region &a = first ? v : q, &b = first ? q : v;
        in_all = in_all && meets_closed(a.data(), reflect ? negated(b).data() : b.data(), big(z));
      }
      EXPECT_EQ(inner.contains_rational(z), in_all);
    }
  }
  EXPECT_GT(pieces, 25);
}

TEST(Uncertain, PairsOfListsLieAroundEverySum) {
  Random random(3);
  for (int round = 0; round < rounds(25); ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    const std::vector<Region> ps = small_variants(random, 5, 3), qs = small_variants(random, 4, 2);
    const Uncertain p = *Uncertain::of_variants(ps), q = *Uncertain::of_variants(qs);
    const auto check = [&](const Uncertain& made, const auto& operation) {
      for (const Region& a : ps)
        for (const Region& b : qs) {
          const PlanarSum one = *operation(a, b);
          EXPECT_TRUE(lies_in(made.inner(), one) && lies_in(one, made.outer()));
        }
    };
    check(*minkowski_sum(p, q), [](const Region& a, const Region& b) { return minkowski_sum(a, b); });
    check(*nfp(p, q), [](const Region& a, const Region& b) { return nfp(a, b); });
    check(*united(p, q), [](const Region& a, const Region& b) { return united(a, b); });
    check(*intersection(p, q), [](const Region& a, const Region& b) { return intersection(a, b); });
    check(*difference(p, q), [](const Region& a, const Region& b) { return difference(a, b); });
    if (!q.inner().parts.empty()) check(*erode(p, q), [](const Region& a, const Region& b) { return erode(a, b); });
  }
}

TEST(Uncertain, ErosionsOfListsAreWhatAllErosionsHaveInCommon) {
  Random random(4);
  int fits = 0;
  for (int round = 0; round < rounds(80); ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    const std::vector<Region> ps = small_variants(random, 7, 3), qs = small_variants(random, 2, 2);
    const Result<Uncertain> made = erode(*Uncertain::of_variants(ps), *Uncertain::of_variants(qs));
    if (!made) {
      EXPECT_EQ(made.error().code, ErrorCode::unsupported_operand);
      continue;
    }
    std::vector<PlanarSum> all;
    for (const Region& a : ps)
      for (const Region& b : qs) all.push_back(*erode(a, b));
    const PlanarSum common = *intersection(std::vector<PlanarOperand>(all.begin(), all.end()));
    EXPECT_TRUE(lies_in(common, made->inner()) && lies_in(made->inner(), common));
    fits += !common.parts.empty();
  }
  EXPECT_GT(fits, 5);
}

TEST(Uncertain, WithoutAnyToleranceResultsAreThoseOfRegionsTightFeaturesIncluded) {
  // A peg that fits exactly between two blocks.
  const Region blocks = *Region::create({{box(0, 0, 2, 2).parts()[0], box(3, 0, 5, 2).parts()[0]}, {}, {}});
  const Region peg = box(0, 0, 1, 1);
  const std::vector<Uncertain> as{*Uncertain::known(blocks), *Uncertain::of_band(blocks, {}),
                                  *Uncertain::of_rounding(blocks, 0), *Uncertain::of_variants({blocks})};
  for (const Uncertain& a : as) {
    EXPECT_TRUE(a.exact());
    EXPECT_EQ(a.error(), 0);
    EXPECT_EQ(a.variants(), std::vector<Region>{blocks});
    EXPECT_TRUE(a.doubtful()->parts.empty());
    for (const Semantics semantics : {Semantics::closed, Semantics::open, Semantics::regular}) {
      SumOptions options;
      options.semantics = semantics;
      const Uncertain made = *nfp(a, *Uncertain::known(peg), options);
      EXPECT_TRUE(made.exact());
      EXPECT_EQ(made.inner(), *nfp(blocks, peg, options));
    }
  }
  EXPECT_EQ(nfp(as[0], *Uncertain::known(peg))->inner().tight_segments.size(), 1u);
}

// Bands. The exact discs' sets lie between polygons that the growing discs make on either side of them.
TEST(Uncertain, BandsHoldTheSetsOfExactDiscsAndAreNoWiderThanTheyReport) {
  const std::vector<Region> shapes{shapes::letter_l(4, 3, 1), shapes::star(7, 1, 3), shapes::grate(3, 2, 0.75, 6)};
  std::mt19937_64 random(5);
  for (const Region& shape : shapes)
    for (const CoordinateKind kind : kCoordinateKinds) {
      const Result<Region> given = Region::create(of_kind(shape.data(), kind, random));
      if (!given) continue;  // rounding may cross the edges of a shape
      for (const Tolerance tolerance : {Tolerance{0.05, -0.03}, Tolerance{-0.02, -0.0625}, Tolerance{0.1, 0.04, 8}}) {
        SCOPED_TRACE(name_of(kind) + " " + std::to_string(tolerance.upper));
        const Uncertain band = *Uncertain::of_band(*given, tolerance);
        const GrowingDisc discs(*given);
        const auto offset = [&](double deviation, DiscBound bound) {
          const Rational r = *Rational::of(std::abs(deviation));
          return to_region(deviation > 0 ? *discs.sum_at(r) : *discs.eroded_at(r), 1e-4, bound)->region;
        };
        // Vertices of these polygons are rounded.
        const double off = 1e-9;
        EXPECT_TRUE(lies_in(offset(tolerance.upper - off, DiscBound::inside), band.outer()));
        EXPECT_TRUE(lies_in(band.inner(), offset(tolerance.lower + off, DiscBound::outside)));
        EXPECT_TRUE(lies_in(band.outer(), offset(tolerance.upper + band.error() + off, DiscBound::outside)));
        EXPECT_TRUE(lies_in(offset(tolerance.lower - band.error() - off, DiscBound::inside), band.inner()));
        EXPECT_TRUE(lies_in(band.inner(), band.outer()));
        EXPECT_LT(band.error(), tolerance.sides == 32 ? 0.0006 : 0.01);
      }
    }
}

TEST(Uncertain, BandsOfBoxesReachExactlyAsFarAsTheirDiscs) {
  for (const int sides : {4, 8, 12, 32, 256})
    for (const double r : {0.1, 0.375, 1.0 / 3, 1e-9}) {
      const Uncertain band = *Uncertain::of_band(box(0, 0, 10, 6), {r, -r, sides});
      const auto extent = [](const PlanarSum& set) {
        Rational low = set.exact(set.parts[0].outer.vertices[0]).x, high = low;
        for (const RationalPoint& v : vertices_of(set)) low = std::min(low, v.x), high = std::max(high, v.x);
        return high - low;
      };
      const Rational twice = ratio(2) * *Rational::of(r);
      EXPECT_EQ(extent(band.outer()), ratio(10) + twice);
      EXPECT_EQ(extent(band.inner()), ratio(10) - twice);
    }
}

TEST(Uncertain, BandsGrowWithTheTolerance) {
  const Region shape = shapes::gear(9, 2, 3);
  std::vector<Uncertain> bands;
  for (const double r : {0.0, 0.01, 0.05, 0.2}) bands.push_back(*Uncertain::of_band(shape, {r, -r}));
  for (std::size_t k = 0; k + 1 < bands.size(); ++k) {
    EXPECT_TRUE(lies_in(bands[k].outer(), bands[k + 1].outer()));
    EXPECT_TRUE(lies_in(bands[k + 1].inner(), bands[k].inner()));
    const Uncertain known = *Uncertain::known(shapes::letter_l(1, 1, 0.5));
    EXPECT_TRUE(lies_in(minkowski_sum(bands[k], known)->outer(), minkowski_sum(bands[k + 1], known)->outer()));
    EXPECT_TRUE(lies_in(minkowski_sum(bands[k + 1], known)->inner(), minkowski_sum(bands[k], known)->inner()));
  }
}

TEST(Uncertain, BandsDropWhatHasNoAreaWhereItIsOffsetInside) {
  const Region mixed = *Region::create({{box(0, 0, 4, 4).parts()[0]}, {{{5, 0}, {6, 0}}}, {{8, 8}}});
  const Uncertain band = *Uncertain::of_band(mixed, {0.5, -0.5, 4});
  EXPECT_EQ(band.inner().parts.size(), 1u);
  EXPECT_TRUE(band.inner().segments.empty() && band.inner().points.empty());
  EXPECT_EQ(band.outer().parts.size(), 2u);  // box and line are joined
  const Uncertain thin = *Uncertain::of_band(*Region::create({{}, {}, {{1, 2}}}), {0, -1});
  EXPECT_TRUE(thin.inner().parts.empty() && thin.inner().points.empty());
  EXPECT_EQ(thin.outer().points.size(), 1u);
}

TEST(Uncertain, RegionsWithVerticesInTheirBoxesLieBetween) {
  Random random(7);
  std::mt19937_64 bits(8);
  int tried = 0, touched = 0;
  for (int round = 0; round < rounds(60); ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    const CoordinateKind kind = kCoordinateKinds[static_cast<std::size_t>(round) % kCoordinateKinds.size()];
    const Result<Region> nominal = Region::create(of_kind(small_region(random, 6).data(), kind, bits));
    if (!nominal) continue;
    std::vector<std::array<double, 4>> boxes;
    const double size = 0.125 * (1 + random.below(4));
    vertices_by(nominal->data(), [&](Point p) {
      std::array<double, 4> b{p.x, p.y, p.x, p.y};
      for (double& c : b) c += random.chance(30) ? 0 : (&c - b.data() < 2 ? -size : size);
      boxes.push_back(b);
      return p;
    });
    const Uncertain zones = *Uncertain::of_boxes(*nominal, boxes);
    EXPECT_TRUE(lies_in(zones.inner(), zones.outer()));
    for (int member = 0; member < 12; ++member) {
      std::size_t k = 0;
      const Result<Region> variant = Region::create(vertices_by(nominal->data(), [&](Point) {
        const auto& b = boxes[k++];
        const auto pick = [&](double low, double high) {
          const int how = random.below(3);
          return how == 0   ? low
                 : how == 1 ? high
                            : std::clamp(low + (high - low) * (random.signed_unit() + 1) / 2, low, high);
        };
        return Point{pick(b[0], b[2]), pick(b[1], b[3])};
      }));
      if (!variant) continue;
      ++tried;
      EXPECT_TRUE(lies_in(zones.inner(), *variant));
      EXPECT_TRUE(lies_in(*variant, zones.outer()));
      touched += !lies_in(*variant, *nominal);
    }
  }
  EXPECT_GT(tried, 100 / (kSanitized ? 4 : 1));
  EXPECT_GT(touched, 40 / (kSanitized ? 4 : 1));
}

// A triangle with boxes at its corners. Which side of an edge a position is on is bilinear in the edge's ends, so what
// all variants have in common is what those with vertices at corners of boxes have; and these reach all vertices of the
// outer set.
TEST(Uncertain, ZonesAreNoWiderThanTheirVariants) {
  const Region triangle = polygon({{0, 0}, {8, 0}, {0, 8}});
  std::vector<std::array<double, 4>> boxes;
  for (const Point p : triangle.parts()[0].outer) boxes.push_back({p.x - 1, p.y - 1, p.x + 1, p.y + 1});
  const Uncertain zones = *Uncertain::of_boxes(triangle, boxes);
  std::vector<PlanarOperand> all;
  std::vector<Region> variants;
  const auto corner = [&](std::size_t k, int c) {
    return Point{boxes[k][c % 2 == 0 ? 0 : 2], boxes[k][c / 2 == 0 ? 1 : 3]};
  };
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b)
      for (int c = 0; c < 4; ++c) variants.push_back(polygon({corner(0, a), corner(1, b), corner(2, c)}));
  all.assign(variants.begin(), variants.end());
  const SumLocator reached(*united(all));
  for (const RationalPoint& v : vertices_of(zones.outer())) EXPECT_TRUE(reached.contains_rational(v));
  EXPECT_EQ(zones.inner().area_exact(), intersection(all)->area_exact());
}

TEST(Uncertain, DiscsAboutVerticesHoldWhatBoxesInThemHold) {
  const Region shape = shapes::star(5, 1, 2.5);
  const std::vector<double> radii(shape.vertex_count(), 0.1);
  const Uncertain discs = *Uncertain::of_discs(shape, radii);
  EXPECT_GT(discs.error(), 0);
  EXPECT_LT(discs.error(), 0.1 * 0.005);
  std::vector<std::array<double, 4>> inside, around;
  for (const Point p : shape.parts()[0].outer) {
    const double h = 0.0707, w = 0.1 + discs.error();
    inside.push_back({p.x - h, p.y - h, p.x + h, p.y + h});
    around.push_back({p.x - w, p.y - w, p.x + w, p.y + w});
  }
  const Uncertain small = *Uncertain::of_boxes(shape, inside), large = *Uncertain::of_boxes(shape, around);
  EXPECT_TRUE(lies_in(small.outer(), discs.outer()) && lies_in(discs.outer(), large.outer()));
  EXPECT_TRUE(lies_in(large.inner(), discs.inner()) && lies_in(discs.inner(), small.inner()));
  // Some known: nothing is uncertain there.
  std::vector<double> one(shape.vertex_count(), 0.0);
  one[3] = 0.1;
  const Uncertain single = *Uncertain::of_discs(shape, one);
  EXPECT_TRUE(lies_in(shape, single.outer()) && lies_in(single.inner(), shape));
  EXPECT_EQ(single.doubtful()->parts.size(), 1u);
}

TEST(Uncertain, PolylinesAndPointsAreInTheirZonesAndNowhereProvably) {
  const Region thin = *Region::create({{}, {{{0, 0}, {4, 0}}}, {{9, 9}}});
  const std::vector<std::array<double, 4>> boxes{{-1, 0, 0, 0}, {4, 0, 5, 0}, {8, 8, 10, 10}};
  const Uncertain zones = *Uncertain::of_boxes(thin, boxes);
  ASSERT_EQ(zones.outer().segments.size(), 1u);
  EXPECT_EQ(zones.outer().segments[0].from.at, (Point{-1, 0}));
  EXPECT_EQ(zones.outer().segments[0].to.at, (Point{5, 0}));
  EXPECT_EQ(zones.outer().area_exact(), ratio(4));
  EXPECT_TRUE(zones.inner().parts.empty() && zones.inner().segments.empty());
}

TEST(Uncertain, RoundingIsByUnitsInTheLastPlace) {
  const Region slot = box(0, 0, 0.3, 1);
  const Uncertain rounded = *Uncertain::of_rounding(slot, 1);
  const auto high = [](const PlanarSum& set) {
    Rational most = 0;
    for (const RationalPoint& v : vertices_of(set)) most = std::max(most, v.x);
    return most.to_double();
  };
  EXPECT_EQ(high(rounded.outer()), std::nextafter(0.3, 1));
  EXPECT_EQ(high(Uncertain::of_rounding(slot, 5)->outer()), 0.3 + 5 * (std::nextafter(0.3, 1) - 0.3));
  EXPECT_TRUE(lies_in(rounded.inner(), slot) && lies_in(slot, rounded.outer()));
  EXPECT_FALSE(rounded.exact());
  // Zero has neighbours on both sides, and powers of two have nearer ones below.
  const Uncertain near_zero = *Uncertain::of_rounding(box(0, 0, 1, 1), 1);
  Rational low = 0, top = 0;
  for (const RationalPoint& v : vertices_of(near_zero.outer())) low = std::min(low, v.x), top = std::max(top, v.y);
  EXPECT_EQ(low, *Rational::of(-0x1p-1074));
  EXPECT_EQ(top, *Rational::of(1 + 0x1p-52));
}

TEST(Uncertain, ScalesAndAnglesOfAnIntervalLieBetween) {
  Random random(9);
  const Region shape = shapes::letter_l(3, 2, 1);
  const Uncertain scales = *Uncertain::of_scales(shape, *Scale::parse("0.9"), *Scale::parse("1.2"));
  const Uncertain angles = *Uncertain::of_angles(shape, *Orientation::nearest(0.1), *Orientation::nearest(0.3), 0.01);
  for (int k = 0; k <= 12; ++k) {
    const Rational s = ratio(9, 10) + ratio(k, 40);
    const ScalingFamily one = *ScalingFamily::create(shape, origin(), *Scale::of(s), *Scale::of(s));
    const PlanarSum scaled = *one.at(*Scale::of(s));
    EXPECT_TRUE(lies_in(scales.inner(), scaled) && lies_in(scaled, scales.outer()));
    const PlanarSum turned =
        *rotated_sum(shape, origin(), *Orientation::nearest(0.1 + k / 60.0 - (k == 12 ? 1e-9 : 0)));
    EXPECT_TRUE(lies_in(angles.inner(), turned) && lies_in(turned, angles.outer()));
  }
  EXPECT_FALSE(scales.inner().parts.empty() || angles.inner().parts.empty());
  const Uncertain fixed = *Uncertain::of_scales(shape, *Scale::parse("3/2"), *Scale::parse("3/2"));
  EXPECT_TRUE(fixed.exact());
  EXPECT_EQ(fixed.inner().area_exact(), ratio(9, 4) * united(shape, shape)->area_exact());
  const Orientation quarter = *Orientation::parse("1");
  const Uncertain turned = *Uncertain::of_angles(shape, quarter, quarter, 1);
  EXPECT_TRUE(turned.exact());
  EXPECT_EQ(turned.outer(), *rotated_sum(shape, origin(), quarter));
}

TEST(Uncertain, AnyPairOfSetsWhereOneLiesInTheOther) {
  const Uncertain pair = *Uncertain::between(box(1, 1, 2, 2), box(0, 0, 3, 3));
  EXPECT_EQ(pair.doubtful()->area_exact(), ratio(8));
  EXPECT_FALSE(pair.exact());
  EXPECT_TRUE(Uncertain::between(box(0, 0, 3, 3), box(0, 0, 3, 3))->exact());
  EXPECT_TRUE(Uncertain::between(Region(), box(0, 0, 3, 3)).ok());
  const Result<Uncertain> wrong = Uncertain::between(box(0, 0, 3, 3), box(1, 1, 4, 4));
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().code, ErrorCode::out_of_range);
  EXPECT_EQ(wrong.error().evidence.x, 0);
  EXPECT_EQ(wrong.error().evidence.y, 0);
  // A point outside is enough.
  EXPECT_FALSE(Uncertain::between(*Region::create({{}, {}, {{5, 5}}}), box(0, 0, 3, 3)));
}

TEST(Uncertain, RefusesWhatItCannotUse) {
  const Region b = box(0, 0, 2, 2);
  const auto code = [](const auto& result) { return result ? std::nullopt : std::optional(result.error().code); };
  EXPECT_EQ(code(Uncertain::of_variants({})), ErrorCode::out_of_range);
  EXPECT_EQ(code(Uncertain::of_band(b, {-0.1, 0.1})), ErrorCode::out_of_range);
  EXPECT_EQ(code(Uncertain::of_band(b, {NAN, 0})), ErrorCode::out_of_range);
  EXPECT_EQ(code(Uncertain::of_band(b, {INFINITY, 0})), ErrorCode::out_of_range);
  EXPECT_EQ(code(Uncertain::of_band(b, {0.1, 0, 7})), ErrorCode::out_of_range);
  const std::vector<std::array<double, 4>> few(3), off(4, {5, 5, 6, 6});
  EXPECT_EQ(code(Uncertain::of_boxes(b, few)), ErrorCode::out_of_range);
  const Result<Uncertain> beside = Uncertain::of_boxes(b, off);
  EXPECT_EQ(code(beside), ErrorCode::out_of_range);
  EXPECT_EQ(beside.error().evidence.vertex, 0);
  const std::vector<double> negative{0, 0, -1, 0};
  const Result<Uncertain> disc = Uncertain::of_discs(b, negative);
  EXPECT_EQ(code(disc), ErrorCode::out_of_range);
  EXPECT_EQ(disc.error().evidence.vertex, 2);
  EXPECT_EQ(code(Uncertain::of_rounding(b, -1)), ErrorCode::out_of_range);
  EXPECT_EQ(code(Uncertain::of_rounding(box(0, 0, 0x1.fffffffffffffp1023, 1), 1)), ErrorCode::out_of_range);
  EXPECT_EQ(code(Uncertain::known(box(0, 0, 0x1p1010, 1))), ErrorCode::unsupported_operand);
  EXPECT_EQ(code(Uncertain::of_scales(b, *Scale::parse("2"), *Scale::parse("1"))), ErrorCode::bad_scale);
  EXPECT_EQ(code(Uncertain::of_angles(b, *Orientation::parse("0"), *Orientation::parse("1"), 0)),
            ErrorCode::out_of_range);
  // A part of which nothing is known to be there fits everywhere, perhaps.
  EXPECT_EQ(code(erode(*Uncertain::known(b), *Uncertain::of_band(box(0, 0, 1, 1), {1, -1}))),
            ErrorCode::unsupported_operand);
}

}  // namespace
}  // namespace dymsum::oracles
