// Signs of a space of sums in doubles of double length: those that they find are the integers' own.
#include <gtest/gtest.h>

#include "oracles/coordinate_kinds.h"
#include "spatial/convolution/reduced_facets.h"
#include "spatial/convolution/sum_space.h"
#include "spatial/sum/random_solids.h"

namespace dymsum {
namespace {

using spatial::PlaneSource;
using spatial::PointSource;
using spatial::SumEdge;
using spatial::SumPoint;
using spatial::SumSpace;
using spatial::Way;

/// Planes of faces and edges plus vertices, edges of sums, and points of every kind, all at random.
struct Features {
  std::vector<PlaneSource> planes;
  std::vector<SumEdge> edges;
  std::vector<PointSource> points;
};

Features random_features(std::mt19937_64& random, const std::vector<Point3>& p, const std::vector<Point3>& q) {
  const auto below = [&](std::size_t n) { return static_cast<std::uint32_t>(random() % n); };
  const auto two = [&](std::size_t n) {
    const std::uint32_t a = below(n), b = (a + 1 + below(n - 1)) % static_cast<std::uint32_t>(n);
    return std::array{a, b};
  };
  Features f;
  for (int k = 0; k < 12; ++k) {
    const auto [a, b] = two(p.size());
    const auto [c, d] = two(q.size());
    f.planes.push_back({{a, c}, {Way::Of::p, a, b}, {Way::Of::q, c, d}, below(2) == 1});
    if (k % 2 == 0) f.edges.push_back({{a, c}, {b, c}});
    else f.edges.push_back({{a, c}, {a, d}});
  }
  for (std::uint32_t k = 0; k < 12; ++k) {
    f.points.push_back({PointSource::Kind::sum, below(p.size()), below(q.size()), 0});
    f.points.push_back({PointSource::Kind::edge, k, below(12), 0});
    f.points.push_back({PointSource::Kind::planes, k % 10, 10, 11});
  }
  return f;
}

/// Moved along an axis far away and with a digit far below: integers of 250 bits, whose signs are found by other rungs.
std::vector<Point3> with_a_fine_digit(std::vector<Point3> points) {
  points.push_back({std::ldexp(1, -200), std::ldexp(1, -200), std::ldexp(1, -200)});
  return points;
}

template <class Ask>
void compare(const SumSpace& plain, const SumSpace& wide, int& compared, Ask ask) {
  EXPECT_EQ(ask(plain), ask(wide));
  ++compared;
}

// The same coordinates in a space of 61 bits, which has no rung between, and in one of 250, which has.
TEST(FineSpace, finds_the_signs_of_the_integers) {
  std::mt19937_64 random(90210);
  int compared = 0;
  std::uint64_t fine = 0, exact = 0;
  for (const CoordinateKind kind :
       {CoordinateKind::grid, CoordinateKind::single_precision, CoordinateKind::turned_far}) {
    for (int pair = 0; pair < 60; ++pair) {
      const std::vector<Point3> p = of_kind(random_solids::tiny_polyhedron(random), kind, random).vertices,
                                q = of_kind(random_solids::tiny_polyhedron(random), kind, random).vertices;
      const auto plain = spatial::make_sum_space(p, q), wide = spatial::make_sum_space(with_a_fine_digit(p), q);
      Features f = random_features(random, p, q);
      // Planes of parallel directions are none.
      std::erase_if(f.planes, [&](const PlaneSource& s) { return plain->exact_dot(s.u, s.v, s.u, s.v) == 0; });
      if (f.planes.size() < 12) continue;
      for (SumSpace* space : {plain.get(), wide.get()}) space->add_planes(f.planes), space->add_edges(f.edges);
      for (std::uint32_t k = 0; k < 12; ++k) {
        compare(*plain, *wide, compared, [&](const SumSpace& s) { return s.exact_det(k, (k + 1) % 12, (k + 5) % 12); });
        compare(*plain, *wide, compared,
                [&](const SumSpace& s) { return s.exact_twist(f.edges[k], f.edges[(k + 7) % 12]); });
        for (const PointSource& at : f.points) {
          const bool sound = at.kind == PointSource::Kind::sum ||
                             (at.kind == PointSource::Kind::edge ? plain->exact_rise(at.b, f.edges[at.a]) != 0
                                                                 : plain->exact_det(at.a, at.b, at.c) != 0);
          if (!sound) continue;
          compare(*plain, *wide, compared, [&](const SumSpace& s) { return s.exact_side(k, at); });
          compare(*plain, *wide, compared,
                  [&](const SumSpace& s) { return s.exact_order(at, f.points[0], static_cast<int>(k % 3)); });
        }
      }
      fine += wide->fine_signs(), exact += wide->exact_signs();
      EXPECT_EQ(plain->fine_signs(), 0u);
    }
  }
  EXPECT_GT(compared, 50000);
  EXPECT_GT(fine, 4 * exact) << "most signs are found before integers are asked";
  EXPECT_GT(exact, 0u) << "zeros";
}

}  // namespace
}  // namespace dymsum
