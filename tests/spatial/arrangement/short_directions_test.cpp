// Spaces in which all coordinates of an operand are multiples of one long factor, as at a scale of many digits: signs
// are those of exact rationals.
#include <gtest/gtest.h>

#include "spatial/convolution/sum_space.h"
#include "spatial/sum/random_solids.h"

namespace dymsum {
namespace {

using exact::BigInteger;
using exact::BigRational;
using spatial::DirectionSource;
using spatial::PlaneSource;
using spatial::PointSource;
using spatial::SumEdge;
using Spot = std::array<BigRational, 3>;

Spot minus_of(const Spot& a, const Spot& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Spot cross_of(const Spot& u, const Spot& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
BigRational dot_of(const Spot& u, const Spot& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; }

TEST(ShortDirections, keep_all_signs_under_long_factors) {
  std::mt19937_64 random(77);
  const BigInteger factor[2] = {pow(BigInteger(3), 400), pow(BigInteger(5), 290)};
  int compared = 0, zeros = 0;
  for (int round = 0; round < 12; ++round) {
    const std::vector<Point3> of[2] = {random_solids::tiny_polyhedron(random).vertices,
                                       random_solids::tiny_polyhedron(random).vertices};
    const auto scaled = [&](int k, const spatial::GridPositions& positions) {
      const BigInteger& f = factor[k];
      return spatial::MappedPositions{positions, {f, 0, 0, 0, f, 0, 0, 0, f}};
    };
    const spatial::GridPositions p = spatial::grid_positions(of[0]), q = spatial::grid_positions(of[1]);
    if (p.exponent != 0 || q.exponent != 0) continue;
    const auto space = spatial::make_sum_space(scaled(0, p), scaled(1, q), 0);
    ASSERT_GT(space->bits(), 600);
    const auto spot = [&](int k, std::uint32_t v) {
      const Point3& at = of[k][v];
      return Spot{BigRational(factor[k]) * static_cast<long>(at.x), BigRational(factor[k]) * static_cast<long>(at.y),
                  BigRational(factor[k]) * static_cast<long>(at.z)};
    };
    const auto sum = [&](std::uint32_t a, std::uint32_t b) {
      const Spot u = spot(0, a), v = spot(1, b);
      return Spot{u[0] + v[0], u[1] + v[1], u[2] + v[2]};
    };
    const auto below = [&](std::size_t n) { return static_cast<std::uint32_t>(random() % n); };
    std::vector<PlaneSource> planes;
    std::vector<Spot> normals;
    while (planes.size() < 9) {
      const std::uint32_t a = below(of[0].size()), b = below(of[0].size()), c = below(of[1].size()),
                          d = below(of[1].size()), e = below(of[0].size());
      const PlaneSource plane{{a, c},
                              {DirectionSource::Of::p, a, b},
                              random() % 2 == 0 ? DirectionSource{DirectionSource::Of::q, c, d}
                                                : DirectionSource{DirectionSource::Of::p, a, e},
                              false};
      const Spot v =
          plane.v.of == DirectionSource::Of::q ? minus_of(spot(1, d), spot(1, c)) : minus_of(spot(0, e), spot(0, a));
      const Spot n = cross_of(minus_of(spot(0, b), spot(0, a)), v);
      if (n == Spot{0, 0, 0}) continue;
      planes.push_back(plane), normals.push_back(n);
    }
    space->add_planes(planes);
    const std::vector<SumEdge> edges{{{0, 0}, {1, 0}}, {{1, 1}, {1, 2}}};
    space->add_edges(edges);
    const auto compare = [&](int sign, const BigRational& value) {
      EXPECT_EQ(sign, value.sign());
      ++compared, zeros += value.sign() == 0;
    };
    for (std::uint32_t i = 0; i < 9; ++i) {
      const std::uint32_t j = (i + 1) % 9, k = (i + 2) % 9;
      const BigRational det = dot_of(normals[i], cross_of(normals[j], normals[k]));
      compare(space->exact_det(i, j, k), det);
      compare(space->exact_dot(i, j), dot_of(normals[i], normals[j]));
      std::vector<PointSource> points{{PointSource::Kind::sum, below(of[0].size()), below(of[1].size()), 0}};
      std::array<std::uint32_t, 3> three{i, j, k};
      std::sort(three.begin(), three.end());
      if (det.sign() != 0) points.push_back({PointSource::Kind::planes, three[0], three[1], three[2]});
      for (std::uint32_t e = 0; e < 2; ++e)
        if (space->exact_rise(i, edges[e]) != 0) points.push_back({PointSource::Kind::edge, e, i, 0});
      for (const PointSource& point : points) {
        const std::array<BigInteger, 4> h = space->homogeneous(point);
        const Spot at{BigRational(h[0], h[3]), BigRational(h[1], h[3]), BigRational(h[2], h[3])};
        if (point.kind == PointSource::Kind::sum) {
          EXPECT_EQ(at, sum(point.a, point.b));
        }
        for (std::uint32_t l = 0; l < 9; ++l) {
          const BigRational height = dot_of(normals[l], minus_of(at, sum(planes[l].at.p, planes[l].at.q)));
          const bool holds = point.kind == PointSource::Kind::planes
                                 ? l == point.a || l == point.b || l == point.c
                                 : point.kind == PointSource::Kind::edge && l == point.b;
          if (holds) {
            EXPECT_EQ(height, 0);
          }
          compare(space->exact_side(l, point), height);
        }
      }
    }
  }
  EXPECT_GT(compared, 1500);
  EXPECT_GT(zeros, 100);
}

}  // namespace
}  // namespace dymsum
