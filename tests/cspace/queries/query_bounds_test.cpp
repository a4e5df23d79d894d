// Bounds of questions about an obstacle against fifty digits: where an edge is crossed as the robot turns, at which
// angles a line passes a position, and how far tight angles are.
#include <gtest/gtest.h>

#include <numbers>

#include "cspace/queries/clearance_search.h"
#include "cspace/queries/free_angles.h"
#include "cspace/queries/patch_forms.h"
#include "oracles/largest_fraction.h"
#include "oracles/random.h"

namespace dymsum::cspace {
namespace {

using oracles::Digits;
using oracles::LargestFraction;

PatchEnd mixed_crossing(oracles::Random& random) {
  PatchEnd end;
  end.corner = false;
  end.mixed = true;
  end.constant = 1.5 + random.signed_unit();
  end.tangent = random.signed_unit();
  end.parallel = 3 * random.signed_unit();
  end.gap = {random.signed_unit(), random.signed_unit()};
  return end;
}

Digits crossing_at(const PatchEnd& end, int k, const Digits& psi) {
  const Digits at = Digits(end.constant) - Digits(end.tangent) * tan(Digits(psi / 2)) +
                    Digits(end.gap[static_cast<std::size_t>(k)]) / sin(psi);
  return at < 0 ? Digits(0) : at > 4 ? Digits(4) : at;
}

// The parallel angle is known to 12 units, or beyond doubles and the reference's distance from it to 2^-50 of that.
TEST(QueryBounds, crossings_near_parallel_lines_err_by_less_and_not_by_much_less) {
  oracles::Random random(71);
  LargestFraction of_reference, of_distance;
  for (int k = 0; k < 10000; ++k) {
    PatchEnd end = mixed_crossing(random);
    const double x = 0.5 * random.signed_unit() * std::ldexp(1.0, -random.below(12));
    if (k % 2 == 0) {
      const double reference = end.parallel + std::ldexp(random.signed_unit(), -random.below(10));
      const EndCurve curve(end, 4, reference);
      const Digits off = Digits(random.chance(50) ? 11 : -11) * exact::kRoundoff,
                   psi = Digits(reference) + Digits(x) - Digits(end.parallel) + off;
      const double error = curve.error(SmallRotation(x));
      if (std::isfinite(error))
        of_reference.add(Digits(curve.value(SmallRotation(x))) - crossing_at(end, 0, psi), error);
    } else {
      const double psi = std::ldexp(random.signed_unit(), -random.below(30));
      const EndCurve curve(end, 4, 1, psi);
      const Digits truly = Digits(psi) * (1 + Digits(random.signed_unit()) * 0x1p-50) + Digits(x);
      const double error = curve.error(SmallRotation(x));
      // Beyond the pole from the reference only the terms count.
      if (std::isfinite(error))
        of_distance.add(Digits(curve.value(SmallRotation(x))) - crossing_at(end, 1, truly), error);
    }
  }
  of_reference.expect_bounded(1.0 / 16);
  of_distance.expect_bounded(1.0 / 16);
}

TEST(QueryBounds, waves_err_by_less_and_not_by_much_less) {
  oracles::Random random(72);
  LargestFraction wave;
  for (int k = 0; k < 20000; ++k) {
    PatchEnd end;
    end.corner = false;
    end.constant = 2 + random.signed_unit();
    end.cosine = random.signed_unit() / 2;
    end.sine = random.signed_unit() / 2;
    const double reference = 3 * random.signed_unit(), x = random.signed_unit() / 2;
    const EndCurve curve(end, 4, reference);
    const Digits theta = Digits(reference) + Digits(x);
    wave.add(Digits(curve.value(SmallRotation(x))) -
                 (Digits(end.constant) + Digits(end.cosine) * cos(theta) + Digits(end.sine) * sin(theta)),
             curve.error(SmallRotation(x)));
  }
  wave.expect_bounded(1.0 / 32);
}

Region polygon_of(oracles::Random& random, int n, double far) {
  RegionData data;
  data.parts.emplace_back();
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * (k + 0.3 * random.signed_unit()) / n;
    data.parts[0].outer.push_back({far + std::cos(angle), std::sin(angle)});
  }
  return Region::create(std::move(data)).value();
}

/// Where the line of a contact, d x (z - p + R q) with d the edge, passes z, next to an angle.
Digits passing_angle(const CspaceObstacle& obstacle, const Contact& contact, Point z, double near) {
  const Ring &p = obstacle.obstacle().parts()[0].outer, &q = obstacle.robot().parts()[0].outer;
  const bool turns = contact.kind == Contact::Kind::edge_of_q;
  const Point from = turns ? q[contact.q] : p[contact.p],
              to = turns ? q[(contact.q + 1) % q.size()] : p[(contact.p + 1) % p.size()];
  const auto digits = [](Point v) { return std::array<Digits, 2>{Digits(v.x), Digits(v.y)}; };
  const auto minus = [&](Point a, Point b) {
    return std::array<Digits, 2>{Digits(Digits(a.x) - Digits(b.x)), Digits(Digits(a.y) - Digits(b.y))};
  };
  const auto across = [](const auto& a, const auto& b) { return Digits(a[0] * b[1] - a[1] * b[0]); };
  const auto inner = [](const auto& a, const auto& b) { return Digits(a[0] * b[0] + a[1] * b[1]); };
  const auto d = minus(to, from), gap = minus(z, p[contact.p]), r = digits(q[contact.q]);
  const Digits constant = turns ? across(d, r) : across(d, gap), c = turns ? across(d, gap) : across(d, r),
               s = turns ? Digits(-inner(d, gap)) : inner(d, r);
  Digits theta = near;
  for (int k = 0; k < 6; ++k) theta -= (constant + c * cos(theta) + s * sin(theta)) / (s * cos(theta) - c * sin(theta));
  return theta;
}

// A passage is as wide as four times what its line may err by makes it, with sizes for all coordinates, and the arc
// cosine's error on top: roundings reach no more than a hundredth.
TEST(QueryBounds, angles_of_passages_are_between_their_ends_and_not_in_the_middle) {
  oracles::Random random(73);
  LargestFraction fraction;
  int passages = 0;
  for (int k = 0; k < 12; ++k) {
    const CspaceObstacle obstacle =
        CspaceObstacle::create(polygon_of(random, 5, k % 2 * 0.5), polygon_of(random, 6, k % 3 * 0.5)).value();
    const PatchForms forms(obstacle);
    for (int i = 0; i < 200; ++i) {
      const Point z{3 * random.signed_unit(), 3 * random.signed_unit()};
      for (const Passage& p : passages_at(obstacle, forms, z).all) {
        if (!p.crosses || p.high - p.low > 0x1p-40) continue;
        const double midpoint = (p.low + p.high) / 2;
        const Digits truth = passing_angle(obstacle, obstacle.patches()[p.patch].contact, z, midpoint);
        fraction.add(2 * truth - Digits(p.low) - Digits(p.high), p.high - p.low);
        ++passages;
      }
    }
  }
  EXPECT_GT(passages, 200);
  fraction.expect_bounded(1.0 / 256);
}

// A square in its exact room, so much weight on the angle that only that counts. Questions may mean an angle that is
// 2^-50 away from theirs.
TEST(QueryBounds, distances_of_tight_angles_err_by_less_and_not_by_much_less) {
  oracles::Random random(74);
  const auto part_of = [](std::vector<Point> outer, std::vector<Ring> holes) {
    RegionData data;
    data.parts.push_back({std::move(outer), std::move(holes)});
    return Region::create(std::move(data)).value();
  };
  const Region square = part_of({{0, 0}, {5, 0}, {5, 5}, {0, 5}}, {});
  const Region room = part_of({{-9, -9}, {9, -9}, {9, 9}, {-9, 9}}, {{{0, 0}, {-3, 4}, {1, 7}, {4, 3}}});
  const CspaceObstacle obstacle = CspaceObstacle::create(square, room).value();
  const double weight = 0x1p30;
  const Digits turned = atan2(Digits(3), Digits(4));
  LargestFraction fraction;
  for (int k = 0; k < 2000; ++k) {
    // The first quarter's tight angle is the nearest one; its position is (0, 0).
    const double theta = std::atan2(3.0, 4.0) + 0.7 * random.signed_unit();
    const NearestTight nearest = nearest_tight(obstacle, {0, 0, theta}, weight);
    const Digits meant = Digits(theta) + Digits(random.chance(50) ? 0x1p-50 : -0x1p-50),
                 truth = Digits(weight) * abs(Digits(meant - turned));
    fraction.add(Digits(nearest.position.distance) - truth, nearest.position.error);
  }
  fraction.expect_bounded(1.0 / 32);
}

}  // namespace
}  // namespace dymsum::cspace
