// The three convolutions against their definition, edge by edge, and the structure the engines rely on.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <map>
#include <set>
#include <tuple>

#include "dymsum/planar_sum.h"
#include "dymsum/region_io.h"
#include "dymsum/shapes.h"
#include "oracles/pair_text.h"
#include "oracles/snapped_shapes.h"
#include "oracles/tiny_regions.h"
#include "planar/convolution/convolution.h"
#include "planar/operand/operand.h"

namespace dymsum::planar {
namespace {

constexpr std::uint64_t kSeed = 271828;

struct Operands {
  Operands(const Region& a, const Region& b) {
    const auto kept_p = prepared_operand(a, 0), kept_q = prepared_operand(b, 1);
    lattice = make_lattice(kept_p->points, kept_q->points, 0);
    p = *placed_on(*lattice, kept_p);
    q = *placed_on(*lattice, kept_q);
  }
  const Operand& of(std::uint32_t op) const { return op == 0 ? p : q; }

  std::shared_ptr<const Lattice> lattice;
  Operand p, q;
};

/// Calls check for tiny-grid pairs, on which parallel edges are the rule, and for some generated shapes.
template <class Check>
void for_pairs(int count, const Check& check) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kSeed));
  for (int k = 0; k < count; ++k) {
    oracles::Random random(kSeed + static_cast<std::uint64_t>(k));
    const auto [p, q] = oracles::random_pair(random, 2 + random.below(5));
    SCOPED_TRACE("pair " + std::to_string(k) + "\n" + oracles::to_text(p, q));
    check(Region::create(p).value(), Region::create(q).value());
    if (::testing::Test::HasFailure()) return;
  }
  const Region shapes[] = {snapped_shapes::star(7, 1, 3), shapes::grate(4, 3, 1, 5), shapes::random_polygon(20, 2, 5),
                           shapes::comb(3, 2, 1, 4)};
  for (const Region& p : shapes)
    for (const Region& q : shapes) check(p, q);
}

using Position = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;  // side, edge, vertex

Position key(const WalkSegment& w) { return {w.side, w.edge, w.vertex}; }

std::vector<int> counts_at_pairs(const Operands& o, const std::vector<KineticSegment>& segments) {
  std::vector<int> balance(o.p.size() * o.q.size(), 0);
  for (const KineticSegment& s : segments) {
    const std::uint32_t from = s.walk.edge, to = o.of(s.walk.side).next[s.walk.edge], v = s.walk.vertex;
    const auto pair = [&](std::uint32_t i) { return s.walk.side == 0 ? i * o.q.size() + v : v * o.q.size() + i; };
    balance[pair(from)] += s.sign;
    balance[pair(to)] -= s.sign;
  }
  return balance;
}

TEST(KineticConvolution, starts_as_many_segments_at_every_pair_of_vertices_as_it_ends) {
  std::size_t reversed = 0;
  for_pairs(400, [&](const Region& p, const Region& q) {
    const Operands o(p, q);
    const auto segments = kinetic_convolution(*o.lattice, o.p, o.q);
    for (const KineticSegment& s : segments) reversed += s.sign < 0;
    for (const int b : counts_at_pairs(o, segments)) ASSERT_EQ(b, 0);
  });
  EXPECT_GT(reversed, 1000u);
}

/// The position of direction e in the turn from a to b, counter-clockwise: rotating e by an infinitesimal angle,
/// clockwise when `clockwise`, puts it strictly between them. Angles are compared by quarter turns and cross products
/// alone.
bool strictly_between(const Operands& o, const Edge& a, const Edge& e, const Edge& b, bool clockwise) {
  const auto turn = [&](const Edge& from, const Edge& to) {  // 0, (0, pi), pi, (pi, 2 pi)
    const int c = o.lattice->cross(from, to);
    return c > 0 ? 1 : c < 0 ? 3 : o.lattice->dot(from, to) > 0 ? 0 : 2;
  };
  const int te = turn(a, e), tb = turn(a, b);
  if (te == 0) return !clockwise;  // leaves a into the turn, or away from it
  if (turn(e, b) == 0) return clockwise;
  if (te != tb) return te < tb;
  return te != 2 && o.lattice->cross(e, b) > 0;
}

struct Expected {
  std::map<Position, int> kinetic;  // place -> sign
  std::set<Position> reduced;
  std::uint64_t full = 0;
};

// Straight from the definitions: every vertex against every edge.
Expected by_definition(const Operands& o) {
  Expected out;
  const auto hidden = [&](std::uint32_t op, const Loop& loop, const Component& other) {
    return loop.kind == LoopKind::hole && hole_is_filled(*o.lattice, o.of(op), loop, o.of(1 - op), other);
  };
  for (std::uint32_t side = 0; side < 2; ++side) {
    const Operand &edges = o.of(side), &vertices = o.of(1 - side);
    for (const Loop& lv : vertices.loops)
      for (const Loop& le : edges.loops) {
        const Component &cv = vertices.components[lv.component], &ce = edges.components[le.component];
        if ((cv.dimension < 2 && ce.dimension < 2) || le.kind == LoopKind::point) continue;
        if (hidden(1 - side, lv, ce) || hidden(side, le, cv)) continue;
        for (std::uint32_t v = lv.first; v < lv.last; ++v)
          for (std::uint32_t e = le.first; e < le.last; ++e) {
            const Position position{side, e, v};
            bool convex = true, met = true;
            if (lv.kind != LoopKind::point) {
              const Edge in = vertices.edge(vertices.prev[v]), way_out = vertices.edge(v);
              convex = vertices.convex[v];
              const bool straight = o.lattice->cross(in, way_out) == 0 && o.lattice->dot(in, way_out) > 0;
              if (straight) continue;  // where rings touch: no turn
              // Q is turned counter-clockwise: against it, edges of P turn clockwise.
              met = convex ? strictly_between(o, in, edges.edge(e), way_out, side == 0)
                           : strictly_between(o, way_out, edges.edge(e), in, side == 0);
            }
            out.full += convex == met;
            if (met) out.kinetic[position] = convex ? 1 : -1;
            if (met && convex && !(lv.kind == LoopKind::hole && le.kind == LoopKind::hole))
              out.reduced.insert(position);
          }
      }
  }
  return out;
}

TEST(Convolutions, are_as_defined) {
  std::uint64_t segments = 0;
  for_pairs(250, [&](const Region& p, const Region& q) {
    const Operands o(p, q);
    const Expected want = by_definition(o);
    std::map<Position, int> kinetic;
    for (const KineticSegment& s : kinetic_convolution(*o.lattice, o.p, o.q))
      ASSERT_TRUE(kinetic.emplace(key(s.walk), s.sign).second) << "twice";
    EXPECT_TRUE(kinetic == want.kinetic);
    std::set<Position> reduced;
    ReducedConvolution(*o.lattice, o.p, o.q).for_each([&](const WalkSegment& w) { reduced.insert(key(w)); });
    EXPECT_TRUE(reduced == want.reduced);
    const ConvolutionSizes sizes = convolution_sizes(p, q);
    EXPECT_EQ(sizes.full, want.full);
    EXPECT_EQ(sizes.kinetic, want.kinetic.size());
    EXPECT_EQ(sizes.reduced, want.reduced.size());
    segments += want.full;
  });
  EXPECT_GT(segments, 5000u);
}

TEST(ReducedConvolution, finds_every_segment_by_its_number_and_chains_both_ways) {
  std::size_t chained = 0;
  for_pairs(250, [&](const Region& p, const Region& q) {
    const Operands o(p, q);
    const ReducedConvolution convolution(*o.lattice, o.p, o.q);
    std::vector<WalkSegment> all;
    convolution.for_each([&](const WalkSegment& w) { all.push_back(w); });
    ASSERT_EQ(all.size(), convolution.size());
    std::vector<std::uint32_t> next_of(all.size());
    convolution.fill_next(next_of);
    for (std::uint32_t id = 0; id < all.size(); ++id) {
      ASSERT_EQ(convolution.find(all[id].side, all[id].edge, all[id].vertex), id);
      const std::uint32_t next = convolution.next(all[id]);
      ASSERT_EQ(next_of[id], next);
      if (next == kNoRank) continue;
      ASSERT_LT(next, all.size());
      ASSERT_EQ(convolution.prev(all[next]), id);
      ++chained;
    }
  });
  EXPECT_GT(chained, 2000u);
}

TEST(ReducedConvolution, counts_edges_that_have_one_of_the_other_operand_in_their_direction) {
  std::size_t parallel = 0;
  for_pairs(250, [&](const Region& p, const Region& q) {
    const Operands o(p, q);
    if (o.p.loops.size() != 1 || o.q.loops.size() != 1) return;
    if (o.p.components[0].dimension != 2 && o.q.components[0].dimension != 2) return;
    std::size_t expected = 0;
    for (std::uint32_t e = 0; e < o.p.size(); ++e) {
      bool found = false;
      for (std::uint32_t f = 0; f < o.q.size(); ++f)
        found |= o.lattice->cross(o.p.edge(e), o.q.edge(f)) == 0 && o.lattice->dot(o.p.edge(e), o.q.edge(f)) > 0;
      expected += found;
    }
    ASSERT_EQ(ReducedConvolution(*o.lattice, o.p, o.q).parallel_edges(), expected);
    parallel += expected;
  });
  EXPECT_GT(parallel, 100u);
}

TEST(ConvolutionSizes, of_empty_and_thin_operands) {
  const Region square = shapes::rectangle(0, 0, 1, 1), none;
  const Region point = Region::create({{}, {}, {Point{3, 4}}}).value();
  const Region segment = Region::create({{}, {{Point{0, 0}, Point{2, 1}}}, {}}).value();
  EXPECT_EQ(convolution_sizes(square, none), (ConvolutionSizes{0, 0, 0}));
  EXPECT_EQ(convolution_sizes(none, none), (ConvolutionSizes{0, 0, 0}));
  EXPECT_EQ(convolution_sizes(square, square), (ConvolutionSizes{8, 8, 8}));
  EXPECT_EQ(convolution_sizes(square, point), (ConvolutionSizes{4, 4, 4}));
  EXPECT_EQ(convolution_sizes(square, segment), (ConvolutionSizes{6, 6, 6}));
  EXPECT_EQ(convolution_sizes(segment, segment), (ConvolutionSizes{0, 0, 0}));
}

TEST(ConvolutionSizes, a_hole_too_small_for_the_other_operand_counts_nothing) {
  const Region plate =
      Region::create({{{{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, {{{3, 3}, {3, 5}, {5, 5}, {5, 3}}}}}, {}, {}}).value();
  EXPECT_EQ(convolution_sizes(plate, shapes::rectangle(0, 0, 3, 1)).reduced, 8u);
  EXPECT_EQ(convolution_sizes(plate, shapes::rectangle(0, 0, 3, 1)).full, 8u);
  // It fits exactly, or is smaller: the hole's four edges and the four edges that turn at its reflex corners.
  EXPECT_EQ(convolution_sizes(plate, shapes::rectangle(0, 0, 2, 2)).reduced, 12u);
  EXPECT_EQ(convolution_sizes(plate, shapes::rectangle(0, 0, 1, 1)).kinetic, 16u);
}

// The thesis keeps collinear vertices and closes turns at both ends (star + star: 382 of 1608, dog + bird: 2921 of
// 38342, neuron
// + disc: 3196). Here collinear vertices are dropped and turns are half-open. With the neuron's 29 collinear vertices
// kept there is one more segment for each (3195 and 5119), and 33 more in the full convolution (34135).
TEST(ConvolutionSizes, of_the_shapes_of_the_thesis) {
  const std::filesystem::path folder = std::filesystem::path(DYMSUM_SOURCE_DIR) / "../shared/data/planar";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no thesis data";
  const auto load = [&](const char* name) {
    return Region::create(read_region_data((folder / name).string()).value()).value();
  };
  const Region neuron = load("neuron.poly"), bird = load("bird.poly"), star = load("star.poly");
  EXPECT_EQ(convolution_sizes(neuron, snapped_shapes::disc(32, 0.01)), (ConvolutionSizes{33178, 5090, 3166}));
  EXPECT_EQ(convolution_sizes(load("monkey.poly"), bird), (ConvolutionSizes{319708, 31334, 16406}));
  EXPECT_EQ(convolution_sizes(load("dog.poly"), bird), (ConvolutionSizes{36722, 5043, 2726}));
  EXPECT_EQ(convolution_sizes(star, star), (ConvolutionSizes{1428, 540, 312}));
}

}  // namespace
}  // namespace dymsum::planar
