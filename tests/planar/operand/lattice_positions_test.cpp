// A lattice remembers the place it was queried last. Whatever is asked in between, of whichever lattice, the signs
// are those of integers of any size, which remember nothing.
#include <gtest/gtest.h>

#include "dymsum/region.h"
#include "oracles/random.h"
#include "planar/placed_pair.h"

namespace dymsum::planar {
namespace {

Region turned_stairs(double degrees, int steps) {
  const double theta = degrees * std::numbers::pi / 180, c = std::cos(theta), s = std::sin(theta);
  RegionData data;
  data.parts.push_back({{}, {}});
  const auto add = [&](double x, double y) { data.parts[0].outer.push_back({c * x - s * y, s * x + c * y}); };
  add(0, 0);
  for (int k = 0; k < steps; ++k) {
    add(steps - k, k);
    add(steps - k, k + 1);
  }
  add(0, steps);
  return Region::create(std::move(data)).value();
}

struct Lattices {
  std::shared_ptr<const Operand> p, q;
  std::shared_ptr<const Lattice> fast, slow;
  Lattices(const Region& a, const Region& b) : p(prepared_operand(a, 0)), q(prepared_operand(b, 1)) {
    fast = make_lattice(p->points, q->points, 0);
    slow = make_lattice(p->points, q->points, 513);
  }
};

TEST(LatticePositions, remembered_places_are_those_that_are_asked_about) {
  oracles::Random random(8);
  int zeros = 0, signs = 0;
  for (int round = 0; round < 30; ++round) {
    const Region a = turned_stairs(30, 3), b = turned_stairs(random.chance(50) ? 30 : 77, 4);
    // Lattices come and go, and may have each other's addresses.
    const Lattices one(a, b), other(turned_stairs(random.chance(50) ? 30.5 : 120, 3), b);
    EXPECT_EQ(one.fast->tier_bits, 61);
    EXPECT_NE(one.slow->tier_bits, 61);
    std::vector<SegmentPosition> positions;
    const auto segment = [&] {
      const bool of_p = random.chance(50);
      const Operand &o = of_p ? *one.p : *one.q, &v = of_p ? *one.q : *one.p;
      return Segment{o.edge(static_cast<std::uint32_t>(random.below(static_cast<int>(o.size())))),
                     v.source[static_cast<std::size_t>(random.below(static_cast<int>(v.size())))]};
    };
    const auto crossing = [&](const Segment& on) {
      for (;;)
        if (const Segment by = segment();
            one.slow->cross(on.edge, by.edge) != 0 && other.slow->cross(on.edge, by.edge) != 0)
          return Cut{Cut::Kind::crossing, {}, by};
    };
    for (int k = 0; k < 6; ++k) {
      SegmentPosition x;
      x.on = segment();
      x.first = crossing(x.on);
      x.between = random.chance(50);
      if (x.between) x.second = crossing(x.on);
      positions.push_back(x);
    }
    for (int k = 0; k < 300; ++k) {
      const Lattices& l = random.chance(50) ? one : other;
      const SegmentPosition& x = positions[static_cast<std::size_t>(random.below(6))];
      const Segment s = segment();
      const int sign = l.slow->side(s, x);
      EXPECT_EQ(l.fast->side(s, x), sign);
      EXPECT_EQ(l.fast->along(s, x), l.slow->along(s, x));
      zeros += sign == 0;
      ++signs;
    }
  }
  EXPECT_GT(zeros, 10);
  EXPECT_LT(zeros, signs / 2);
}

}  // namespace
}  // namespace dymsum::planar
