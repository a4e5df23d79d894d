#include "dymsum/snap_rounding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "dymsum/shapes.h"
#include "exact/big.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/random.h"
#include "oracles/snapped_shapes.h"
#include "oracles/tiny_regions.h"
#include "planar/region/snapped_rings.h"
#include "planar/sum/listed_source.h"

namespace dymsum {
namespace {

using SnapQ = exact::BigRational;

struct SnapPoint {
  SnapQ x, y;
};
struct SnapSegment {
  SnapPoint a, b;
};

SnapPoint snap_point(Point p) { return {exact::exact_value(p.x), exact::exact_value(p.y)}; }
SnapPoint snap_point(const RationalPoint& p) { return {exact::exact_value(p.x), exact::exact_value(p.y)}; }

SnapPoint between(const SnapSegment& s, int k, int of) {
  return {s.a.x + (s.b.x - s.a.x) * k / of, s.a.y + (s.b.y - s.a.y) * k / of};
}

bool is_near(const SnapSegment& s, const SnapPoint& p, double most) {
  // What doubles distinguish apart is.
  const auto d = [](const SnapQ& v) { return v.convert_to<double>(); };
  const double slack = 1e-6 * (1 + std::abs(d(p.x)) + std::abs(d(p.y)));
  if (d(p.x) < std::min(d(s.a.x), d(s.b.x)) - slack || d(p.x) > std::max(d(s.a.x), d(s.b.x)) + slack ||
      d(p.y) < std::min(d(s.a.y), d(s.b.y)) - slack || d(p.y) > std::max(d(s.a.y), d(s.b.y)) + slack)
    return false;
  const SnapQ ux = s.b.x - s.a.x, uy = s.b.y - s.a.y, px = p.x - s.a.x, py = p.y - s.a.y, length = ux * ux + uy * uy,
              along = ux * px + uy * py, limit = exact::exact_value(most) * exact::exact_value(most);
  if (length == 0 || along <= 0) return px * px + py * py <= limit;
  if (along >= length) {
    const SnapQ qx = p.x - s.b.x, qy = p.y - s.b.y;
    return qx * qx + qy * qy <= limit;
  }
  const SnapQ off = ux * py - uy * px;
  return off * off <= limit * length;
}

bool is_near(const std::vector<SnapSegment>& segments, const SnapPoint& p, double most) {
  return std::any_of(segments.begin(), segments.end(), [&](const SnapSegment& s) { return is_near(s, p, most); });
}

template <class P>
void add_loop(std::vector<SnapSegment>& segments, const std::vector<P>& loop, bool closed) {
  for (std::size_t i = 0; i + (closed ? 0 : 1) < loop.size(); ++i)
    segments.push_back({loop[i], loop[(i + 1) % loop.size()]});
}

/// Of the parts, then of everything else.
struct SnapEdges {
  std::vector<SnapSegment> rings, rest;
  std::vector<SnapSegment> all() const {
    std::vector<SnapSegment> both = rings;
    both.insert(both.end(), rest.begin(), rest.end());
    return both;
  }
};

SnapEdges edges_of(const RegionData& data) {
  SnapEdges edges;
  const auto points = [](const std::vector<Point>& list) {
    std::vector<SnapPoint> made;
    for (const Point p : list) made.push_back(snap_point(p));
    return made;
  };
  for (const Part& part : data.parts) {
    add_loop(edges.rings, points(part.outer), true);
    for (const Ring& hole : part.holes) add_loop(edges.rings, points(hole), true);
  }
  for (const Polyline& line : data.polylines) add_loop(edges.rest, points(line), false);
  for (const Point p : data.points) edges.rest.push_back({snap_point(p), snap_point(p)});
  return edges;
}

SnapEdges edges_of(const PlanarSum& sum) {
  SnapEdges edges;
  const auto ring = [&](const SumRing& r) {
    std::vector<SnapPoint> made;
    for (const SumVertex& v : r.vertices) made.push_back(snap_point(sum.exact(v)));
    add_loop(edges.rings, made, true);
  };
  for (const SumPart& part : sum.parts) {
    ring(part.outer);
    for (const SumRing& hole : part.holes) ring(hole);
  }
  for (const SumSegment& s : sum.segments)
    edges.rest.push_back({snap_point(sum.exact(s.from)), snap_point(sum.exact(s.to))});
  for (const SumVertex& v : sum.points) edges.rest.push_back({snap_point(sum.exact(v)), snap_point(sum.exact(v))});
  return edges;
}

/// The winding number of ring edges about a point on none of them.
int winding(const std::vector<SnapSegment>& rings, const SnapPoint& z) {
  int turns = 0;
  for (const auto& [a, b] : rings) {
    const bool rises = a.y <= z.y && z.y < b.y, falls = b.y <= z.y && z.y < a.y;
    if (!rises && !falls) continue;
    const SnapQ side = (b.x - a.x) * (z.y - a.y) - (b.y - a.y) * (z.x - a.x);
    if (rises && side > 0) ++turns;
    if (falls && side < 0) --turns;
  }
  return turns;
}

double length_of(const std::vector<SnapSegment>& segments) {
  double sum = 0;
  for (const auto& [a, b] : segments)
    sum += std::hypot(SnapQ(b.x - a.x).convert_to<double>(), SnapQ(b.y - a.y).convert_to<double>());
  return sum;
}

/// Every point of one set's boundary that is looked at is in the other set, or near it; boundaries that are left, near
/// exact ones.
void expect_within(const SnapEdges& before, const SnapEdges& after, double moved) {
  const std::vector<SnapSegment> old = before.all(), made = after.all();
  for (const SnapSegment& s : old)
    for (int k = 0; k < 3; ++k) {
      const SnapPoint p = between(s, k, 3);
      ASSERT_TRUE(is_near(made, p, moved) || winding(after.rings, p) > 0);
    }
  for (const SnapSegment& s : made)
    for (int k = 0; k < 3; ++k) ASSERT_TRUE(is_near(old, between(s, k, 3), moved));
}

struct SnapTally {
  int nearest = 0, snapped = 0;
};

void expect_snapped(const Result<PlanarSum>& made, SnapTally& tally) {
  ASSERT_TRUE(made.ok());
  const PlanarSum& sum = *made;
  const Result<SnapRounded> result = snap_rounded(sum);
  ASSERT_TRUE(result.ok()) << result.error().to_string();
  const auto& [region, rounding] = *result;
  if (const Result<Region> nearest = sum.rounded()) {
    EXPECT_EQ(region.data(), nearest->data());
    EXPECT_TRUE(rounding.nearest);
    EXPECT_LE(rounding.moved_ulps, 0.75);
    ++tally.nearest;
    return;
  }
  ++tally.snapped;
  EXPECT_FALSE(rounding.nearest);
  EXPECT_GT(rounding.merged_vertices + rounding.bends + rounding.collapsed_edges, 0u);
  EXPECT_LE(rounding.moved_ulps, 8);
  ASSERT_TRUE(Region::create(region.data()).ok());
  const SnapEdges before = edges_of(sum), after = edges_of(region.data());
  expect_within(before, after, rounding.moved);
  const double change = std::abs(area(region) - sum.area());
  EXPECT_LE(change, rounding.moved * (length_of(before.rings) + length_of(after.all())) + 1e-15 * sum.area());
}

TEST(SnapRounding, TurnedShapesAreAlwaysWritten) {
  SnapTally tally;
  for (const CoordinateKind kind : kCoordinateKinds) {
    SCOPED_TRACE(name_of(kind));
    std::mt19937_64 random(1);
    const auto shape = [&](const Region& region) {
      return Region::create(of_kind(region.data(), kind, random)).value();
    };
    const Region comb = shape(shapes::comb(8, 2, 1, 2)), small = shape(shapes::comb(5, 0.7, 0.3, 1)),
                 l = shape(shapes::letter_l(3, 3, 1)), gear = shape(snapped_shapes::gear(9, 2, 3)),
                 grate = shape(shapes::grate(4, 2, 1, 4));
    expect_snapped(minkowski_sum(comb, small), tally);
    expect_snapped(minkowski_sum(l, l), tally);
    expect_snapped(nfp(l, l), tally);
    expect_snapped(nfp(gear, gear), tally);
    expect_snapped(minkowski_sum(grate, small), tally);
    expect_snapped(erode(grate, l), tally);
  }
  EXPECT_GE(tally.snapped, 3);
  EXPECT_GE(tally.nearest, 3);
}

TEST(SnapRounding, RandomRegionsAreAlwaysWritten) {
  SnapTally tally;
  oracles::Random random(7);
  std::mt19937_64 noise(7);
  for (int trial = 0; trial < 300; ++trial) {
    SCOPED_TRACE(trial);
    const CoordinateKind kind = kCoordinateKinds[static_cast<std::size_t>(trial) % kCoordinateKinds.size()];
    const oracles::Pair pair = oracles::random_pair(random, 4);
    const auto ready = [&](const RegionData& data) { return Region::create(of_kind(data, kind, noise)); };
    const Result<Region> p = ready(pair.p), q = ready(pair.q);
    if (!p || !q) continue;
    expect_snapped(minkowski_sum(*p, *q), tally);
    if (p->polylines().empty() && p->points().empty()) expect_snapped(erode(*p, *q), tally);
    if (HasFatalFailure()) return;
  }
  EXPECT_GE(tally.snapped, 30);
  EXPECT_GE(tally.nearest, 30);
}

/// Rings that cross anyhow: points far from all of them are in the result exactly where these wind around them.
TEST(SnapRounding, RingsOfAnyKindBecomeAValidRegion) {
  oracles::Random random(11);
  std::size_t bends = 0, lines = 0;
  double most = 0;
  for (int trial = 0; trial < 400; ++trial) {
    SCOPED_TRACE(trial);
    // Small integers, a few units in the last place of 1, and anything.
    const auto coordinate = [&] {
      return trial % 3 == 0 ? random.below(5) : trial % 3 == 1 ? 1 + random.below(6) * 0x1p-52 : random.signed_unit();
    };
    RegionData data;
    for (int r = 0; r < 3; ++r) {
      Ring ring;
      for (int k = 0; k < 3 + random.below(5); ++k) {
        const double x = coordinate();
        ring.push_back({x, coordinate()});
      }
      data.parts.push_back({ring, {}});
    }
    const planar::SnappedRings snapped = planar::snapped_rings(data);
    const Result<Region> region = Region::create(snapped.data);
    ASSERT_TRUE(region.ok()) << region.error().to_string();
    bends += snapped.bends, lines += snapped.lines, most = std::max(most, snapped.moved);
    const SnapEdges before = edges_of(data), after = edges_of(snapped.data);
    for (int k = 0; k < 20; ++k) {
      const double unit = trial % 3 == 1 ? 0x1p-52 : 1, origin = trial % 3 == 1 ? 1 : 0;
      const SnapPoint z{exact::exact_value(origin) + exact::exact_value(unit * 5 * random.signed_unit()),
                        exact::exact_value(origin) + exact::exact_value(unit * 5 * random.signed_unit())};
      if (std::any_of(before.rings.begin(), before.rings.end(),
                      [&](const SnapSegment& s) { return is_near(s, z, snapped.moved); }))
        continue;
      ASSERT_EQ(winding(before.rings, z) > 0, winding(after.rings, z) > 0);
    }
    for (const SnapSegment& s : before.rings) {
      const SnapPoint p = between(s, 1, 2);
      ASSERT_TRUE(is_near(after.all(), p, snapped.moved) || winding(after.rings, p) > 0);
    }
    for (const SnapSegment& s : after.all()) ASSERT_TRUE(is_near(before.rings, between(s, 1, 2), snapped.moved));
  }
  EXPECT_GT(bends, 1000u);
  EXPECT_GT(lines, 20u);
  EXPECT_LE(most, 0x1p-50);
}

struct SnapRoundingOfParts : testing::Test {
  std::shared_ptr<ListedSource> source = std::make_shared<ListedSource>();
  PlanarSum sum;

  SnapRoundingOfParts() { exact_source(sum) = source; }
  void part(SumRing outer, std::vector<SumRing> holes = {}) {
    sum.parts.push_back({std::move(outer), std::move(holes)});
  }
};

TEST_F(SnapRoundingOfParts, SliverBecomesALine) {
  part(source->ring({{0, 0}, {1, 0}, {1, 1}}));
  part(source->ring({{2, 0}, {3, 0}, {SnapQ(5, 2), power_of_two(-1100)}}));
  const auto [region, rounding] = snap_rounded(sum).value();
  EXPECT_EQ(region.parts().size(), 1u);
  EXPECT_EQ(region.polylines(), (std::vector<Polyline>{{{2, 0}, {2.5, 0}, {3, 0}}}));
  EXPECT_EQ(rounding.lines, 1u);
  EXPECT_EQ(rounding.vanished_rings, 0u);
}

TEST_F(SnapRoundingOfParts, PartSmallerThanRoundingBecomesAPoint) {
  part(source->ring({{3, 3}, {3 + power_of_two(-90), 3}, {3, 3 + power_of_two(-90)}}));
  const auto [region, rounding] = snap_rounded(sum).value();
  EXPECT_EQ(region.data(), (RegionData{{}, {}, {{3, 3}}}));
  EXPECT_EQ(rounding.points, 1u);
  EXPECT_EQ(rounding.merged_vertices, 2u);
  EXPECT_EQ(rounding.collapsed_edges, 3u);
}

TEST_F(SnapRoundingOfParts, HoleThinnerThanRoundingCloses) {
  part(source->ring({{0, 0}, {4, 0}, {4, 4}, {0, 4}}), {source->ring({{1, 1}, {2, 1 + power_of_two(-90)}, {3, 1}})});
  const auto [region, rounding] = snap_rounded(sum).value();
  EXPECT_EQ(region.data(), (RegionData{{{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {}}}, {}, {}}));
  EXPECT_EQ(rounding.vanished_rings, 1u);
}

TEST_F(SnapRoundingOfParts, HoleThatWouldCrossItsRingTouchesIt) {
  int crossed = 0;
  for (int den = 3; den <= 40; ++den) {
    SCOPED_TRACE(den);
    sum.parts.clear();
    const SnapQ t(1, den), x = 10 * t, y = t + power_of_two(-90);  // above the edge by less than rounding
    part(source->ring({{0, 0}, {10, 1}, {10, 9}, {0, 9}}), {source->ring({{x, y}, {1, 8}, {8, 8}})});
    const auto [region, rounding] = snap_rounded(sum).value();
    EXPECT_LE(rounding.moved_ulps, 2);
    EXPECT_NEAR(area(region), sum.area(), 1e-13);
    crossed += rounding.bends > 0;
  }
  EXPECT_GE(crossed, 5);
}

TEST_F(SnapRoundingOfParts, CoordinatesPastTheDoubleRangeAreAnError) {
  part(source->ring({{0, 0}, {power_of_two(1200), 0}, {0, 1}}));
  EXPECT_EQ(snap_rounded(sum).error().code, ErrorCode::rounding_changed_topology);
}

TEST_F(SnapRoundingOfParts, EmptySumIsTheEmptyRegion) {
  const auto [region, rounding] = snap_rounded(PlanarSum()).value();
  EXPECT_TRUE(region.empty());
  EXPECT_EQ(rounding, Rounding());
}

}  // namespace
}  // namespace dymsum
