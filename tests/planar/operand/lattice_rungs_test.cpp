// The rungs of a planar lattice: integers of each width and numbers of any size tell the same signs. DYMSUM_FUZZ_SIGNS
// sets the number of signs for each kind of coordinates.
#include <gtest/gtest.h>

#include <set>

#include "dymsum/region.h"
#include "exact/orient.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/random.h"
#include "oracles/tiny_regions.h"
#include "oracles/verdict.h"
#include "planar/operand/fine_lattice.h"
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
    const auto decided = [&](const char* what, auto query) {
      const int sign = query(big);
      for (const auto& lattice : lattices)
        EXPECT_EQ(query(*lattice), sign) << what << ", " << lattice->tier_bits << " bits";
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
      decided("cross", [&](const Lattice& l) { return l.cross(s.edge, t.edge); });
      decided("dot", [&](const Lattice& l) { return l.dot(s.edge, t.edge); });
      decided("extents", [&](const Lattice& l) { return l.compare_extent(s.edge, t.edge, axis); });
      decided("side of a pair", [&](const Lattice& l) { return l.side(s, v); });
      decided("along to a pair", [&](const Lattice& l) { return l.along(s, v); });
      decided("pairs", [&](const Lattice& l) { return l.compare_coordinate(v, w, axis); });
      SegmentPosition x;
      x.on = segment();
      const std::optional<Cut> first = crossing(x.on), second = crossing(x.on);
      if (!first || !second) continue;
      x.first = *first;
      x.between = random.chance(30);
      x.second = *second;
      decided("cuts", [&](const Lattice& l) { return l.compare(x.on, *first, *second); });
      decided("side of a place", [&](const Lattice& l) { return l.side(s, x); });
      decided("along to a place", [&](const Lattice& l) { return l.along(s, x); });
      decided("pair and place", [&](const Lattice& l) { return l.compare_coordinate(v, x, axis); });
    }
  }
  EXPECT_GT(zeros, signs / 1000);
  EXPECT_GE(tiers.size(), 2u) << "more than one rung was asked";
  EXPECT_TRUE(tiers.contains(0));
}

// Of scaled operands, whose integers are at most 125 bits long here, so that they are asked without pairs of doubles.
TEST_P(LatticeRungs, pairs_of_doubles_tell_nearly_all_signs_and_none_wrong) {
  std::mt19937_64 noise(6);
  oracles::Random random(78);
  const std::uint64_t wanted = oracles::setting("DYMSUM_FUZZ_SIGNS", 20'000);
  exact::RungCounts decided;
  while (decided.filtered() + decided.exact() < wanted) {
    const auto drawn = [&] { return Region::create(of_kind(oracles::random_region(random, 6), GetParam(), noise)); };
    const auto a = drawn(), b = drawn();
    if (!a || !b || a->vertex_count() == 0 || b->vertex_count() == 0) continue;
    const auto p = prepared_operand(*a, 0), q = prepared_operand(*b, 1);
    LatticeScale scale;
    scale.x = 1 + random.below(1 << 30);
    scale.y = random.chance(50) ? scale.x : exact::BigInteger(1 + random.below(1 << 30));
    scale.den = 1 + random.below(1 << 30);
    scale.op = random.chance(50) ? 1 : 0;
    const auto unscaled = make_lattice(p->points, q->points, 0, Further::lattices);
    const auto lattice = make_scaled_lattice(*unscaled, scale, 0);
    if (lattice->tier_bits == 0) continue;
    const FineLattice fine(*lattice, scale);
    const auto any = [&](std::size_t n) { return static_cast<std::uint32_t>(random.below(static_cast<int>(n))); };
    const auto segment = [&] {
      const bool of_p = random.chance(50);
      const Operand &o = of_p ? *p : *q, &v = of_p ? *q : *p;
      return Segment{o.edge(any(o.size())), v.source[any(v.size())]};
    };
    const auto pair = [&] { return Pair{p->source[any(p->size())], q->source[any(q->size())]}; };
    const auto query = [&](const char* what, int sign, std::optional<int> finely) {
      EXPECT_EQ(finely.value_or(sign), sign) << what;
      if (finely || sign != 0) decided.count(finely ? exact::Rung::double_pairs : exact::Rung::integers);
    };
    for (int k = 0; k < 40; ++k) {
      const Segment s = segment(), t = segment();
      const Pair v = pair(), w = pair();
      const int axis = k % 2;
      query("cross", lattice->cross(s.edge, t.edge), fine.cross(s.edge, t.edge));
      query("side of a pair", lattice->side(s, v), fine.side(s, v));
      query("along to a pair", lattice->along(s, v), fine.along(s, v));
      query("pairs", lattice->compare_coordinate(v, w, axis), fine.compare_coordinate(v, w, axis));
      // Cuts by lines that cross it, and at its ends.
      const auto cut_of = [&](const Segment& on) {
        const bool crossed = random.chance(60);
        for (int i = 0; i < 20 && crossed; ++i)
          if (const Segment by = segment(); lattice->cross(on.edge, by.edge) != 0)
            return Cut{Cut::Kind::crossing, {}, by};
        return Cut{Cut::Kind::pair, random.chance(50) ? start_of(on) : end_of(on), {}};
      };
      const auto position = [&] {
        SegmentPosition x;
        x.on = segment();
        x.first = cut_of(x.on);
        x.between = random.chance(40);
        x.second = cut_of(x.on);
        return x;
      };
      const SegmentPosition x = position(), y = position();
      query("cuts", lattice->compare(x.on, x.first, x.second), fine.compare(x.on, x.first, x.second));
      query("side of a place", lattice->side(s, x), fine.side(s, x));
      query("along to a place", lattice->along(s, x), fine.along(s, x));
      query("pair and place", lattice->compare_coordinate(v, x, axis), fine.compare_coordinate(v, x, axis));
      query("places", lattice->compare_coordinate(x, y, axis), fine.compare_coordinate(x, y, axis));
    }
    if (HasFailure()) return;
  }
  EXPECT_LT(decided.at(exact::Rung::integers) * 1000, decided.filtered());
}

INSTANTIATE_TEST_SUITE_P(Kinds, LatticeRungs, testing::ValuesIn(kCoordinateKinds),
                         [](const auto& kind) { return test_name_of(kind.param); });

}  // namespace
}  // namespace dymsum::planar
