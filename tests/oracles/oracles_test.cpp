// The slow answers against each other and against sums that can be written down: convex hulls and unions of lattice
// cells.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "reference_sum.h"
#include "tiny_regions.h"

namespace dymsum::oracles {
namespace {

constexpr std::uint64_t kSeed = 20160601;

Pt<Small> at_half(int x, int y) { return {Small(Wide{x}, Wide{2}), Small(Wide{y}, Wide{2})}; }

RegionData polygon(Ring ring) {
  RegionData out;
  out.parts.push_back({std::move(ring), {}});
  return out;
}

Ring box(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

TEST(Membership, of_convex_polygons_is_the_hull_of_vertex_sums) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kSeed));
  Random random(kSeed);
  int inside = 0, boundary = 0, outside = 0;
  for (int pair = 0; pair < 150; ++pair) {
    const Ring a = random_polygon(random, 4, 3), b = random_polygon(random, 4, 3);
    std::vector<Pt<Small>> sums;
    for (const Point& u : a)
      for (const Point& v : b) sums.push_back({from_double<Small>(u.x + v.x), from_double<Small>(u.y + v.y)});
    const Membership<Small> member(polygon(a), polygon(b));
    for (int x = -1; x <= 17; ++x)
      for (int y = -1; y <= 17; ++y) {
        const Pt<Small> z = at_half(x, y);
        // z is outside exactly when a line through two sums has z strictly right of it and no sum there.
        bool out = false, on = false;
        for (const auto& u : sums)
          for (const auto& v : sums) {
            if (u == v) continue;
            if (!std::all_of(sums.begin(), sums.end(), [&](const auto& w) { return turn(u, v, w) >= 0; })) continue;
            out = out || turn(u, v, z) < 0;
            on = on || turn(u, v, z) == 0;
          }
        ASSERT_EQ(member.meets(z), !out);
        ASSERT_EQ(member.overlaps(z), !out && !on);
        (out ? outside : on ? boundary : inside) += 1;
      }
  }
  EXPECT_GT(inside, 1000);
  EXPECT_GT(boundary, 1000);
  EXPECT_GT(outside, 1000);
}

/// A lattice complex in doubled coordinates: even numbers are lattice lines, odd ones the open cells between them.
struct Cells {
  int width, height;
  std::vector<bool> filled;
  bool cell(int x, int y) const {
    return x >= 0 && y >= 0 && x < width && y < height && filled[static_cast<std::size_t>(y * width + x)];
  }
  /// The open face with doubled coordinates (u, v) is in the closed set, or in its interior.
  bool has(int u, int v, bool interior) const {
    bool any = false, all = true;
    for (int x = (u - 1) / 2 - 1; x <= u / 2 + 1; ++x)
      for (int y = (v - 1) / 2 - 1; y <= v / 2 + 1; ++y) {
        if (std::abs(2 * x + 1 - u) > 1 || std::abs(2 * y + 1 - v) > 1) continue;
        any = any || cell(x, y);
        all = all && cell(x, y);
      }
    return interior ? all : any;
  }
};

/// The coordinate z/2 lies in the sum of the faces u and v: point + point, point + interval, interval + interval
/// (open).
bool covers(int u, int v, int z) {
  const int spread = (u & 1) + (v & 1);
  return spread == 0 ? z == u + v : std::abs(z - u - v) < spread + (spread == 0 ? 1 : 0);
}

bool covered(const Cells& a, const Cells& b, int x, int y, bool a_open, bool b_open) {
  for (int u = 0; u <= 2 * a.width; ++u)
    for (int v = 0; v <= 2 * a.height; ++v) {
      if (!a.has(u, v, a_open)) continue;
      for (int s = 0; s <= 2 * b.width; ++s)
        for (int t = 0; t <= 2 * b.height; ++t)
          if (covers(u, s, x) && covers(v, t, y) && b.has(s, t, b_open)) return true;
    }
  return false;
}

Cells random_bitmap(Random& random, int width, int height) {
  Cells out{width, height, std::vector<bool>(static_cast<std::size_t>(width * height))};
  for (std::size_t i = 0; i < out.filled.size(); ++i) out.filled[i] = random.chance(65);
  out.filled[0] = true;
  return out;
}

TEST(Membership, of_lattice_cells_is_the_sum_of_their_faces) {
  Random random(kSeed + 1);
  int open = 0, touching = 0;
  for (int pair = 0; pair < 60; ++pair) {
    const Cells a = random_bitmap(random, 4, 4), b = random_bitmap(random, 2 + random.below(2), 1 + random.below(3));
    const RegionData p = cells_region(a.filled, a.width, a.height, pair % 2 == 0);
    const RegionData q = cells_region(b.filled, b.width, b.height, pair % 3 == 0);
    const Membership<Small> member(p, q);
    for (int x = -1; x <= 2 * (a.width + b.width) + 1; ++x)
      for (int y = -1; y <= 2 * (a.height + b.height) + 1; ++y) {
        const Pt<Small> z = at_half(x, y);
        const bool closed = covered(a, b, x, y, false, false);
        const bool inner = covered(a, b, x, y, true, false) || covered(a, b, x, y, false, true);
        ASSERT_EQ(member.meets(z), closed) << "pair " << pair << " at " << x << "/2, " << y << "/2";
        ASSERT_EQ(member.overlaps(z), inner) << "pair " << pair << " at " << x << "/2, " << y << "/2";
        open += inner ? 1 : 0;
        touching += closed && !inner ? 1 : 0;
      }
  }
  EXPECT_GT(open, 1000);
  EXPECT_GT(touching, 300);
}

TEST(Membership, holds_is_the_complement_of_overlapping_the_outside) {
  Random random(kSeed + 2);
  int held = 0;
  for (int pair = 0; pair < 60; ++pair) {
    const Cells a = random_bitmap(random, 5, 4), b = random_bitmap(random, 1 + random.below(2), 1 + random.below(2));
    const RegionData p = cells_region(a.filled, a.width, a.height, pair % 2 == 0);
    const RegionData q = cells_region(b.filled, b.width, b.height, false);
    const Membership<Small> member(p, q);
    for (int x = -3; x <= 11; ++x)
      for (int y = -3; y <= 9; ++y) {
        bool inside = true;  // every face of x/2, y/2 + Q lies in P; for half positions cut the faces of Q in halves
        for (int u = 0; u <= 4 * b.width; ++u)
          for (int v = 0; v <= 4 * b.height; ++v) {
            // the position (x, y)/2 + (u, v)/4, and whether Q has it
            if (!b.has(u % 4 == 0   ? u / 2
                       : u % 4 == 2 ? u / 2
                                    : u / 4 * 2 + 1,
                       v % 4 == 0   ? v / 2
                       : v % 4 == 2 ? v / 2
                                    : v / 4 * 2 + 1,
                       false))
              continue;
            const int s = 2 * x + u, t = 2 * y + v;  // in quarters
            const auto face = [](int quarter) {
              const int floor = quarter >= 0 ? quarter / 4 : -((3 - quarter) / 4);
              return quarter == 4 * floor ? 2 * floor : 2 * floor + 1;
            };
            inside = inside && a.has(face(s), face(t), false);
          }
        ASSERT_EQ(member.holds(at_half(x, y)), inside) << "pair " << pair << " at " << x << "/2, " << y << "/2";
        held += inside ? 1 : 0;
      }
  }
  EXPECT_GT(held, 300);
}

TEST(Membership, a_line_through_a_touched_edge_enters_nothing) {
  RegionData pinched = polygon({{0, 0}, {2, 0}, {0, 2}}), pole;  // the hole's three vertices lie on the outer ring
  pinched.parts[0].holes.push_back({{1, 1}, {1, 0}, {0, 1}});
  pole.polylines.push_back({{0, 0}, {0, 1}});
  const Membership<Small> member(pinched, pole);
  EXPECT_TRUE(member.meets(at_half(2, 1)));
  EXPECT_FALSE(member.overlaps(at_half(2, 1)));  // along the hole's edge, and out through the touched point
  const auto sum = reference_sum<Small>(pinched, pole, Semantics::closed);
  EXPECT_EQ(sum.tight_segments.size(), 1u);
  RegionData bow = polygon({{0, 0}, {2, 0}, {2, 1}, {0, 1}});
  bow.parts.push_back({{{1, 1}, {2, 2}, {0, 2}}, {}});  // stands on the centre of the box's upper edge
  EXPECT_TRUE((Membership<Small>(bow, pole).holds(at_half(2, 1))));
  EXPECT_FALSE((Membership<Small>(bow, pole).holds(at_half(1, 1))));
}

TEST(Membership, is_the_same_in_both_number_types) {
  Random random(kSeed + 3);
  for (int pair = 0; pair < 60; ++pair) {
    const RegionData p = random_region(random, 4), q = random_region(random, 4);
    const Membership<Small> small(p, q);
    const Membership<Big> big(p, q);
    for (int i = 0; i < 10; ++i) {
      const int x = random.below(50), y = random.below(50);
      const Pt<Small> z{Small(Wide{x}, Wide{6}), Small(Wide{y}, Wide{6})};
      const Pt<Big> same{to_big(z.x), to_big(z.y)};
      ASSERT_EQ(small.meets(z), big.meets(same));
      ASSERT_EQ(small.overlaps(z), big.overlaps(same));
    }
  }
}

TEST(ReferenceSum, square_plus_square_has_one_rim_and_nothing_else) {
  const auto sum = reference_sum<Small>(polygon(box(0, 0, 1, 1)), polygon(box(0, 0, 1, 1)), Semantics::closed);
  EXPECT_EQ(sum.rim.size(), 8u);  // four sides of length two, cut in the middle
  EXPECT_TRUE(sum.tight_segments.empty());
  EXPECT_TRUE(sum.tight_points.empty());
}

TEST(ReferenceSum, square_in_its_exact_cavity_is_a_tight_point) {
  RegionData frame = polygon(box(0, 0, 3, 3));
  frame.parts[0].holes.push_back({{1, 1}, {1, 2}, {2, 2}, {2, 1}});
  const auto sum = reference_sum<Small>(frame, polygon(box(-1, -1, 0, 0)), Semantics::closed);
  ASSERT_EQ(sum.tight_points.size(), 1u);
  EXPECT_TRUE(sum.tight_points[0] == (Pt<Small>{Small(1), Small(1)}));
  EXPECT_TRUE(sum.tight_segments.empty());
}

TEST(ReferenceSum, peg_in_its_slot_is_an_antenna_down_to_the_bottom) {
  const RegionData slot = polygon({{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}});
  const auto sum = reference_sum<Small>(slot, polygon(box(-1, -1, 0, 0)), Semantics::open);
  ASSERT_EQ(sum.tight_segments.size(), 1u);
  EXPECT_TRUE(sum.tight_segments[0] == (Seg<Small>{{Small(1), Small(1)}, {Small(1), Small(2)}}));
  EXPECT_TRUE(sum.tight_points.empty());
}

TEST(ReferenceSum, polylines_span_a_parallelogram_and_points_stay_points) {
  RegionData across, upright, dots;
  across.polylines.push_back({{0, 0}, {2, 0}});
  upright.polylines.push_back({{0, 0}, {0, 1}});
  dots.points = {{0, 0}, {5, 0}};
  EXPECT_EQ(reference_sum<Small>(across, upright, Semantics::closed).rim.size(), 4u);
  EXPECT_EQ(reference_sum<Small>(across, upright, Semantics::open).rim.size(), 0u);
  EXPECT_EQ(reference_sum<Small>(across, across, Semantics::closed).segments.size(), 1u);
  EXPECT_EQ(reference_sum<Small>(across, dots, Semantics::closed).segments.size(), 2u);
  EXPECT_EQ(reference_sum<Small>(dots, dots, Semantics::closed).points.size(), 3u);
}

TEST(ReferenceSum, eroding_a_box_by_itself_leaves_one_point) {
  const RegionData square = polygon(box(1, 1, 3, 2));
  const auto sum = reference_erode<Small>(square, square);
  ASSERT_EQ(sum.points.size(), 1u);
  EXPECT_TRUE(sum.points[0] == (Pt<Small>{Small(0), Small(0)}));
  EXPECT_TRUE(sum.rim.empty());
}

TEST(ReferenceSum, agrees_with_its_mirror_image) {
  Random random(kSeed + 4);
  std::size_t tight = 0;
  for (int pair = 0; pair < 200; ++pair) {
    const auto [p, q] = random_pair(random, 4);
    const auto sum = reference_sum<Small>(p, q, Semantics::closed);
    const auto swapped = reference_sum<Small>(q, p, Semantics::closed);
    ASSERT_EQ(sum.rim, swapped.rim) << "pair " << pair;
    ASSERT_EQ(sum.segments, swapped.segments) << "pair " << pair;
    ASSERT_EQ(sum.points, swapped.points) << "pair " << pair;
    ASSERT_EQ(sum.tight_segments, swapped.tight_segments) << "pair " << pair;
    ASSERT_EQ(sum.tight_points, swapped.tight_points) << "pair " << pair;
    tight += sum.tight_segments.size() + sum.tight_points.size();
  }
  EXPECT_GT(tight, 40u);
}

}  // namespace
}  // namespace dymsum::oracles
