#include "dymsum/decomposition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace dymsum {
namespace {

Region comb(int teeth) {
  Ring ring{{0, 0}, {double(8 * teeth + 4), 0}};
  for (int i = teeth; i >= 0; --i) {
    const double x = 8 * i;
    ring.push_back({x + 4, 20});
    ring.push_back({x, 20});
    if (i > 0) ring.push_back({x, 5}), ring.push_back({x - 4, 5});
  }
  return Region::create({{{ring, {}}}, {}, {}}).value();
}

Region plate_with_holes() {
  std::vector<Ring> holes;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 2; ++j) {
      const double x = 10 * i + 3, y = 10 * j + 3, s = 2 + i;
      holes.push_back({{x, y}, {x, y + s}, {x + s, y + s}, {x + s, y}});
    }
  return Region::create({{{{{0, 0}, {30, 0}, {30, 20}, {0, 20}}, holes}}, {}, {}}).value();
}

/// A star-shaped ring with random radii.
Region random_star(unsigned seed, int n) {
  std::mt19937 random(seed);
  Ring ring;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * M_PI * i / n, r = 300 + double(random() % 700);
    ring.push_back({std::round(r * std::cos(angle)), std::round(r * std::sin(angle))});
  }
  return Region::create({{{ring, {}}}, {}, {}}).value();
}

Rational twice_area(const Region& region) {
  Rational sum;
  const auto add = [&](const Ring& ring) {
    RationalRing exact;
    for (const Point& p : ring) exact.push_back({Rational::of(p.x).value(), Rational::of(p.y).value()});
    sum += dymsum::twice_area(exact);
  };
  for (const Part& part : region.parts()) {
    add(part.outer);
    for (const Ring& hole : part.holes) add(hole);
  }
  return sum;
}

Decomposition cut(const Region& region, const Rational& tau) {
  return decompose(ShapeFeatures::create(region).value(), {tau, 0, std::nullopt}).value();
}

Rational turn(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool properly_cross(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c, const RationalPoint& d) {
  return turn(a, b, c).sign() * turn(a, b, d).sign() < 0 && turn(c, d, a).sign() * turn(c, d, b).sign() < 0;
}

std::vector<Region> shapes() { return {comb(4), plate_with_holes(), random_star(1, 24), random_star(7, 40)}; }

TEST(Decompose, PiecesTileTheRegion) {
  for (const Region& region : shapes())
    for (const int tau : {0, 3, 5, 400}) {
      const Decomposition made = cut(region, tau);
      Rational sum;
      for (const Piece& piece : made.pieces) {
        EXPECT_GT(dymsum::twice_area(piece.outer), Rational(0));
        sum += dymsum::twice_area(piece.outer);
        for (const RationalRing& hole : piece.holes) {
          EXPECT_LT(dymsum::twice_area(hole), Rational(0));
          sum += dymsum::twice_area(hole);
        }
      }
      EXPECT_EQ(sum, twice_area(region)) << "tau " << tau;
    }
}

TEST(Decompose, AllNotchesResolvedLeaveConvexPieces) {
  for (const Region& region : shapes()) {
    const Decomposition made = cut(region, 0);
    for (const Piece& piece : made.pieces) {
      EXPECT_TRUE(piece.holes.empty());
      const RationalRing& r = piece.outer;
      for (std::size_t i = 0; i < r.size(); ++i)
        EXPECT_GE(turn(r[i], r[(i + 1) % r.size()], r[(i + 2) % r.size()]).sign(), 0);
    }
  }
}

TEST(Decompose, CutsDoNotCrossAndEndWhereTheySay) {
  for (const Region& region : shapes()) {
    const Decomposition made = cut(region, 0);
    std::vector<Point> vertices;
    std::vector<std::uint32_t> next;
    for (const Part& part : region.parts()) {
      std::vector<Ring> rings{part.outer};
      rings.insert(rings.end(), part.holes.begin(), part.holes.end());
      for (const Ring& ring : rings) {
        const auto first = std::uint32_t(vertices.size());
        for (std::uint32_t i = 0; i < ring.size(); ++i) next.push_back(first + (i + 1) % std::uint32_t(ring.size()));
        vertices.insert(vertices.end(), ring.begin(), ring.end());
      }
    }
    const auto at = [&](std::uint32_t v) {
      return RationalPoint{Rational::of(vertices[v].x).value(), Rational::of(vertices[v].y).value()};
    };
    for (std::size_t i = 0; i < made.cuts.size(); ++i) {
      const Cut& c = made.cuts[i];
      EXPECT_EQ(c.from, at(c.vertex));
      if (c.end == Cut::End::vertex) {
        EXPECT_EQ(c.to, at(c.index));
      } else if (c.end == Cut::End::edge) {
        EXPECT_EQ(turn(at(c.index), at(next[c.index]), c.to).sign(), 0);
      } else {
        ASSERT_LT(c.index, i);
        EXPECT_EQ(turn(made.cuts[c.index].from, made.cuts[c.index].to, c.to).sign(), 0);
      }
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_FALSE(properly_cross(c.from, c.to, made.cuts[j].from, made.cuts[j].to));
    }
  }
}

TEST(Decompose, LevelsAreNested) {
  for (const Region& region : shapes()) {
    const std::vector<Cut> all = cut(region, 0).cuts;
    std::size_t before = all.size();
    for (const int tau : {1, 2, 3, 4, 5, 50, 200, 1000}) {
      const std::vector<Cut> some = cut(region, tau).cuts;
      ASSERT_LE(some.size(), before);
      EXPECT_TRUE(std::equal(some.begin(), some.end(), all.begin())) << "tau " << tau;
      before = some.size();
    }
  }
}

TEST(Decompose, WhatCannotBeCutIsTold) {
  const ShapeFeatures line = ShapeFeatures::create(Region::create({{}, {{{0, 0}, {1, 0}, {1, 1}}}, {}}).value()).value();
  EXPECT_EQ(decompose(line).error().code, ErrorCode::unsupported_operand);
  const ShapeFeatures features = ShapeFeatures::create(comb(2)).value();
  EXPECT_EQ(decompose(features, {-1, 0, std::nullopt}).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(decompose(features, {0, 2, Rational(1)}).error().code, ErrorCode::out_of_range);
}

}  // namespace
}  // namespace dymsum
