// The rungs of a planar lattice: integers of each width and numbers of any size tell the same signs. DYMSUM_FUZZ_SIGNS
// sets the number of signs for each kind of coordinates.
#include <gtest/gtest.h>

#include <set>

#include "dymsum/region.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/random.h"
#include "oracles/tiny_regions.h"
#include "oracles/verdict.h"
#include "planar/placed_pair.h"

namespace dymsum::planar {
namespace {

/// Of the tiers that hold these operands, from the narrowest on, and last numbers of any size.
std::vector<std::shared_ptr<const Lattice>> lattices_of(const Operand& p, const Operand& q) {
  std::vector<std::shared_ptr<const Lattice>> list;
  for (const int tier : {0, 61, 512, 513}) {
    const auto lattice = make_lattice(p.points, q.points, tier);
    if (list.empty() || lattice->tier_bits != list.back()->tier_bits) list.push_back(lattice);
  }
  return list;
}

class LatticeRungs : public testing::TestWithParam<CoordinateKind> {};

TEST_P(LatticeRungs, tell_the_same_signs) {
  std::mt19937_64 noise(5);
  oracles::Random random(77);
  const std::uint64_t wanted = oracles::setting("DYMSUM_FUZZ_SIGNS", 20'000);
  std::uint64_t signs = 0, zeros = 0;
  std::set<int> tiers;
  while (signs < wanted) {
    const auto drawn = [&] { return Region::create(of_kind(oracles::random_region(random, 6), GetParam(), noise)); };
    const auto a = drawn(), b = drawn();
    if (!a || !b || a->vertex_count() == 0 || b->vertex_count() == 0) continue;
    const auto p = prepared_operand(*a, 0), q = prepared_operand(*b, 1);
    const auto lattices = lattices_of(*p, *q);
    const Lattice& big = *lattices.back();
    for (const auto& lattice : lattices) tiers.insert(lattice->tier_bits);
    const auto told = [&](const char* what, auto ask) {
      const int sign = ask(big);
      for (const auto& lattice : lattices)
        EXPECT_EQ(ask(*lattice), sign) << what << ", " << lattice->tier_bits << " bits";
      zeros += sign == 0;
      ++signs;
      return sign;
    };
    const auto any = [&](std::size_t n) { return static_cast<std::uint32_t>(random.below(static_cast<int>(n))); };
    const auto segment = [&] {
      const bool of_p = random.chance(50);
      const Operand &o = of_p ? *p : *q, &v = of_p ? *q : *p;
      return Segment{o.edge(any(o.size())), v.source[any(v.size())]};
    };
    const auto pair = [&] { return Pair{p->source[any(p->size())], q->source[any(q->size())]}; };
    const auto crossing = [&](const Segment& on) -> std::optional<Cut> {
      for (int k = 0; k < 20; ++k)
        if (const Segment by = segment(); big.cross(on.edge, by.edge) != 0) return Cut{Cut::Kind::crossing, {}, by};
      return std::nullopt;
    };
    for (int k = 0; k < 40; ++k) {
      const Segment s = segment(), t = segment();
      const Pair v = pair(), w = pair();
      const int axis = k % 2;
      told("cross", [&](const Lattice& l) { return l.cross(s.edge, t.edge); });
      told("dot", [&](const Lattice& l) { return l.dot(s.edge, t.edge); });
      told("extents", [&](const Lattice& l) { return l.compare_extent(s.edge, t.edge, axis); });
      told("side of a pair", [&](const Lattice& l) { return l.side(s, v); });
      told("along to a pair", [&](const Lattice& l) { return l.along(s, v); });
      told("pairs", [&](const Lattice& l) { return l.compare_coordinate(v, w, axis); });
      Place x;
      x.on = segment();
      const std::optional<Cut> first = crossing(x.on), second = crossing(x.on);
      if (!first || !second) continue;
      x.first = *first;
      x.between = random.chance(30);
      x.second = *second;
      told("cuts", [&](const Lattice& l) { return l.compare(x.on, *first, *second); });
      told("side of a place", [&](const Lattice& l) { return l.side(s, x); });
      told("along to a place", [&](const Lattice& l) { return l.along(s, x); });
      told("pair and place", [&](const Lattice& l) { return l.compare_coordinate(v, x, axis); });
    }
  }
  EXPECT_GT(zeros, signs / 1000);
  EXPECT_GE(tiers.size(), 2u) << "more than one rung was asked";
  EXPECT_TRUE(tiers.contains(0));
}

INSTANTIATE_TEST_SUITE_P(Kinds, LatticeRungs, testing::ValuesIn(kCoordinateKinds),
                         [](const auto& kind) { return test_name_of(kind.param); });

}  // namespace
}  // namespace dymsum::planar
