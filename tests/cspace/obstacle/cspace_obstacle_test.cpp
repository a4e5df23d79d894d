// The obstacle of all orientations of convex pairs against static slices, and what does not depend on the engine:
// slabs, containment, errors.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>

#include "cspace/obstacle/obstacle_slices.h"
#include "dymsum/cspace_obstacle.h"
#include "dymsum/shapes.h"
#include "exact/big.h"
#include "oracles/snapped_shapes.h"

namespace dymsum {
namespace {

using exact::BigRational;
using testing_obstacles::polygon;
using testing_obstacles::Random;

double cross(Point o, Point a, Point b) { return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x); }

// The hull of random grid points, sometimes with vertices inside its edges.
Region random_convex(Random& random, int reach, int points) {
  const auto at = [&] { return 2.0 * (static_cast<int>(random() % static_cast<unsigned>(2 * reach + 1)) - reach); };
  for (;;) {
    std::vector<Point> all;
    for (int i = 0; i < points; ++i) all.push_back({at(), at()});
    std::sort(all.begin(), all.end(), [](Point a, Point b) { return std::pair{a.x, a.y} < std::pair{b.x, b.y}; });
    Ring hull;
    for (int side = 0; side < 2; ++side) {
      const std::size_t first = hull.size();
      for (const Point& v : all) {
        while (hull.size() >= first + 2 && cross(hull[hull.size() - 2], hull.back(), v) <= 0) hull.pop_back();
        if (hull.empty() || !(hull.back() == v)) hull.push_back(v);
      }
      hull.pop_back();
      std::reverse(all.begin(), all.end());
    }
    if (hull.size() < 3) continue;
    if (random() % 4 == 0) {
      const Point a = hull[0], b = hull[1];
      hull.insert(hull.begin() + 1, Point{(a.x + b.x) / 2, (a.y + b.y) / 2});
    }
    return polygon(std::move(hull));
  }
}

CspaceObstacle make(const Region& robot, const Region& obstacle) {
  return CspaceObstacle::create(robot, obstacle).value();
}

// A second orientation inside a slab, unlike inside().
Orientation elsewhere(const CspaceObstacle& c, std::uint32_t slab, Random& random) {
  if (c.angles().empty()) return *Orientation::nearest(1);
  const double low = c.angles()[slab].theta;
  double high = c.angles()[(slab + 1) % c.angles().size()].theta;
  if (high <= low) high += 2 * M_PI;
  const double fraction = std::uniform_real_distribution<double>(0.01, 0.99)(random);
  const Orientation o =
      *Orientation::nearest(low + fraction * (high - low), std::max(1e-4 * (high - low), Orientation::kAngularError));
  return c.slab_of(o) == slab ? o : c.inside(slab);
}

std::vector<std::vector<Contact>> rotated_to_least(std::vector<std::vector<Contact>> rings) {
  const auto less = [](const Contact& a, const Contact& b) {
    return std::tuple{a.kind, a.p, a.q} < std::tuple{b.kind, b.p, b.q};
  };
  for (auto& ring : rings) std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end(), less), ring.end());
  std::sort(rings.begin(), rings.end(), [&](const auto& a, const auto& b) { return less(a[0], b[0]); });
  return rings;
}

std::vector<std::vector<Contact>> contacts(const PlanarSum& sum) {
  std::vector<std::vector<Contact>> rings;
  const auto add = [&](const SumRing& ring) {
    rings.emplace_back();
    for (const SumVertex& v : ring.vertices) rings.back().push_back(v.out);
  };
  for (const SumPart& part : sum.parts) {
    add(part.outer);
    for (const SumRing& hole : part.holes) add(hole);
  }
  return rotated_to_least(std::move(rings));
}

std::vector<std::vector<Contact>> contacts(const CspaceObstacle& c, std::uint32_t slab) {
  std::vector<std::vector<Contact>> rings;
  for (const auto& loop : c.loops(slab)) {
    rings.emplace_back();
    for (const std::uint32_t k : loop) rings.back().push_back(c.patches()[k].contact);
  }
  return rotated_to_least(std::move(rings));
}

std::uint32_t slabs(const CspaceObstacle& c) {
  return std::max<std::uint32_t>(1, static_cast<std::uint32_t>(c.angles().size()));
}

void expect_slice_at(const CspaceObstacle& c, std::uint32_t slab, const Orientation& at) {
  const PlanarSum slice = *cspace_slice(c.robot(), c.obstacle(), at);
  EXPECT_TRUE(slice == *c.slice(at));
  EXPECT_EQ(contacts(c, slab), contacts(slice));
  // The ends in doubles against the vertices of the slice.
  std::map<std::tuple<Contact::Kind, std::uint32_t, std::uint32_t>, Point> starts;
  for (const SumPart& part : slice.parts)
    for (const SumVertex& v : part.outer.vertices) starts[{v.out.kind, v.out.p, v.out.q}] = v.at;
  for (const auto& loop : c.loops(slab))
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Patch &p = c.patches()[loop[k]], &next = c.patches()[loop[(k + 1) % loop.size()]];
      EXPECT_EQ(p.right, next.contact);
      EXPECT_EQ(next.left, p.contact);
      const auto ends = c.ends(p, at.radians());
      const Point from = starts.at({p.contact.kind, p.contact.p, p.contact.q});
      const Point to = starts.at({next.contact.kind, next.contact.p, next.contact.q});
      EXPECT_NEAR(ends[0].x, from.x, 1e-12);
      EXPECT_NEAR(ends[0].y, from.y, 1e-12);
      EXPECT_NEAR(ends[1].x, to.x, 1e-12);
      EXPECT_NEAR(ends[1].y, to.y, 1e-12);
    }
}

void expect_angles(const CspaceObstacle& c) {
  for (std::size_t k = 0; k < c.angles().size(); ++k) {
    const EventAngle& a = c.angles()[k];
    EXPECT_LE(a.low, a.theta);
    EXPECT_LE(a.theta, a.high);
    EXPECT_LT(a.high - a.low, 1e-13);
    EXPECT_GT(a.theta, -M_PI);
    EXPECT_LE(a.theta, M_PI);
    if (k > 0) {
      EXPECT_LT(c.angles()[k - 1].theta, a.theta);
    }
    if (!a.exact) continue;
    EXPECT_NEAR(a.exact->radians(), a.theta, 1e-15);
    EXPECT_EQ(c.slab_of(*a.exact), std::nullopt);
  }
  for (const ObstacleEvent& e : c.events()) EXPECT_LT(e.angle, c.angles().size());
}

std::size_t corners(const Region& region) { return region.canonical().parts()[0].outer.size(); }

// Every slab at two orientations, and all numbers.
void expect_obstacle(const CspaceObstacle& c, Random& random, std::size_t most_slabs = 1000) {
  expect_angles(c);
  const std::size_t m = corners(c.obstacle()), n = corners(c.robot());
  EXPECT_EQ(c.events().size(), m * n);
  EXPECT_EQ(c.work().surfaces, 2 * m * n);
  EXPECT_GE(c.patches().size(), 2 * m * n);
  EXPECT_LE(c.patches().size(), 4 * m * n);
  if (c.angles().size() == m * n) {
    EXPECT_EQ(c.patches().size(), 4 * m * n);
  }
  const std::uint32_t step = 1 + static_cast<std::uint32_t>(slabs(c) / most_slabs);
  for (std::uint32_t slab = 0; slab < slabs(c); slab += step) {
    const Orientation at = c.inside(slab);
    EXPECT_EQ(c.slab_of(at), slab);
    const std::vector<std::vector<std::uint32_t>> loops = c.loops(slab);
    ASSERT_EQ(loops.size(), 1u);
    EXPECT_EQ(loops[0].size(), m + n);
    for (const std::uint32_t k : loops[0]) EXPECT_EQ(c.free_cell(slab, k), 0u);
    expect_slice_at(c, slab, at);
    expect_slice_at(c, slab, elsewhere(c, slab, random));
  }
}

using Spot = std::pair<long long, long long>;
Spot spot(Point p) { return {std::llround(p.x * 0x1p20), std::llround(p.y * 0x1p20)}; }

// The vertices on a segment in their order, its ends among them.
std::vector<Spot> on_segment(const std::array<Point, 2>& s, const std::vector<Point>& vertices) {
  std::vector<std::pair<double, Spot>> found;
  const double dx = s[1].x - s[0].x, dy = s[1].y - s[0].y, length = std::hypot(dx, dy);
  for (const Point& v : vertices) {
    const double along = ((v.x - s[0].x) * dx + (v.y - s[0].y) * dy) / length;
    const double beside = ((v.x - s[0].x) * dy - (v.y - s[0].y) * dx) / length;
    if (std::abs(beside) < 1e-9 && along > -1e-9 && along < length + 1e-9) found.push_back({along, spot(v)});
  }
  std::sort(found.begin(), found.end());
  std::vector<Spot> spots;
  for (const auto& [along, v] : found)
    if (spots.empty() || spots.back() != v) spots.push_back(v);
  return spots;
}

// Vertices - edges + faces of the surface cut at every event angle, by positions instead of contacts.
std::int64_t euler_of_slabs(const CspaceObstacle& c) {
  std::int64_t count = 0;
  const std::uint32_t all = slabs(c);
  for (std::uint32_t k = 0; k < all; ++k) {
    std::vector<std::array<Point, 2>> segments;
    std::vector<Point> vertices;
    for (const std::uint32_t slab : {(k + all - 1) % all, k})
      for (const auto& loop : c.loops(slab))
        for (const std::uint32_t p : loop) {
          segments.push_back(c.ends(c.patches()[p], c.angles()[k].theta));
          vertices.push_back(segments.back()[0]);
        }
    std::set<Spot> distinct;
    for (const Point& v : vertices) distinct.insert(spot(v));
    std::set<std::pair<Spot, Spot>> edges;
    for (const auto& s : segments) {
      const std::vector<Spot> along = on_segment(s, vertices);
      for (std::size_t i = 1; i < along.size(); ++i) edges.insert({along[i - 1], along[i]});
    }
    std::set<Spot> ridges;
    std::set<std::uint32_t> faces;
    const double midpoint = c.inside(k).radians();
    for (const auto& loop : c.loops(k))
      for (const std::uint32_t p : loop) {
        faces.insert(p);
        for (const Point& v : c.ends(c.patches()[p], midpoint)) ridges.insert(spot(v));
      }
    count += static_cast<std::int64_t>(distinct.size()) - static_cast<std::int64_t>(edges.size() + ridges.size()) +
             static_cast<std::int64_t>(faces.size());
  }
  return count;
}

TEST(ConvexObstacle, random_hulls_equal_their_slices) {
  Random random(1);
  std::size_t total = 0;
  for (int i = 0; i < 120; ++i) {
    const int reach = 1 + static_cast<int>(random() % 8);
    const Region robot = random_convex(random, reach, 3 + static_cast<int>(random() % 6));
    const Region obstacle =
        random_convex(random, 1 + static_cast<int>(random() % 8), 3 + static_cast<int>(random() % 8));
    SCOPED_TRACE(testing::Message() << "pair " << i);
    const CspaceObstacle c = make(robot, obstacle);
    expect_obstacle(c, random);
    total += slabs(c);
    if (HasFailure()) return;
  }
  EXPECT_GT(total, 1000u);
}

TEST(ConvexObstacle, the_surface_is_a_torus) {
  Random random(2);
  for (int i = 0; i < 20; ++i) {
    const CspaceObstacle c = make(random_convex(random, 4, 5), random_convex(random, 6, 6));
    ASSERT_EQ(c.shells().size(), 1u);
    EXPECT_EQ(c.shells()[0].euler, euler_of_slabs(c));
    EXPECT_EQ(c.shells()[0].patches, c.patches().size());
    EXPECT_TRUE(c.shells()[0].outer);
    ASSERT_EQ(c.free_cells().size(), 1u);
    EXPECT_TRUE(c.free_cells()[0].unbounded);
  }
}

TEST(ConvexObstacle, simultaneous_alignments_are_one_angle) {
  Random random(3);
  const Region square = polygon({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}), box = polygon({{0, 0}, {5, 0}, {5, 2}, {0, 2}});
  const Region diamond = polygon({{1, 0}, {0, 1}, {-1, 0}, {0, -1}});
  const Region octagon = polygon({{1, 0}, {2, 0}, {3, 1}, {3, 2}, {2, 3}, {1, 3}, {0, 2}, {0, 1}});
  for (const auto& [robot, obstacle, angles] :
       {std::tuple{square, square, 4u}, std::tuple{square, box, 4u}, std::tuple{box, box, 4u},
        std::tuple{square, diamond, 4u}, std::tuple{diamond, octagon, 8u}, std::tuple{octagon, octagon, 8u}}) {
    const CspaceObstacle c = make(robot, obstacle);
    EXPECT_EQ(c.angles().size(), angles);
    expect_obstacle(c, random);
  }
  // Multiples of a quarter turn, exactly.
  const CspaceObstacle c = make(square, box);
  const std::vector<Orientation> quarters{*Orientation::of(-1, 1), Orientation(), *Orientation::of(1, 1),
                                          Orientation::half_turn()};
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(c.angles()[k].exact, quarters[k]);
  EXPECT_EQ(c.angles()[3].theta, M_PI);
  EXPECT_EQ(c.angles()[1].theta, 0);
}

TEST(ConvexObstacle, a_rational_turn_of_itself_meets_at_pythagorean_angles) {
  Random random(4);
  // 5 (3 4; -4 3) / 5 times a box, against the box: all four alignments are rational.
  const Region box = polygon({{0, 0}, {10, 0}, {10, 5}, {0, 5}}), turned = polygon({{0, 0}, {6, 8}, {2, 11}, {-4, 3}});
  const CspaceObstacle c = make(box, turned);
  EXPECT_EQ(c.angles().size(), 4u);
  for (const EventAngle& a : c.angles()) EXPECT_TRUE(a.exact.has_value());
  EXPECT_EQ(c.angles()[2].exact, *Orientation::of(1, 2));
  expect_obstacle(c, random);
}

TEST(ConvexObstacle, discs_and_far_coordinates) {
  Random random(5);
  expect_obstacle(make(snapped_shapes::disc(13, 1), snapped_shapes::disc(17, 2)), random, 40);
  expect_obstacle(make(snapped_shapes::disc(32, 1), snapped_shapes::disc(32, 1)), random, 40);
  const double far = 0x1p50;
  const CspaceObstacle c =
      make(polygon({{0, 0}, {1, 0}, {0, 1}}), polygon({{far, far}, {far + 3, far + 1}, {far + 1, far + 4}}));
  EXPECT_EQ(c.angles().size(), 9u);
  for (std::uint32_t slab = 0; slab < 9; ++slab) EXPECT_EQ(contacts(c, slab), contacts(*c.slice(c.inside(slab))));
  const double huge = 0x1p400, tiny = 0x1p-500;
  const CspaceObstacle extreme =
      make(polygon({{0, 0}, {tiny, 0}, {0, tiny}}), polygon({{0, 0}, {huge, tiny}, {0, huge}}));
  for (std::uint32_t slab = 0; slab < slabs(extreme); ++slab)
    EXPECT_EQ(contacts(extreme, slab), contacts(*extreme.slice(extreme.inside(slab))));
}

TEST(ConvexObstacle, angles_a_hair_apart_stay_apart) {
  // Edges that differ by one unit in the last place of a slope near 1.
  const double one = 1 + 0x1p-52;
  const Region robot = polygon({{0, 0}, {1, 0}, {1, 1}}), obstacle = polygon({{0, 0}, {one, 0}, {1, one}});
  const CspaceObstacle c = make(robot, obstacle);
  EXPECT_EQ(c.angles().size(), 9u);
  for (std::uint32_t slab = 0; slab < slabs(c); ++slab) {
    EXPECT_EQ(c.slab_of(c.inside(slab)), slab);
    EXPECT_EQ(contacts(c, slab), contacts(*c.slice(c.inside(slab))));
  }
}

// Against positions in the exact slice: strictly inside its one ring or not.
bool inside_slice(const PlanarSum& slice, double x, double y) {
  const std::vector<SumVertex>& ring = slice.parts[0].outer.vertices;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const RationalPoint a = slice.exact(ring[k]), b = slice.exact(ring[(k + 1) % ring.size()]);
    const BigRational ax = exact::exact_value(a.x), ay = exact::exact_value(a.y);
    const BigRational dx = exact::exact_value(b.x) - ax, dy = exact::exact_value(b.y) - ay;
    if (BigRational(dx * (exact::exact_value(y) - ay) - dy * (exact::exact_value(x) - ax)).sign() <= 0) return false;
  }
  return true;
}

TEST(CspaceObstacle, contains_equals_the_slice) {
  Random random(6);
  int inside = 0, boundary = 0;
  for (int i = 0; i < 60; ++i) {
    const CspaceObstacle c = make(random_convex(random, 3, 5), random_convex(random, 3, 6));
    // Quarter turns put vertices on the grid.
    const Orientation theta =
        i % 2 == 0 ? *Orientation::of(static_cast<int>(random() % 3) - 1, 1)
                   : *Orientation::of(static_cast<int>(random() % 9) - 4, 1 + static_cast<int>(random() % 4));
    const PlanarSum slice = *c.slice(theta);
    for (int k = 0; k < 40; ++k) {
      const double x = static_cast<int>(random() % 25) - 12, y = static_cast<int>(random() % 25) - 12;
      const bool expected = inside_slice(slice, x, y);
      EXPECT_EQ(c.contains(x, y, theta), expected);
      inside += expected;
    }
    for (const SumVertex& v : slice.parts[0].outer.vertices) {
      const RationalPoint at = slice.exact(v);
      if (at.x.denominator() != "1" || at.y.denominator() != "1") continue;
      EXPECT_FALSE(c.contains(at.x.to_double(), at.y.to_double(), theta));
      ++boundary;
    }
  }
  EXPECT_GT(inside, 100);
  EXPECT_GT(boundary, 20);
  const CspaceObstacle c = make(random_convex(random, 3, 5), random_convex(random, 3, 6));
  for (const double bad : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN(), 0x1p1000})
    EXPECT_FALSE(c.contains(bad, 0, Orientation()) || c.contains(0, bad, Orientation()));
}

TEST(CspaceObstacle, slabs_cover_the_circle_in_order) {
  Random random(7);
  for (int i = 0; i < 20; ++i) {
    const CspaceObstacle c = make(random_convex(random, 3, 5), random_convex(random, 3, 6));
    for (double theta = -3.14; theta <= 3.15; theta += 0.01) {
      const Orientation o = theta > M_PI ? Orientation::half_turn() : *Orientation::nearest(theta);
      const std::optional<std::uint32_t> slab = c.slab_of(o);
      if (!slab) continue;
      const double low = c.angles()[*slab].low, high = c.angles()[(*slab + 1) % slabs(c)].high;
      if (*slab + 1 < slabs(c)) {
        EXPECT_TRUE(low <= o.radians() && o.radians() <= high);
      } else {
        EXPECT_TRUE(low <= o.radians() || o.radians() <= high);
      }
    }
    // inside() has few bits.
    for (std::uint32_t slab = 0; slab < slabs(c); ++slab) {
      const Orientation inside = c.inside(slab);
      if (!inside.is_half_turn()) {
        EXPECT_LE(inside.tan_half().denominator().size(), 5u);
      }
    }
  }
}

TEST(CspaceObstacle, refuses_what_is_empty_or_too_large) {
  const Region box = shapes::rectangle(0, 0, 1, 1);
  const Region bad[] = {Region(), shapes::rectangle(0, 0, 0x1p401, 1)};
  for (const Region& region : bad) {
    EXPECT_EQ(CspaceObstacle::create(region, box).error().code, ErrorCode::unsupported_operand);
    EXPECT_EQ(CspaceObstacle::create(box, region).error().code, ErrorCode::unsupported_operand);
  }
  const Error error = CspaceObstacle::create(box, bad[1]).error();
  EXPECT_EQ(error.evidence.x, 0x1p401);
  EXPECT_EQ(error.evidence.y, 0);
  ObstacleOptions options;
  options.progress = [](std::string_view, double) { return false; };
  EXPECT_EQ(CspaceObstacle::create(box, box, options).error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace dymsum
