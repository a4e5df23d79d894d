// Convex polygons that turn and scale: the planar engine's sum at every pose, moved or fresh, with the work that it
// should take.
#include "thesis/convex_polygon_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "dymsum/planar_sum.h"
#include "dymsum/shapes.h"
#include "exact/big.h"
#include "oracles/sanitized.h"
#include "oracles/snapped_shapes.h"
#include "planar/motion/orientation.h"

namespace dymsum {
namespace {

using exact::BigRational;
using Ring_ = std::vector<std::array<BigRational, 2>>;

const double kPi = std::acos(-1.0);
constexpr std::uint64_t kSeed = 61;

std::mt19937_64 seeded(std::uint64_t more) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kSeed + more));
  return std::mt19937_64(kSeed + more);
}

Region polygon(const Ring& ring) { return *Region::create({{{ring, {}}}, {}, {}}); }

double side(Point a, Point b, Point c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

/// The hull of random grid points, with points on its edges kept when `collinear`.
Region random_convex(std::mt19937_64& random, int points, int size, bool collinear = false) {
  for (;;) {
    std::vector<Point> at;
    for (int k = 0; k < points; ++k)
      at.push_back({double(int(random() % (2 * size + 1)) - size), double(int(random() % (2 * size + 1)) - size)});
    std::sort(at.begin(), at.end(), [](Point a, Point b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); });
    at.erase(std::unique(at.begin(), at.end()), at.end());
    Ring ring;
    for (int pass = 0; pass < 2; ++pass) {
      const std::size_t from = ring.size();
      for (const Point p : at) {
        while (ring.size() >= from + 2 && (collinear ? side(ring[ring.size() - 2], ring.back(), p) < 0
                                                     : side(ring[ring.size() - 2], ring.back(), p) <= 0))
          ring.pop_back();
        ring.push_back(p);
      }
      ring.pop_back();
      std::reverse(at.begin(), at.end());
    }
    if (Result<Region> region = Region::create({{{ring, {}}}, {}, {}})) return *std::move(region);
  }
}

PlanarPose turn(const Orientation& r) { return {r, {}}; }
Orientation half(std::int64_t u, std::int64_t v) { return *Orientation::of(v, u); }
/// u, v of half(u, v).
std::array<std::int64_t, 2> half_of(const Orientation& r) {
  const auto [n, d] = planar::tan_half_of(r);
  return {static_cast<std::int64_t>(d), static_cast<std::int64_t>(n)};
}

/// The polygon posed and enlarged by an integer that makes integers of its coordinates, which have to be small integers
/// themselves.
Region enlarged(const Region& region, const PlanarPose& pose, std::int64_t factor) {
  const auto [u, v] = half_of(pose.rotation);
  const std::int64_t norm = u * u + v * v;
  const auto times = [&](const Scale& s) {
    const BigRational exact = exact::exact_value(s.exact()) * factor / norm;
    EXPECT_EQ(denominator(exact), 1);
    return static_cast<double>(numerator(exact));
  };
  const double sx = times(pose.scale[0]), sy = times(pose.scale[1]), c = double(u * u - v * v), s = double(2 * u * v);
  Ring ring;
  for (const Point p : region.parts()[0].outer)
    ring.push_back({c * sx * p.x - s * sy * p.y, s * sx * p.x + c * sy * p.y});
  return polygon(ring);
}

Ring_ canonical(Ring_ ring) {
  std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end()), ring.end());
  return ring;
}
Ring_ ring_of(const PolygonSum& sum, std::int64_t factor = 1) {
  Ring_ ring;
  for (const RationalPoint& p : sum.exact)
    ring.push_back({exact::exact_value(p.x) * factor, exact::exact_value(p.y) * factor});
  return canonical(ring);
}
Ring_ ring_of(const PlanarSum& sum) {
  EXPECT_EQ(sum.parts.size(), 1u);
  EXPECT_EQ(sum.hole_count() + sum.segments.size() + sum.points.size(), 0u);
  Ring_ ring;
  for (const SumVertex& v : sum.parts.at(0).outer.vertices) {
    const RationalPoint p = sum.exact(v);
    ring.push_back({exact::exact_value(p.x), exact::exact_value(p.y)});
  }
  return canonical(ring);
}

/// Fresh, rebuilt and the planar engine on enlarged copies: the same set.
void expect_engine(const Region& p, const Region& q, ConvexPolygonSum& moving, std::int64_t factor) {
  const PlanarPose a = moving.p_pose(), b = moving.q_pose();
  const PlanarSum engine = *minkowski_sum(enlarged(p, a, factor), enlarged(q, b, factor));
  ASSERT_EQ(ring_of(moving.sum(), factor), ring_of(engine));
}
void expect_as_rebuilt(const ConvexPolygonSum& moving, const Region& p, const Region& q) {
  ConvexPolygonSum rebuilt = moving, fresh = *ConvexPolygonSum::create(p, q);
  rebuilt.rebuild();
  fresh.set(moving.p_pose(), moving.q_pose());
  ASSERT_TRUE(moving.same_combinatorics(rebuilt));
  ASSERT_TRUE(moving.same_combinatorics(fresh));
  ASSERT_EQ(moving.sum(), rebuilt.sum());
}

TEST(ConvexPolygonSum, equals_the_planar_engine_at_the_identity) {
  std::mt19937_64 random = seeded(0);
  for (int k = 0; k < 150; ++k) {
    const int size = k % 3 == 0 ? 2 : k % 3 == 1 ? 10 : 1000;
    const Region p = random_convex(random, 3 + static_cast<int>(random() % 20), size, k % 2),
                 q = random_convex(random, 3 + static_cast<int>(random() % 9), size, k % 4 < 2);
    ConvexPolygonSum sum = *ConvexPolygonSum::create(p, q);
    expect_engine(p, q, sum, 1);
    const PlanarSum engine = *minkowski_sum(p, q);
    ASSERT_EQ(sum.sum().area_exact(), engine.area_exact());
    const std::vector<Point> rounded = sum.sum().rounded();
    ASSERT_EQ(*Region::create({{{rounded, {}}}, {}, {}}), *engine.rounded());
  }
}

TEST(ConvexPolygonSum, equals_the_planar_engine_at_exact_turns_and_scales) {
  std::mt19937_64 random = seeded(1);
  std::size_t merged = 0;
  for (int k = 0; k < 60; ++k) {
    const Region p = random_convex(random, 4 + k % 12, 4), q = k % 3 == 0   ? p
                                                               : k % 3 == 1 ? negated(p)
                                                                            : random_convex(random, 10, 4);
    ConvexPolygonSum moving = *ConvexPolygonSum::create(p, q);
    for (int move = 0; move < 8; ++move) {
      PlanarPose a, b;
      std::int64_t factor = 1;
      const auto randomly = [&](PlanarPose& pose) {
        do {
          const std::int64_t u = static_cast<std::int64_t>(random() % 7) - 3,
                             v = static_cast<std::int64_t>(random() % 7) - 3;
          if (u != 0 || v != 0) pose.rotation = half(u, v);
        } while (pose.rotation == Orientation() && random() % 4 != 0);
        const auto [u, v] = half_of(pose.rotation);
        factor *= u * u + v * v;
        if (random() % 2 == 0) return;
        for (Scale& s : pose.scale) {
          const int den = 1 + static_cast<int>(random() % 4);
          s = *Scale::of(*Rational::of(1 + random() % 5, den));
          factor *= den;
        }
      };
      randomly(a);
      randomly(b);
      moving.set(a, b);
      expect_engine(p, q, moving, factor);
      merged += moving.sum().vertices.size() < p.vertex_count() + q.vertex_count();
    }
  }
  EXPECT_GT(merged, 50u) << "parallel edges occur";
}

TEST(ConvexPolygonSum, moving_equals_starting_anew) {
  std::mt19937_64 random = seeded(2);
  const double angles[] = {1e-7, 1e-4, 0.0126, 0.2, 1, 3};
  for (int pair = 0; pair < 4; ++pair) {
    const Region p = pair == 0 ? snapped_shapes::disc(120, 3) : random_convex(random, 200, 100 * pair),
                 q = pair == 1 ? snapped_shapes::disc(77, 1) : random_convex(random, 300, 5000);
    ConvexPolygonSum moving = *ConvexPolygonSum::create(p, q);
    PlanarPose a, b;
    std::uint64_t errors = 0, clean = 0;
    for (int k = 0; k < (oracles::kSanitized ? 80 : 250); ++k) {
      PlanarPose& one = random() % 3 == 0 ? b : a;
      const double angle = angles[random() % std::size(angles)];
      if (random() % 8 == 0) {
        one.scale = {*Scale::of(0.5 + double(random() % 1000) / 1000),
                     *Scale::of(0.5 + double(random() % 1000) / 1000)};
      } else {
        one.rotation = *Orientation::nearest(one.rotation.radians() + (random() % 2 ? angle : -angle));
      }
      const ConvexPolygonSum before = moving;
      const PolygonWork work = moving.set(a, b);
      expect_as_rebuilt(moving, p, q);
      ASSERT_EQ(work.vertex_errors > 0, !moving.same_combinatorics(before)) << "no error, no change";
      ASSERT_LE(work.vertex_errors, work.vertex_checks);
      errors += work.vertex_errors;
      clean += work.vertex_errors == 0;
    }
    EXPECT_GT(errors, oracles::kSanitized ? 30u : 100u);
    EXPECT_GT(clean, 0u);
  }
}

TEST(ConvexPolygonSum, parallel_edges_merge_through_quarter_turns) {
  const Region square = shapes::rectangle(-1, -1, 1, 1), bar = shapes::rectangle(-3, -1, 3, 1);
  ConvexPolygonSum moving = *ConvexPolygonSum::create(square, bar);
  for (int k = 0; k <= 16; ++k) {
    moving.set(turn(*Orientation::nearest(k * kPi / 8)));
    const PolygonSum sum = moving.sum();
    EXPECT_EQ(sum.vertices.size(), k % 4 == 0 ? 4u : 8u) << k;
    if (k % 4 == 0) {
      EXPECT_EQ(sum.area_exact(), *Rational::of(32, 1));
    }
    expect_as_rebuilt(moving, square, bar);
  }
  // 3, 4, 5: a square turned by it has its corners at fifths.
  moving.set(turn(half(2, 1)));
  EXPECT_EQ(moving.sum().vertices.size(), 8u);
  EXPECT_EQ(moving.sum().area_exact(),
            *Rational::of(192, 5));  // the areas 4 and 12, and the circumference 16 times 7/5
  // Both turned alike: parallel again.
  moving.set(turn(half(2, 1)), turn(half(2, 1)));
  EXPECT_EQ(moving.sum().vertices.size(), 4u);
  EXPECT_EQ(moving.sum().area_exact(), *Rational::of(32, 1));
}

TEST(ConvexPolygonSum, work_is_what_changes) {
  std::mt19937_64 random = seeded(3);
  const Region p = snapped_shapes::disc(300, 2), q = random_convex(random, 4000, 100000);
  ConvexPolygonSum moving = *ConvexPolygonSum::create(p, q);
  EXPECT_EQ(moving.work().vertex_checks, 300u);
  const Orientation start = *Orientation::nearest(1);
  moving.set(turn(start));
  const ConvexPolygonSum kept = moving;
  moving.set(turn(start));
  EXPECT_EQ(moving.work(), PolygonWork()) << "standing still";
  PlanarPose larger = turn(start);
  larger.scale.fill(*Scale::of(3.5));
  moving.set(larger);
  EXPECT_EQ(moving.work(), PolygonWork()) << "certificates do not feel a common factor";
  EXPECT_NE(moving.sum(), kept.sum());
  std::uint64_t checks = 0, steps = 0;
  const Orientation small = *Orientation::nearest(1e-5);
  moving.set(turn(start));
  for (int k = 0; k < 200; ++k) {
    const PolygonWork work = moving.set(turn(small * moving.p_pose().rotation));
    checks += work.vertex_checks;
    steps += work.steps;
  }
  EXPECT_LT(20 * checks, 200u * 300u);
  EXPECT_GT(steps, 0u) << "some edges were passed";
  moving.set(turn(start));
  EXPECT_TRUE(moving.same_combinatorics(kept));
  EXPECT_EQ(moving.sum(), kept.sum());
  // Doubles decide unless edges are parallel.
  EXPECT_EQ(moving.work().exact_signs, 0u);
  moving.set({}, {});
  ConvexPolygonSum same = *ConvexPolygonSum::create(p, p);
  EXPECT_GT(same.work().exact_signs, 0u);
}

TEST(ConvexPolygonSum, coordinates_of_any_size) {
  const Region thin = polygon({{0, 0}, {0x1p60, 1}, {0x1p61, 3}, {0x1p60, 3}}),
               far = polygon({{0x1p300, 0x1p300}, {0x1.0000000000001p300, 0x1p300}, {0x1p300, 0x1.0000000000001p300}});
  for (const Region& p : {thin, far})
    for (const Region& q : {thin, far, shapes::rectangle(-0x1p-200, -1, 0x1p-200, 1)}) {
      ConvexPolygonSum moving = *ConvexPolygonSum::create(p, q);
      expect_engine(p, q, moving, 1);
      for (const Orientation& r : {half(1, 1), half(0, 1), half(1, -1)}) {
        moving.set(turn(r));
        expect_as_rebuilt(moving, p, q);
      }
      moving.set({});
      expect_engine(p, q, moving, 1);
    }
}

TEST(ConvexPolygonSum, errors) {
  const Region square = shapes::rectangle(0, 0, 1, 1);
  const auto code = [&](const Region& bad) {
    EXPECT_EQ(ConvexPolygonSum::create(bad, square).error(), ConvexPolygonSum::create(square, bad).error());
    return ConvexPolygonSum::create(bad, square).error().code;
  };
  EXPECT_EQ(code(Region()), ErrorCode::unsupported_operand);
  EXPECT_EQ(code(shapes::grate(3, 2, 1, 5)), ErrorCode::unsupported_operand);
  EXPECT_EQ(code(*Region::create({{{{{0, 0}, {1, 0}, {0, 1}}, {}}}, {}, {{5, 5}}})), ErrorCode::unsupported_operand);
  const Region dart = polygon({{0, 0}, {4, 0}, {1, 1}, {0, 4}});
  ASSERT_EQ(code(dart), ErrorCode::not_convex);
  const Evidence evidence = ConvexPolygonSum::create(dart, square).error().evidence;
  EXPECT_EQ(evidence.vertex, 2);
  EXPECT_EQ(evidence.x, 1);
  EXPECT_EQ(evidence.y, 1);
}

// Turning by hundreds of radians in all leaves room for steps of 2^-48.
TEST(ConvexPolygonSum, minute_steps_are_noticed_after_many_turns) {
  const Region square = polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  ConvexPolygonSum moving = *ConvexPolygonSum::create(square, square);
  for (int k = 0; k < 200; ++k) moving.set(turn(*Orientation::of(k % 2 == 0 ? 3 : 0, 1)));
  const std::int64_t start = -(std::int64_t{3} << 7);  // 3 / 2 of what a certificate leaves out, in steps
  std::size_t changes = 0;
  for (std::int64_t k = start; k < -2 * start; ++k) {
    const ConvexPolygonSum before = moving;
    moving.set({}, turn(*Orientation::of(k, std::int64_t{1} << 49)));
    changes += k > start && !moving.same_combinatorics(before);
    if (k == start || k % 64 == 0) expect_as_rebuilt(moving, square, square);
  }
  EXPECT_EQ(changes, 1u);
}

}  // namespace
}  // namespace dymsum
