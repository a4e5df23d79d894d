// Bounds of intervals of patches against fifty digits: the angles that they cover, seen from their references, and how
// far a corner is that runs fast as the robot turns.
#include <gtest/gtest.h>

#include <numbers>
#include <optional>

#include "cspace/queries/nearest_patch.h"
#include "cspace/queries/patch_interval.h"
#include "exact/big.h"
#include "oracles/largest_fraction.h"
#include "oracles/random.h"
#include "oracles/sanitized.h"

namespace dymsum::cspace {
namespace {

using oracles::Digits;
using oracles::LargestFraction;

Digits full_turn() { return 2 * Digits::pi(); }

/// In (-pi, pi], but for the border.
Digits reduced(const Digits& angle) { return angle - round(Digits(angle / full_turn())) * full_turn(); }

struct DigitsPoint {
  Digits x, y;
  friend Digits cross(const DigitsPoint& a, const DigitsPoint& b) { return a.x * b.y - a.y * b.x; }
  friend Digits dot(const DigitsPoint& a, const DigitsPoint& b) { return a.x * b.x + a.y * b.y; }
};
DigitsPoint difference(Point to, Point from) { return {Digits(to.x) - Digits(from.x), Digits(to.y) - Digits(from.y)}; }

Region ring_of(std::vector<Point> ring) {
  RegionData data;
  data.parts.push_back({std::move(ring), {}});
  return Region::create(std::move(data)).value();
}

/// A star with random corners, and it turned about the origin, its corners `off` by less: lines that pass it nearly
/// coincide at that angle.
std::array<Region, 2> star_and_turned(oracles::Random& random, double by, double off) {
  const double c = std::cos(by), s = std::sin(by);
  std::array<std::vector<Point>, 2> rings;
  for (int k = 0; k < 8; ++k) {
    const double angle = std::numbers::pi / 4 * (k + 0.3 * random.signed_unit()),
                 r = (k % 2 == 0 ? 1 : 0.4) * (1 + 0.2 * random.signed_unit());
    const Point v{r * std::cos(angle), r * std::sin(angle)};
    rings[0].push_back(v);
    rings[1].push_back(
        {-c * v.x + s * v.y + off * random.signed_unit(), -s * v.x - c * v.y + off * random.signed_unit()});
  }
  return {ring_of(rings[0]), ring_of(rings[1])};
}

/// The angles of an obstacle of polygons without holes in fifty digits.
class ExactAngles {
 public:
  explicit ExactAngles(const CspaceObstacle& obstacle) : obstacle_(obstacle) {}

  Digits event(std::uint32_t k) const {
    const CspaceObstacle::HalfTangent t = obstacle_.half_tangent(k);
    return reduced(2 * atan(Digits(t.high) + Digits(t.low)) + (t.opposite ? full_turn() / 2 : Digits(0)));
  }

  /// Where an edge of the robot has the direction of one of the obstacle, or the opposite one.
  Digits parallel(const Contact& a, const Contact& b, int k) const {
    const bool first = a.kind == Contact::Kind::edge_of_p;
    const DigitsPoint fixed = edge(obstacle_.obstacle(), (first ? a : b).p),
                      back = edge(obstacle_.robot(), (first ? b : a).q), turning{-back.x, -back.y};
    return atan2(cross(turning, fixed), dot(turning, fixed)) + k * full_turn() / 2;
  }

  /// The reference of an interval; whether its lines are parallel there.
  Digits reference(const PatchForm& form, const PatchInterval& s, bool& fast) const {
    const Patch& patch = obstacle_.patches()[s.patch];
    for (const auto& [end, other] : {std::pair{&form.left, &patch.left}, {&form.right, &patch.right}})
      for (const int k : {0, 1}) {
        if (end->corner || !end->mixed) continue;
        if (std::remainder(parallel_angle(*end, k), 2 * std::numbers::pi) != s.reference) continue;
        fast = end->fast(k, form.own.length);
        return parallel(patch.contact, *other, k);
      }
    return s.reference;
  }

 private:
  static DigitsPoint edge(const Region& region, std::uint32_t k) {
    const Ring& ring = region.parts()[0].outer;
    return difference(ring[(k + 1) % ring.size()], ring[k]);
  }
  const CspaceObstacle& obstacle_;
};

/// How much of what is granted angles of events use: by doubles of references, and beside parallel lines that a corner
/// runs fast at.
struct EventFractions {
  LargestFraction of_reference, of_parallel;

  void add(const std::array<Region, 2>& pair) {
    const CspaceObstacle obstacle = CspaceObstacle::create(pair[0], pair[1]).value();
    const PatchForms forms(obstacle);
    const ExactAngles exact(obstacle);
    const std::vector<PatchInterval> all = make_intervals(obstacle, forms, 0.1);
    const auto add_end = [&](const PatchInterval& s, std::uint32_t angle, double low, double high) {
      bool fast = false;
      const Digits at = reduced(exact.event(angle) - exact.reference(forms[s.patch], s, fast));
      const bool sharp = fast && high - low < 0x1p-55;
      (sharp ? of_parallel : of_reference).add(at - (Digits(low) + Digits(high)) / 2, (high - low) / 2);
    };
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Patch& patch = obstacle.patches()[all[i].patch];
      if (patch.begin == Patch::kNone) continue;
      if (i == 0 || all[i - 1].patch != all[i].patch) add_end(all[i], patch.begin, all[i].low, all[i].proved_low);
      if (i + 1 == all.size() || all[i + 1].patch != all[i].patch)
        add_end(all[i], patch.end, all[i].proved_high, all[i].high);
    }
  }
};

TEST(IntervalBounds, angles_beside_parallel_lines_are_covered_and_not_surely_covered) {
  oracles::Random random(75);
  EventFractions fractions;
  for (int k = 0; k < oracles::rounds(12); ++k)
    fractions.add(star_and_turned(random, 3 * random.signed_unit(), std::ldexp(1, -12 - k)));
  fractions.of_reference.expect_bounded(1.0 / 8);
  fractions.of_parallel.expect_bounded(1.0 / 16);
}

// Patches of needles last nearly half a turn, many of them beyond pi.
TEST(IntervalBounds, angles_beyond_half_a_turn_are_covered_and_not_surely_covered) {
  oracles::Random random(77);
  EventFractions fractions;
  for (int k = 0; k < oracles::rounds(30); ++k) {
    const double direction = 3 * random.signed_unit();
    const auto needle = [&] {
      const double by = direction + random.signed_unit() / 16, c = std::cos(by), s = std::sin(by);
      return ring_of({{0, 0}, {c + 0x1p-8 * s, s - 0x1p-8 * c}, {c, s}});
    };
    fractions.add({needle(), needle()});
  }
  fractions.of_reference.expect_bounded(1.0 / 16);
}

/// Under a slab's end and above a floor, a rod in a gap that is hardly higher than it is: where it stands farthest in
/// depends on the angle at 2^24 times its length for a radian.
struct RodInGap {
  Point floor[2], corner;
  Region robot = ring_of({{0, 0}, {4, 0}, {4, 1}, {0, 1}}), obstacle;
  explicit RodInGap(double by) {
    const double c = std::cos(by), s = std::sin(by), h = 1 + 0x1p-24;
    const auto at = [&](double x, double y) { return Point{c * x - s * y, s * x + c * y}; };
    RegionData data;
    data.parts.push_back({{at(-8, -2), at(8, -2), at(8, 0), at(-8, 0)}, {}});
    data.parts.push_back({{at(-8, h), at(0, h), at(0, h + 2), at(-8, h + 2)}, {}});
    obstacle = Region::create(std::move(data)).value();
    floor[0] = at(-8, 0), floor[1] = at(8, 0), corner = at(0, h);
  }
  /// With its first corner on the floor and its upper edge on the corner, turned by (1 - t^2, 2 t) / (1 + t^2).
  DigitsPoint farthest_in(const Digits& t) const {
    const Digits n = 1 + t * t, c = (1 - t * t) / n, s = 2 * t / n;
    const DigitsPoint d = difference(floor[1], floor[0]), e{c, s}, top{Digits(floor[0].x) - s, Digits(floor[0].y) + c};
    const DigitsPoint gap{Digits(corner.x) - top.x, Digits(corner.y) - top.y};
    const Digits fraction = cross(gap, e) / cross(d, e);
    return {floor[0].x + fraction * d.x, floor[0].y + fraction * d.y};
  }
};

TEST(IntervalBounds, distances_of_fast_corners_err_by_less_and_not_by_much_less) {
  oracles::Random random(76);
  LargestFraction fraction;
  int fast = 0;
  for (int k = 0; k < oracles::rounds(20); ++k) {
    const double by = 3 * random.signed_unit();
    const RodInGap rod(by);
    const CspaceObstacle obstacle = CspaceObstacle::create(rod.robot, rod.obstacle).value();
    const PatchForms forms(obstacle);
    const PatchTree tree(obstacle, forms, 1);
    for (int i = 0; i < 40; ++i) {
      const Orientation theta = Orientation::nearest(by + 0x1p-25 * (1 + std::abs(random.signed_unit()))).value();
      const DigitsPoint corner = rod.farthest_in(Digits(exact::exact_value(theta.tan_half())));
      // After it along the floor.
      const Point from{static_cast<double>(corner.x) - 0.5 * std::cos(by),
                       static_cast<double>(corner.y) - 0.5 * std::sin(by)};
      const NearestPatch nearest = nearest_patch_at(forms, tree, {forms.relative(from), theta.radians(), 0});
      const DigitsPoint gap{corner.x - Digits(from.x), corner.y - Digits(from.y)};
      const Digits truth = sqrt(dot(gap, gap));
      if (abs(Digits(nearest.distance - truth)) > 1e-3) continue;
      ++fast;
      fraction.add(nearest.distance - truth, nearest.error);
    }
  }
  EXPECT_GT(fast, oracles::rounds(100));
  fraction.expect_bounded(1.0 / 16);
}

}  // namespace
}  // namespace dymsum::cspace
