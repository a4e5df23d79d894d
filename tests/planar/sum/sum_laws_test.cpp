// Laws of Minkowski sums, compared exactly, on tiny-grid pairs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "oracles/exact_shape.h"
#include "oracles/pair_text.h"
#include "oracles/tiny_regions.h"
#include "planar/position/exact_source.h"

namespace dymsum::oracles {
namespace {

constexpr std::uint64_t kSeed = 3141592;
constexpr int kPairs = 120;

Region made(const RegionData& data) {
  Result<Region> region = Region::create(data);
  if (!region.ok()) throw std::runtime_error(region.error().to_string() + "\n" + to_wkt(data));
  return *std::move(region);
}

PlanarSum sum_of(const RegionData& p, const RegionData& q, const SumOptions& options = {}) {
  return minkowski_sum(made(p), made(q), options).value();
}

ExactShape<Big> shape_of(const PlanarSum& sum) { return canonical(exact_shape<Big>(sum)); }
ExactShape<Big> shape_of(const RegionData& p, const RegionData& q) { return shape_of(sum_of(p, q)); }

Affine<Big> linear(int a, int b, int c, int d) { return {Big(a), Big(b), Big(c), Big(d), {Big(0), Big(0)}}; }

/// Calls check(p, q) for random pairs and names the first pair that fails.
template <class Check>
void for_pairs(int count, const Check& check) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kSeed));
  for (int k = 0; k < count; ++k) {
    Random random(kSeed + static_cast<std::uint64_t>(k));
    const auto [p, q] = random_pair(random, 4);
    SCOPED_TRACE("pair " + std::to_string(k) + "\n" + to_text(p, q));
    check(p, q, random);
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(SumLaws, commutes) {
  for_pairs(kPairs,
            [](const RegionData& p, const RegionData& q, Random&) { EXPECT_TRUE(sum_of(p, q) == sum_of(q, p)); });
}

TEST(SumLaws, nfp_is_the_sum_with_the_reflected_operand) {
  for_pairs(kPairs, [](const RegionData& p, const RegionData& q, Random&) {
    EXPECT_TRUE(nfp(made(p), made(q)).value() == minkowski_sum(made(p), negated(made(q))).value());
  });
}

TEST(SumLaws, translates) {
  for_pairs(kPairs, [](const RegionData& p, const RegionData& q, Random& random) {
    const double dx = random.below(2001) - 1000.25, dy = random.below(2001) * 1024.0;
    Affine<Big> map = linear(1, 0, 0, 1);
    map.move = {from_double<Big>(dx), from_double<Big>(dy)};
    const ExactShape<Big> want = mapped(shape_of(p, q), map);
    EXPECT_TRUE(shape_of(moved(p, dx, dy), q) == want);
    EXPECT_TRUE(shape_of(p, moved(q, dx, dy)) == want);
  });
}

TEST(SumLaws, follows_every_common_linear_map) {
  constexpr int kMaps[][4] = {{3, 0, 0, 3},   {8, 0, 0, 8},  {-1, 0, 0, 1}, {1, 0, 0, -1}, {0, 1, 1, 0},
                              {-1, 0, 0, -1}, {0, -1, 1, 0}, {2, 1, 1, 1},  {1, 0, -3, 1}, {5, 0, 0, 1}};
  for_pairs(kPairs, [&](const RegionData& p, const RegionData& q, Random& random) {
    const int* m = kMaps[random.below(10)];
    EXPECT_TRUE(shape_of(mapped(p, m[0], m[1], m[2], m[3]), mapped(q, m[0], m[1], m[2], m[3])) ==
                mapped(shape_of(p, q), linear(m[0], m[1], m[2], m[3])))
        << m[0] << " " << m[1] << " " << m[2] << " " << m[3];
  });
}

/// The least number whose product with every vertex of the sums is integer.
double common_denominator(const std::vector<ExactShape<Big>>& shapes) {
  BigInt out = 1;
  for (const auto& shape : shapes)
    for (const auto& part : shape.parts) {
      const auto take = [&](const ExactRing<Big>& ring) {
        for (const Pt<Big>& c : ring)
          out = boost::multiprecision::lcm(out, boost::multiprecision::lcm(denominator_of(c.x), denominator_of(c.y)));
      };
      take(part.outer);
      for (const auto& hole : part.holes) take(hole);
    }
  return out.convert_to<double>();
}

RegionData times(const RegionData& region, double factor) { return mapped(region, factor, 0, 0, factor); }

RegionData rounded_parts(const PlanarSum& sum) {
  const Result<Region> region = sum.rounded();
  if (!region.ok()) throw std::runtime_error(region.error().to_string());
  RegionData data = region->data();
  data.polylines.clear();
  data.points.clear();
  return data;
}

std::vector<ExactPart<Big>> parts_of(const PlanarSum& sum) { return shape_of(sum).parts; }

TEST(SumLaws, distributes_over_union) {
  int joined = 0;
  for_pairs(kPairs, [&](const RegionData&, const RegionData&, Random& random) {
    const RegionData a = random_parts(random, 4), b = random_parts(random, 4), q = random_parts(random, 3);
    const PlanarSum both = union_of({made(a), made(b)}).value();
    const double k = common_denominator({shape_of(both)});
    const RegionData whole = rounded_parts(union_of({made(times(a, k)), made(times(b, k))}).value());
    const double m = common_denominator({shape_of(times(a, k), times(q, k)), shape_of(times(b, k), times(q, k))});
    if (k * m > 1e9) return;
    const PlanarSum left = sum_of(times(whole, m), times(q, k * m));
    const RegionData one = rounded_parts(sum_of(times(a, k * m), times(q, k * m)));
    const RegionData two = rounded_parts(sum_of(times(b, k * m), times(q, k * m)));
    const PlanarSum right = union_of({made(one), made(two)}).value();
    EXPECT_TRUE(parts_of(left) == parts_of(right)) << to_text(a, b) << to_wkt(q);
    ++joined;
  });
  EXPECT_GT(joined, kPairs / 2);
}

TEST(SumLaws, associates) {
  int compared = 0;
  for_pairs(kPairs / 2, [&](const RegionData&, const RegionData&, Random& random) {
    const RegionData a = random_parts(random, 3), b = random_parts(random, 3), c = random_parts(random, 2);
    const double k = common_denominator({shape_of(a, b), shape_of(b, c)});
    if (k > 1e6) return;
    const RegionData ab = rounded_parts(sum_of(times(a, k), times(b, k))),
                     bc = rounded_parts(sum_of(times(b, k), times(c, k)));
    EXPECT_TRUE(parts_of(sum_of(ab, times(c, k))) == parts_of(sum_of(times(a, k), bc))) << to_text(a, b) << to_wkt(c);
    ++compared;
  });
  EXPECT_GT(compared, kPairs / 4);
}

TEST(SumLaws, is_monotone) {
  int compared = 0;
  for_pairs(kPairs, [&](const RegionData&, const RegionData&, Random& random) {
    const RegionData p = random_parts(random, 4), q = random_parts(random, 3);
    RegionData less = p, more = p;  // one part less, or one hole filled
    if (p.parts.size() > 1) {
      less.parts.pop_back();
    } else if (!p.parts[0].holes.empty()) {
      more.parts[0].holes.pop_back();
    } else {
      return;
    }
    const double k = common_denominator({shape_of(more, q), shape_of(less, q)});
    if (k > 1e9) return;
    const RegionData small = rounded_parts(sum_of(times(less, k), times(q, k)));
    const RegionData large = rounded_parts(sum_of(times(more, k), times(q, k)));
    EXPECT_TRUE(parts_of(union_of({made(small), made(large)}).value()) == parts_of(union_of({made(large)}).value()));
    ++compared;
  });
  EXPECT_GT(compared, 10);
}

TEST(SumLaws, union_has_the_laws_of_union) {
  for_pairs(kPairs, [](const RegionData&, const RegionData&, Random& random) {
    const RegionData a = random_parts(random, 4), b = random_parts(random, 4);
    const PlanarSum ab = union_of({made(a), made(b)}).value();
    EXPECT_TRUE(ab == union_of({made(b), made(a)}).value());
    EXPECT_TRUE(parts_of(union_of({made(a), made(a)}).value()) == parts_of(union_of({made(a)}).value()));
    RegionData origin;
    origin.points.push_back({0, 0});
    EXPECT_TRUE(union_of({made(a)}).value() == sum_of(a, origin));
  });
}

/// Every ring and closed polyline starts elsewhere, and some edges get their midpoint.
RegionData rewritten(RegionData region, Random& random) {
  const auto rewrite = [&](std::vector<Point>& list, bool closed) {
    std::vector<Point> out;
    for (std::size_t i = 0; i < list.size(); ++i) {
      out.push_back(list[i]);
      if (i + 1 == list.size() && !closed) break;
      const Point& next = list[(i + 1) % list.size()];
      if (random.chance(50)) out.push_back({(list[i].x + next.x) / 2, (list[i].y + next.y) / 2});
    }
    if (closed) std::rotate(out.begin(), out.begin() + random.below(static_cast<int>(out.size())), out.end());
    list = std::move(out);
  };
  for (Part& part : region.parts) {
    rewrite(part.outer, true);
    for (Ring& hole : part.holes) rewrite(hole, true);
    std::reverse(part.holes.begin(), part.holes.end());
  }
  for (Polyline& line : region.polylines) rewrite(line, false);
  std::reverse(region.parts.begin(), region.parts.end());
  std::reverse(region.points.begin(), region.points.end());
  return region;
}

TEST(SumLaws, start_vertices_inserted_collinear_vertices_and_order_do_not_matter) {
  for_pairs(kPairs, [](const RegionData& p, const RegionData& q, Random& random) {
    EXPECT_TRUE(sum_of(p, q) == sum_of(rewritten(p, random), rewritten(q, random)));
  });
}

TEST(SumLaws, number_tiers_agree) {
  constexpr int kTiers[][2] = {{29, 29}, {61, 61}, {512, 512}, {1000, 0}};  // asked for, reported
  for_pairs(kPairs, [&](const RegionData& p, const RegionData& q, Random&) {
    for (const Engine engine : {Engine::fast, Engine::brute, Engine::winding}) {
      SumOptions options;
      options.engine = engine;
      const PlanarSum least = sum_of(p, q, options);
      EXPECT_EQ(least.stats.tier_bits, 29);
      for (const auto& [queried, reported] : kTiers) {
        planar::SumInternals::min_tier_bits(options) = queried;
        const PlanarSum sum = sum_of(p, q, options);
        EXPECT_EQ(sum.stats.tier_bits, reported);
        EXPECT_TRUE(sum == least) << "tier " << queried;
      }
    }
  });
}

TEST(SumLaws, huge_and_minute_coordinates_only_scale) {
  for_pairs(kPairs / 2, [](const RegionData& p, const RegionData& q, Random&) {
    const ExactShape<Big> unit = shape_of(p, q);
    for (const int power : {26, 58, 500, 960, -30, -900}) {
      const double factor = std::ldexp(1.0, power);
      Affine<Big> map = linear(0, 0, 0, 0);
      map.xx = map.yy = from_double<Big>(factor);
      EXPECT_TRUE(shape_of(times(p, factor), times(q, factor)) == mapped(unit, map)) << "2^" << power;
    }
  });
}

/// P 2^b times larger than Q: the widest differences a tier has to carry.
TEST(SumLaws, operands_of_very_different_size_agree_across_tiers) {
  for_pairs(kPairs / 2, [](const RegionData& p, const RegionData& q, Random& random) {
    for (const int power : {25, 40, 57, 300}) {
      const RegionData large = times(p, std::ldexp(1.0, power));
      const PlanarSum sum = sum_of(large, q);
      SumOptions options;
      planar::SumInternals::min_tier_bits(options) = 1000;
      options.engine = random.chance(50) ? Engine::brute : Engine::winding;
      EXPECT_TRUE(sum == sum_of(large, q, options)) << "2^" << power;
    }
  });
}

TEST(SumLaws, sum_with_the_empty_region_is_empty) {
  for_pairs(20, [](const RegionData& p, const RegionData&, Random&) {
    for (const Engine engine : {Engine::fast, Engine::brute, Engine::winding}) {
      SumOptions options;
      options.engine = engine;
      for (const PlanarSum& sum : {sum_of(p, {}, options), sum_of({}, p, options), sum_of({}, {}, options)}) {
        EXPECT_TRUE(sum.parts.empty() && sum.segments.empty() && sum.points.empty());
        EXPECT_TRUE(sum.tight_segments.empty() && sum.tight_points.empty());
        EXPECT_EQ(sum.area_exact(), *Rational::of(0, 1));
      }
    }
  });
}

TEST(SumLaws, convex_operand_with_itself_doubles) {
  Random random(kSeed);
  for (int k = 0; k < 40; ++k) {
    RegionData p;
    p.parts.push_back({random_polygon(random, 5, 3), {}});
    const PlanarSum sum = sum_of(p, p);
    RegionData origin;
    origin.points.push_back({0, 0});
    EXPECT_TRUE(shape_of(sum) == mapped(shape_of(p, origin), linear(2, 0, 0, 2)));
  }
}

/// Distance of a double from an exact number, and whether no neighbour is nearer.
bool nearest(double rounded, const Big& exact) {
  const auto distance = [&](double value) {
    const Big gap = from_double<Big>(value) - exact;
    return gap < 0 ? Big(-gap) : gap;
  };
  const Big here = distance(rounded);
  return here <= distance(std::nextafter(rounded, INFINITY)) && here <= distance(std::nextafter(rounded, -INFINITY));
}

bool nearest(const Point& rounded, const Pt<Big>& exact) {
  return nearest(rounded.x, exact.x) && nearest(rounded.y, exact.y);
}

/// The rounded ring's vertices are the exact ones in order; where another vertex touches an edge, it may be named in
/// between.
void expect_rounded(const Ring& have, const ExactRing<Big>& want, const std::vector<Pt<Big>>& all) {
  std::size_t next = 0;
  for (const Point& c : have) {
    if (next < want.size() && nearest(c, want[next])) {
      ++next;
    } else {
      EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const Pt<Big>& other) { return nearest(c, other); }));
    }
  }
  EXPECT_EQ(next, want.size());
}

TEST(SumLaws, rounded_vertices_are_the_nearest_doubles) {
  int rounded_pairs = 0;
  for_pairs(kPairs, [&](const RegionData& p, const RegionData& q, Random&) {
    const PlanarSum sum = sum_of(p, q);
    const Result<Region> region = sum.rounded();
    if (!region.ok()) {
      EXPECT_EQ(region.error().code, ErrorCode::rounding_changed_topology);
      return;
    }
    ++rounded_pairs;
    const ExactShape<Big> shape = exact_shape<Big>(sum);
    std::vector<Pt<Big>> all = shape.points;
    for (const Seg<Big>& s : shape.segments) all.insert(all.end(), {s.a, s.b});
    for (const auto& part : shape.parts) {
      all.insert(all.end(), part.outer.begin(), part.outer.end());
      for (const auto& hole : part.holes) all.insert(all.end(), hole.begin(), hole.end());
    }
    ASSERT_EQ(region->parts().size(), shape.parts.size());
    for (std::size_t i = 0; i < shape.parts.size(); ++i) {
      expect_rounded(region->parts()[i].outer, shape.parts[i].outer, all);
      ASSERT_EQ(region->parts()[i].holes.size(), shape.parts[i].holes.size());
      for (std::size_t k = 0; k < shape.parts[i].holes.size(); ++k)
        expect_rounded(region->parts()[i].holes[k], shape.parts[i].holes[k], all);
    }
  });
  EXPECT_GT(rounded_pairs, kPairs * 9 / 10);
}

TEST(SumLaws, area_is_the_area_of_the_rings) {
  for_pairs(kPairs, [](const RegionData& p, const RegionData& q, Random&) {
    const PlanarSum sum = sum_of(p, q);
    Big doubled(0);
    for (const auto& part : shape_of(sum).parts) {
      doubled += doubled_area(part.outer);
      for (const auto& hole : part.holes) doubled += doubled_area(hole);
    }
    const Rational area = sum.area_exact();
    EXPECT_TRUE(from_digits<Big>(area.numerator(), area.denominator()) * 2 == doubled);
  });
}

}  // namespace
}  // namespace dymsum::oracles
