// What clearance rests on: the distance of parallel lines told exactly, angles beyond doubles, ends of patches with
// their derivatives and ranges, and bounds of intervals against samples.
#include "cspace/queries/patch_interval.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "cspace/queries/patch_forms.h"
#include "dymsum/shapes.h"
#include "oracles/snapped_shapes.h"

namespace dymsum::cspace {
namespace {

using Random = std::mt19937_64;

double uniform_in(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

TEST(CrossingGap, is_zero_exactly_where_lines_coincide) {
  // An edge of the obstacle, one of the robot, and corners that are equally far from their lines.
  const std::array<Point, 2> fixed{Point{0, 0}, {3, 4}}, turning{Point{5, 7}, {5 + 8, 7 + 6}};
  // 1 beside the first line: (4, -3) / 5; 1 beside the second one: (-3, 4) / 5, five times.
  const CrossingGaps same = crossing_gaps(fixed, turning, {4, -3}, {5 + 3, 7 - 4});
  EXPECT_EQ(same[1], 10);
  EXPECT_EQ(same[0], 0);
  const CrossingGaps other = crossing_gaps(fixed, turning, {4, -3}, {5 - 3, 7 + 4});
  EXPECT_EQ(other[0], 10);
  EXPECT_EQ(other[1], 0);
  const CrossingGaps both = crossing_gaps(fixed, turning, {6, 8}, {5 + 4, 7 + 3});
  EXPECT_EQ(both[0], 0);
  EXPECT_EQ(both[1], 0);
  // Lengths that are no sums of two doubles: heights n / (n sqrt(r)) and m / (m sqrt(r)).
  int zeros = 0;
  for (const auto& [x, y] : {std::pair{1.0, 2.0}, {2.0, 3.0}, {1.0, 4.0}, {5.0, 8.0}})
    for (double n = 3; n < 40; n += 2)
      for (const double off : {0.0, 0x1p-40})
        for (const double side : {0.125, -0.125}) {
          const CrossingGaps gaps =
              crossing_gaps({Point{0, 0}, {n * x, n * y}}, {Point{0, 0}, {7 * y, 7 * x}}, {0.125, off}, {0, side});
          EXPECT_NEAR(std::max(std::abs(gaps[0]), std::abs(gaps[1])), 0.25 * y / std::hypot(x, y), 1e-10);
          EXPECT_EQ((side > 0 ? gaps[1] : gaps[0]) == 0, off == 0);
          zeros += off == 0;
        }
  EXPECT_EQ(zeros, 152);
}

TEST(CrossingGap, keeps_its_digits) {
  const double e = 0x1p-50;
  const std::array<Point, 2> fixed{Point{0, 0}, {3, 4}}, turning{Point{5, 7}, {13, 13}};
  // Moved by e along x a point is 4/5 e farther from the first line.
  const CrossingGaps near = crossing_gaps(fixed, turning, {4 + e * 4, -3}, {8, 3});
  EXPECT_NEAR(near[0] / (3.2 * e), 1, 1e-15);
  // Heights sqrt(2) / 2 and 99 / 140 hardly differ: 1e-4; far from the origin too.
  const double x = 0x1p40;
  const CrossingGaps far =
      crossing_gaps({Point{x, x}, {x + 1, x + 1}}, {Point{0, 0}, {140, 0}}, {x + 1, x}, {0, 99.0 / 140});
  // 99 / 140 - 1 / sqrt(2) = n / (2 140^2 (99 / 140 + 1 / sqrt(2))).
  const double n = 99 * 99 * 2 - 140 * 140, sum = 99.0 / 140 + std::sqrt(0.5);
  EXPECT_NEAR(std::min(std::abs(far[0]), std::abs(far[1])), n / (2 * 140.0 * 140.0 * sum), 1e-16);
}

TEST(CrossingGap, half_tangents_are_those_of_the_angle_between) {
  Random random(1);
  for (int k = 0; k < 1000; ++k) {
    const auto edge = [&] {
      const auto at = [&] {
        return Point{std::round(uniform_in(random, -9, 9)), std::round(uniform_in(random, -9, 9))};
      };
      for (;;)
        if (const std::array<Point, 2> e{at(), at()}; !(e[0] == e[1])) return e;
    };
    const std::array<Point, 2> a = edge(), b = edge();
    const Point u = a[1] - a[0], v = b[1] - b[0];
    const double angle = std::atan2(cross(u, v), dot(u, v));
    const auto [t, opposite] = half_tangents(a, b);
    if (std::abs(t.high) < 2) {
      EXPECT_NEAR(2 * std::atan(t.value()), angle, 1e-15);
    }
    if (std::abs(opposite.high) < 2) {
      EXPECT_NEAR(std::abs(std::remainder(2 * std::atan(opposite.value()) - angle, 2 * M_PI)), M_PI, 2e-15);
    }
    // (1 + t^2) of it is rational over its length: t = (sqrt(|u|^2 |v|^2) - u.v) / (u x v).
    if (std::abs(t.high) < 2 && cross(u, v) != 0) {
      const DoublePair left = t * DoublePair{cross(u, v), 0} + DoublePair{dot(u, v), 0};
      const DoublePair rest = left * left - DoublePair{dot(u, u) * dot(v, v), 0};
      EXPECT_LT(std::abs(rest.value()), 0x1p-88 * dot(u, u) * dot(v, v));
    }
  }
}

PatchEnd crossing(double gap) {
  PatchEnd end;
  end.corner = false;
  end.mixed = true;
  end.constant = 1.5;
  end.tangent = -0.75;
  end.parallel = 0.25;
  end.gap = {gap, 2};
  return end;
}

// By the second of the two kinds of reference: exactly at the parallel angle.
EndCurve at_pole(double gap) { return {crossing(gap), 4, 0, 0.0}; }

TEST(EndCurve, derivatives_and_ranges) {
  Random random(2);
  PatchEnd wave;
  wave.corner = false;
  wave.constant = 1, wave.cosine = 0.5, wave.sine = -0.75;
  for (const double gap : {0.0, 1.0, -1.0, 1e-3, 1e-9}) {
    const std::array<EndCurve, 3> curves{at_pole(gap), EndCurve(crossing(gap), 4, 0.25 + 0.4), EndCurve(wave, 4, 0.3)};
    for (const EndCurve& curve : curves) {
      const bool fast = &curve == &curves[0] && gap != 0;
      for (int k = 0; k < 2000; ++k) {
        const double near = gap == 0 ? 0.1 : std::min(0.05, std::abs(gap));
        double a = near * std::pow(10, uniform_in(random, -1, 0.5)), b = a * (1 + uniform_in(random, 0, 0.3));
        if (k % 2 == 0) a = -a, b = -b;
        const EndCurve::Ranges r = curve.ranges(std::min(a, b), std::max(a, b));
        ASSERT_TRUE(r.known);
        for (const double x : {a, b, a + uniform_in(random, 0, 1) * (b - a)}) {
          const EndCurve::Derivatives d = curve.derivatives(SmallRotation(x));
          if (d.value < 0 || d.value > 4) continue;
          EXPECT_DOUBLE_EQ(d.value, curve.value(SmallRotation(x)));
          EXPECT_GE(d.value, r.value.low);
          EXPECT_LE(d.value, r.value.high);
          const auto within = [](double v, Range range) {
            const double margin = 1e-13 * (1 + std::abs(v));
            return v >= range.low - margin && v <= range.high + margin;
          };
          EXPECT_TRUE(within(d.first, r.first)) << d.first << " " << r.first.low << " " << r.first.high;
          EXPECT_TRUE(within(d.second, r.second)) << d.second << " " << r.second.low << " " << r.second.high;
          const double h = fast ? 1e-4 * std::abs(x) : 1e-5;
          const EndCurve::Derivatives p = curve.derivatives(SmallRotation(x - h)),
                                      q = curve.derivatives(SmallRotation(x + h));
          const double steep = std::abs(d.first) + std::abs(d.second * x) + 1;
          EXPECT_NEAR((q.value - p.value) / (2 * h), d.first, 1e-6 * steep);
          EXPECT_NEAR((q.first - p.first) / (2 * h), d.second, 1e-6 * steep / (fast ? std::abs(x) : 1));
        }
      }
    }
  }
}

TEST(EndCurve, is_on_the_edge_only_where_it_may_be) {
  for (const double gap : {1e-3, -1e-3, 1e-9}) {
    const EndCurve curve = at_pole(gap);
    for (const double sign : {-1.0, 1.0}) {
      const Range all = sign > 0 ? Range{-1e-13, 0.2} : Range{-0.2, 1e-13};
      const Range possible = curve.possible(all.low, all.high);
      EXPECT_GT(sign > 0 ? possible.low : -possible.high, 0);
      for (double x = 1e-14; x < 0.2; x *= 1.01)
        if (const double v = curve.derivatives(SmallRotation(sign * x)).value; v >= 0 && v <= 4) {
          EXPECT_GE(sign * x, possible.low);
          EXPECT_LE(sign * x, possible.high);
        }
    }
    // Across the pole nothing is known.
    EXPECT_FALSE(curve.ranges(-1e-12, 1e-3).known);
    EXPECT_EQ(curve.range(-1e-12, 1e-3).high, 4);
  }
  EXPECT_TRUE(at_pole(0).ranges(-1e-3, 1e-3).known);
}

std::vector<CspaceObstacle> obstacles() {
  std::vector<CspaceObstacle> all;
  const Region star = snapped_shapes::star(6, 3.2, 6.9), bar = shapes::rectangle(-4, -0.5, 4, 0.5);
  all.push_back(CspaceObstacle::create(star, star).value());
  all.push_back(CspaceObstacle::create(bar, shapes::letter_u(4, 3, 0.75)).value());
  all.push_back(CspaceObstacle::create(shapes::letter_l(3, 2, 0.5), shapes::grate(3, 2, 0.5, 3)).value());
  return all;
}

TEST(PatchInterval, ends_are_those_of_the_patches_and_in_the_box) {
  Random random(3);
  int crossings = 0;
  for (const CspaceObstacle& obstacle : obstacles()) {
    const PatchForms forms(obstacle);
    for (const PatchInterval& s : make_intervals(obstacle, forms, 0.1)) {
      if (!(s.proved_high - s.proved_low > 1e-5)) continue;
      const IntervalBox box = box_of(forms, s);
      const double x = s.proved_low + uniform_in(random, 0.01, 0.99) * (s.proved_high - s.proved_low);
      const double theta = std::remainder(s.reference + x, 2 * M_PI);
      const auto ends = obstacle.ends(obstacle.patches()[s.patch], theta);
      const Turn turn(theta);
      const ContactLine& own = forms[s.patch].own;
      const Point start = position(own.start, turn), along = own.turns ? turn * own.unit : own.unit;
      for (const auto& [end, curve] : {std::pair{ends[0], &s.left}, {ends[1], &s.right}}) {
        const Point p = forms.relative(end);
        const double at = curve->value(SmallRotation(x));
        EXPECT_NEAR(at, dot(p - start, along), 1e-8 * forms.size());
        crossings += !curve->constant();
        const double margin = 1e-8 * forms.size();
        EXPECT_TRUE(p.x > box.at.x.low - margin && p.x < box.at.x.high + margin);
        EXPECT_TRUE(p.y > box.at.y.low - margin && p.y < box.at.y.high + margin);
        const double u = dot(box.along, p), v = cross(box.along, p);
        EXPECT_TRUE(u > box.u.low - margin && u < box.u.high + margin);
        EXPECT_TRUE(v > box.v.low - margin && v < box.v.high + margin);
      }
    }
  }
  EXPECT_GT(crossings, 200);
}

TEST(IntervalDistance, no_sample_is_nearer_than_the_bound) {
  Random random(4);
  for (const CspaceObstacle& obstacle : obstacles()) {
    const PatchForms forms(obstacle);
    double loss = 0;
    int queried = 0;
    for (const PatchInterval& s : make_intervals(obstacle, forms, 0.1)) {
      if (!(s.proved_high - s.proved_low > 1e-7)) continue;
      for (const bool whole : {false, true}) {
        const double size = forms.size(), theta = uniform_in(random, -M_PI, M_PI), w = size * uniform_in(random, 0, 1);
        const DistanceQuestion q{{uniform_in(random, -size, size), uniform_in(random, -size, size)}, theta, w, whole};
        const IntervalDistance distance(forms[s.patch], s, q, std::remainder(s.reference - theta, 2 * M_PI));
        double low = s.proved_low + uniform_in(random, 0, 1) * (s.proved_high - s.proved_low), high = s.proved_high;
        if (random() % 2 == 0) high = low + (high - low) / 50;
        const IntervalDistance::Bound bound = distance.lower(low, high, INFINITY);
        double least = INFINITY;
        for (int k = 0; k <= 100; ++k)
          least = std::min(least, distance.nearest(std::min(high, low + k * (high - low) / 100)).distance);
        EXPECT_GE(least, bound.distance - 1e-12 * size);
        if (!bound.splits) loss += (least - bound.distance) / size, ++queried;
      }
    }
    EXPECT_LT(loss / queried, 2e-3);
  }
}

}  // namespace
}  // namespace dymsum::cspace
