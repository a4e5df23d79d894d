// Edges that prove a position covered: the search against all pairs of edges, and each answer by exact signs.
#include "planar/motion/operand_pair.h"
#include "planar/window/scaling_pairs.h"

#include <gtest/gtest.h>

#include "oracles/random.h"
#include "oracles/tiny_regions.h"
#include "planar/frame/scaling_sum.h"

namespace dymsum {
namespace {

// Places, scales and vertices are small dyadic numbers here, so that doubles compute every side exactly.
int side(Point a, Point d, Point z) {
  const double value = d.x * (z.y - a.y) - d.y * (z.x - a.x);
  return (value > 0) - (value < 0);
}

// Whether edge e of P and edge f of Q, reflected, standing at z and as large as in the window's frame, cross properly.
bool cross_exactly(const planar::Window& window, std::uint32_t e, std::uint32_t f, Point z, double tau) {
  const planar::Operand &p = window.base().operands[0], &q = window.base().operands[1];
  const auto at = [&](const planar::Operand& o, std::uint32_t v) {
    const double factor = o.op == window.frame().moving ? tau : 1;
    return Point{factor * o.x[v], factor * o.y[v]};
  };
  const Point a = at(p, e), b = at(p, p.next[e]), r = at(q, f), s = at(q, q.next[f]);
  const Point c{z.x - r.x, z.y - r.y}, d{z.x - s.x, z.y - s.y}, ab{b.x - a.x, b.y - a.y}, cd{d.x - c.x, d.y - c.y};
  return side(a, ab, c) * side(a, ab, d) < 0 && side(c, cd, a) * side(c, cd, b) < 0;
}

/// A search in the window of scales from 1 to 2 of a random pair.
struct Searched {
  oracles::Random random;
  const planar::Window& window;
  planar::EdgeSearch search;
  bool scaled_moves;
};

/// Calls visit(round, Searched&) for many random pairs.
template <class Visit>
void for_each_window(const Visit& visit) {
  for (int round = 0; round < 400; ++round) {
    oracles::Random random(static_cast<std::uint64_t>(round) + 1);
    const oracles::Pair pair = oracles::random_pair(random, 4 + random.below(6));
    const Region p = Region::create(pair.p).value(), q = Region::create(pair.q).value();
    auto base = planar::pair_of_regions(p, q, planar::PairOptions{.moved = static_cast<std::uint32_t>(random.below(2))})
                    .value();
    if (!base->regular || base->operands[0].size() == 0 || base->operands[1].size() == 0) continue;
    planar::ScalingState state(base, {});
    const auto window = state.windows.between(exact::BigRational(1), exact::BigRational(2));
    Searched s{random, *window, planar::EdgeSearch(*window), window->frame().moving == base->moved};
    visit(round, s);
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(EdgeSearch, finds_edges_wherever_some_cross_and_only_those) {
  int found = 0, missed = 0, none = 0;
  for_each_window([&](int round, Searched& s) {
    auto& [random, window, search, scaled_moves] = s;
    const planar::OperandPair& base = window.base();
    for (int k = 0; k < 20; ++k) {
      const double tau = scaled_moves ? 1 + random.below(16) / 16.0 : 1 - random.below(8) / 16.0, span = window.span();
      const Point z{random.below(static_cast<int>(16 * span)) / 16.0, random.below(static_cast<int>(16 * span)) / 16.0};
      const planar::EdgeSearch::Position position{z.x, z.y, 0, tau};
      const auto edges = search.find(position);
      bool any = false;
      for (std::uint32_t e = 0; e < base.operands[0].size(); ++e)
        for (std::uint32_t f = 0; f < base.operands[1].size(); ++f) any |= cross_exactly(window, e, f, z, tau);
      if (edges) {
        ASSERT_TRUE(cross_exactly(window, (*edges)[0], (*edges)[1], z, tau)) << "round " << round << ", place " << k;
      }
      if (edges) ++found;
      else ++(any ? missed : none);
    }
  });
  // The search may give up, but not on operands as small as these.
  EXPECT_EQ(missed, 0);
  EXPECT_GT(found, 1000);
  EXPECT_GT(none, 1000);
}

// Edges that are named for two positions cross at both and everywhere on the straight way, while the moving operand
// grows from one scale to the other.
TEST(EdgeSearch, edges_for_two_places_cross_all_the_way) {
  int found = 0, queried = 0;
  for_each_window([&](int round, Searched& s) {
    auto& [random, window, search, scaled_moves] = s;
    for (int k = 0; k < 20; ++k) {
      const int span = static_cast<int>(16 * window.span());
      const double tau0 = scaled_moves ? 1 : 0.5, tau1 = 2 * tau0;
      const Point from{random.below(span) / 16.0, random.below(span) / 16.0};
      const Point to{from.x + (random.below(65) - 32) / 16.0, from.y + (random.below(65) - 32) / 16.0};
      const auto edges = search.find_or_spare({from.x, from.y, 0, tau0}, {to.x, to.y, 0, tau1});
      ++queried;
      if (!edges) continue;
      ++found;
      for (int i = 0; i <= 8; ++i) {
        const double u = i / 8.0;
        const Point z{from.x + u * (to.x - from.x), from.y + u * (to.y - from.y)};
        ASSERT_TRUE(cross_exactly(window, (*edges)[0], (*edges)[1], z, tau0 + u * (tau1 - tau0)))
            << "round " << round << ", way " << k;
      }
    }
  });
  EXPECT_GT(found, 200);
  EXPECT_GT(queried, 3 * found);
}

}  // namespace
}  // namespace dymsum
