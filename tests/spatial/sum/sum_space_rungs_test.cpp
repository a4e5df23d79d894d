// The rungs of a space of sums: doubles, pairs of doubles, integers of each width and numbers of any size tell the same
// signs. DYMSUM_FUZZ_SIGNS sets the number of signs for each kind of coordinates.
#include <gtest/gtest.h>

#include "oracles/coordinate_kinds.h"
#include "oracles/verdict.h"
#include "spatial/convolution/reduced_facets.h"
#include "spatial/convolution/sum_space.h"
#include "spatial/sum/random_solids.h"

namespace dymsum {
namespace {

using spatial::DirectionSource;
using spatial::PlaneSource;
using spatial::PointSource;
using spatial::SumEdge;
using spatial::SumPoint;
using spatial::SumSpace;

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
    f.planes.push_back({{a, c}, {DirectionSource::Of::p, a, b}, {DirectionSource::Of::q, c, d}, below(2) == 1});
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

/// With a digit far below: the same signs from integers of 250 bits, or from numbers of any size.
std::vector<Point3> with_a_digit(std::vector<Point3> points, int exponent) {
  const double digit = std::ldexp(1, exponent);
  points.push_back({digit, digit, digit});
  return points;
}

/// Spaces of the same coordinates that have other rungs.
struct Spaces {
  std::unique_ptr<SumSpace> plain, wide, big;

  Spaces(const std::vector<Point3>& p, const std::vector<Point3>& q)
      : plain(spatial::make_sum_space(p, q)),
        wide(spatial::make_sum_space(with_a_digit(p, -200), q)),
        big(spatial::make_sum_space(with_a_digit(p, -900), q)) {}

  template <class Query>
  int decided(Query query) {
    const int sign = query(*big);
    EXPECT_EQ(query(*plain), sign);
    EXPECT_EQ(query(*wide), sign);
    zeros += sign == 0;
    ++signs;
    return sign;
  }
  std::uint64_t signs = 0, zeros = 0;
};

class SumSpaceRungs : public testing::TestWithParam<CoordinateKind> {};

TEST_P(SumSpaceRungs, tell_the_same_signs) {
  const CoordinateKind kind = GetParam();
  std::mt19937_64 random(90210);
  const std::uint64_t wanted = oracles::setting("DYMSUM_FUZZ_SIGNS", 20'000);
  std::uint64_t signs = 0, zeros = 0;
  exact::RungCounts plain, wide, big;
  for (int pair = 0; signs < wanted; ++pair) {
    ASSERT_LT(pair, 1'000'000);
    const std::vector<Point3> p = of_kind(random_solids::tiny_polyhedron(random), kind, random).vertices,
                              q = of_kind(random_solids::tiny_polyhedron(random), kind, random).vertices;
    Spaces spaces(p, q);
    Features f = random_features(random, p, q);
    // Planes of parallel directions are none.
    std::erase_if(f.planes, [&](const PlaneSource& s) { return spaces.big->exact_dot(s.u, s.v, s.u, s.v) == 0; });
    if (f.planes.size() < 12) continue;
    for (SumSpace* space : {spaces.plain.get(), spaces.wide.get(), spaces.big.get()})
      space->add_planes(f.planes), space->add_edges(f.edges);
    for (std::uint32_t k = 0; k < 12; ++k) {
      const std::uint32_t b = (k + 1) % 12, c = (k + 5) % 12;
      const int det = spaces.decided([&](const SumSpace& s) { return s.exact_det(k, b, c); });
      EXPECT_EQ(spaces.plain->det(k, b, c), det) << "by doubles first";
      spaces.decided([&](const SumSpace& s) { return s.exact_twist(f.edges[k], f.edges[(k + 7) % 12]); });
      for (const PointSource& at : f.points) {
        const bool sound = at.kind == PointSource::Kind::sum ||
                           (at.kind == PointSource::Kind::edge ? spaces.big->exact_rise(at.b, f.edges[at.a]) != 0
                                                               : spaces.big->exact_det(at.a, at.b, at.c) != 0);
        if (!sound) continue;
        const int side = spaces.decided([&](const SumSpace& s) { return s.exact_side(k, at); });
        EXPECT_EQ(spaces.plain->side(k, at, spaces.plain->approximate(at)), side) << "by doubles first";
        spaces.decided([&](const SumSpace& s) { return s.exact_order(at, f.points[0], static_cast<int>(k % 3)); });
      }
    }
    signs += spaces.signs, zeros += spaces.zeros;
    plain += spaces.plain->signs(), wide += spaces.wide->signs(), big += spaces.big->signs();
  }
  using exact::Rung;
  EXPECT_GT(zeros, signs / 1000);
  EXPECT_EQ(plain.at(Rung::big), 0u) << "doubles have integers";
  EXPECT_EQ(wide.at(Rung::big), 0u);
  EXPECT_EQ(big.at(Rung::integers), 0u);
  for (const exact::RungCounts& counts : {wide, big})
    EXPECT_GT(counts.at(Rung::double_pairs), 4 * counts.exact())
        << "most signs are told before exact numbers are asked";
  EXPECT_GT(wide.at(Rung::integers), 0u) << "zeros";
  EXPECT_GT(big.at(Rung::big), 0u) << "zeros";
}

INSTANTIATE_TEST_SUITE_P(Kinds, SumSpaceRungs, testing::ValuesIn(kCoordinateKinds),
                         [](const auto& kind) { return test_name_of(kind.param); });

}  // namespace
}  // namespace dymsum
