// Heights of edges that doubles do not distinguish: trapezoids lie between the edges that they say, in the exact order.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "cspace/planner/slice_graph.h"
#include "dymsum/planar_sum.h"
#include "oracles/random.h"

namespace dymsum::planar {
namespace {

/// Vectors (p, q) and (u, v), 0 < q < p and 0 < v < u < p, of which the second one is hardly less steep: p v - q u =
/// -1.
struct NeighbouringSlopes {
  double p = 0, q = 0, u = 0, v = 0;
  explicit NeighbouringSlopes(oracles::Random& random) {
    std::int64_t a = 0, b = 0;
    do {
      a = (1 << 20) + random.below(1 << 20);
      b = 1 + random.below(static_cast<int>(a) - 1);
    } while (std::gcd(a, b) != 1);
    // b u = 1 modulo a, by Euclid's algorithm.
    std::int64_t r = b, s = a, x = 1, y = 0;
    while (s != 0) {
      const std::int64_t k = r / s;
      std::tie(r, s) = std::pair{s, r - k * s};
      std::tie(x, y) = std::pair{y, x - k * y};
    }
    x = (x % a + a) % a;
    p = static_cast<double>(a), q = static_cast<double>(b);
    u = static_cast<double>(x), v = static_cast<double>((b * x - 1) / a);
  }
};

/// Rings whose sums with a unit square have an edge along (p, q) and, from its midpoint, one along (u, v) below. The
/// corners of a little triangle far below are lines beside that place: there the edge that begins is put among the
/// others.
Region nearly_parallel_edges(const NeighbouringSlopes& s, double x, double y) {
  RegionData data;
  data.parts.push_back({{{x, y - 1}, {x + 1, y - 0x1p21}, {x + s.u, y + s.v - 1}}, {}});
  data.parts.push_back({{{x - s.p - 1, y - s.q}, {x + s.p - 1, y + s.q}, {x, y + 0x1p22}}, {}});
  data.parts.push_back({{{x + 3, y - 0x1p22}, {x + 9, y - 0x1p22 + 2}, {x + 5, y - 0x1p22 + 6}}, {}});
  return Region::create(std::move(data)).value();
}

/// Whether an edge of the slice runs along a vector.
bool runs_along(const SliceMap& map, std::uint32_t edge, double dx, double dy) {
  if (edge >= SliceGraph::kBottom) return false;
  const Position &a = map.spots()[map.edges()[edge].from].exact(), &b = map.spots()[map.edges()[edge].to].exact();
  return (b.x - a.x) * exact::exact_value(dy) == (b.y - a.y) * exact::exact_value(dx);
}

TEST(SliceGraphBounds, edges_that_doubles_hardly_tell_apart_are_in_their_order) {
  oracles::Random random(91);
  int checked = 0;
  for (int k = 0; k < 60; ++k) {
    const NeighbouringSlopes slopes(random);
    if (slopes.u < 32) continue;
    const auto at = [&] { return static_cast<double>(random.below(64)); };
    RegionData square;
    square.parts.push_back({{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {}});
    SumOptions options;
    options.semantics = Semantics::open;
    PlanarSum sum =
        minkowski_sum(nearly_parallel_edges(slopes, at(), at()), Region::create(square).value(), options).value();
    ASSERT_EQ(sum.at_error, 0);
    const SliceMap map(std::move(sum));
    const SliceGraph graph(map, false, 0x1p26);
    int wedges = 0;
    for (std::uint32_t n = 0; n < graph.trapezoids().size(); ++n) {
      const SliceGraph::Trapezoid& t = graph.trapezoids()[n];
      const std::vector<std::uint32_t> at_centre = graph.nodes_at(SlicePoint(t.centre));
      ASSERT_EQ(at_centre, std::vector<std::uint32_t>{n}) << k;
      wedges += runs_along(map, t.low, slopes.u, slopes.v) && runs_along(map, t.high, slopes.p, slopes.q);
    }
    // What is free between the two: in the wrong order they bound it from the other sides.
    ASSERT_EQ(wedges, 1) << k;
    ++checked;
  }
  EXPECT_GT(checked, 50);
}

}  // namespace
}  // namespace dymsum::planar
