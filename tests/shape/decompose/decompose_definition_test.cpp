// Decompositions of random regions with holes against their definition, in rational numbers and by looking at
// everything.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <utility>

#include "cut_definition.h"
#include "dymsum/decomposition.h"

namespace dymsum {
namespace {

using namespace cut_definition;

/// Axis-parallel, slanted and L-shaped holes on a grid of cells.
Region plate(unsigned seed) {
  std::mt19937 random(seed);
  const auto below = [&](unsigned n) { return double(random() % n); };
  const int nx = 1 + int(random() % 3), ny = 1 + int(random() % 3);
  std::vector<Ring> holes;
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j) {
      if (random() % 4 == 0) continue;
      const double s = 2 * (1 + below(5)), x = 16 * i + 2 + below(unsigned(13 - s)),
                   y = 16 * j + 2 + below(unsigned(13 - s));
      const Ring kinds[] = {{{x, y}, {x, y + s}, {x + s, y + s}, {x + s, y}},
                            {{x, y}, {x, y + s}, {x + s / 2, y}},
                            {{x, y}, {x, y + s}, {x + 1, y + s}, {x + 1, y + s / 2}, {x + s, y + s / 2}, {x + s, y}},
                            {{x + 1, y}, {x, y + s / 2}, {x + s / 2, y + s}, {x + s, y + 1}}};
      holes.push_back(kinds[random() % 4]);
    }
  const double w = 16 * nx, h = 16 * ny;
  return Region::create({{{{{0, 0}, {w, 0}, {w, h}, {0, h}}, holes}}, {}, {}}).value();
}

/// Polygons of any doubles in a square with a notched side.
Region loose_plate(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> fraction(0, 1);
  std::vector<Ring> holes;
  const int n = 1 + int(random() % 3);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 2; ++j) {
      Ring hole;
      const int corners = 3 + int(random() % 5);
      const double turn = fraction(random);
      for (int k = 0; k < corners; ++k) {
        const double angle = -2 * M_PI * (k + turn) / corners, r = 0.1 + 0.35 * fraction(random);
        hole.push_back({i + 0.5 + r * std::cos(angle), j + 0.5 + r * std::sin(angle)});
      }
      holes.push_back(hole);
    }
  Ring outer{{0, -0.25}};
  for (int i = 0; i < n; ++i) outer.push_back({i + 0.5, -0.2 * fraction(random)}), outer.push_back({i + 1.0, -0.25});
  outer.insert(outer.end(), {{double(n), 2}, {0, 2}});
  return Region::create({{{outer, holes}}, {}, {}}).value();
}

/// A notched square; in its way a hole with an island, which may have a hole with an island.
Region nested(unsigned seed) {
  std::mt19937 random(seed);
  const auto below = [&](unsigned n) { return double(random() % n); };
  const double a = 60 + below(40), s = 24 + 4 * below(4), x = a - 4 - below(16), y = 10 + below(30);
  const double w = s - 6, u = x + 3, v = y + 3, m = w / 2;
  const Part outer{{{0, 0}, {160, 0}, {160, 160}, {a + 9, 160}, {a, 80}, {a - 9, 160}, {0, 160}},
                   {{{x, y}, {x, y + s}, {x + s, y + s}, {x + s, y + 4}, {x + s - 4, y}}}};
  const double turn = below(7) - 3;
  const Part notched{{{u, v}, {u + w, v}, {u + m + turn, v + m}, {u + w, v + w}, {u, v + w}}, {}};
  const Part angled{{{u, v}, {u + w, v}, {u + w, v + m + turn}, {u + m, v + m}, {u + m, v + w}, {u, v + w}}, {}};
  const Part framed{
      {{u, v}, {u + w, v}, {u + w, v + w}, {u + m + 1, v + w}, {u + m, v + w - 3}, {u + m - 1, v + w}, {u, v + w}},
      {{{u + 4, v + 4}, {u + 4, v + w - 5}, {u + w - 4, v + w - 5}, {u + w - 4, v + 4}}}};
  const Part inner{{{u + 5, v + 5}, {u + m + turn, v + 7}, {u + w - 5, v + 5}, {u + m, v + w - 7}}, {}};
  std::vector<Part> parts{outer};
  const unsigned kind = random() % 4;
  parts.push_back(kind == 0 ? notched : kind == 1 ? angled : framed);
  if (kind == 3) parts.push_back(inner);
  return Region::create({parts, {}, {}}).value();
}

/// Rings that pass no point twice and do not cross, holes inside the outer ring; no matter where they touch.
void expect_valid(const Piece& piece) {
  std::vector<std::pair<RationalPoint, RationalPoint>> edges;
  const auto add = [&](const RationalRing& ring) {
    std::set<RationalPoint, PointLess> seen(ring.begin(), ring.end());
    EXPECT_EQ(seen.size(), ring.size());
    EXPECT_GE(ring.size(), 3u);
    for (std::size_t i = 0; i < ring.size(); ++i) edges.emplace_back(ring[i], ring[(i + 1) % ring.size()]);
  };
  add(piece.outer);
  EXPECT_GT(twice_area(piece.outer).sign(), 0);
  for (const RationalRing& hole : piece.holes) {
    add(hole);
    EXPECT_LT(twice_area(hole).sign(), 0);
    for (const RationalPoint& p : hole) {
      bool odd = false, on = false;
      for (std::size_t i = 0; i < piece.outer.size(); ++i) {
        const RationalPoint &a = piece.outer[i], &b = piece.outer[(i + 1) % piece.outer.size()];
        on = on || lies_on(a, b, p);
        if ((a.y > p.y) != (b.y > p.y)) odd = odd != ((cross_of(a, b, p).sign() > 0) == (b.y > a.y));
      }
      EXPECT_TRUE(on || odd);
    }
  }
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const auto& [a, b] = edges[i];
      const auto& [c, d] = edges[j];
      EXPECT_FALSE(cross_properly(a, b, c, d));
      for (const RationalPoint& p : {a, b})
        EXPECT_TRUE(p == c || p == d || !lies_on(c, d, p));  // no T without a vertex
    }
}

Rational area_of(const Region& region) {
  Rational sum;
  for (const Part& part : region.parts()) {
    std::vector<Ring> rings{part.outer};
    rings.insert(rings.end(), part.holes.begin(), part.holes.end());
    for (const Ring& ring : rings) {
      RationalRing exact;
      for (const Point& p : ring) exact.push_back(exactly(p));
      sum += twice_area(exact);
    }
  }
  return sum;
}

using Edge = std::pair<RationalPoint, RationalPoint>;
struct EdgeLess {
  bool operator()(const Edge& a, const Edge& b) const {
    return a.first != b.first ? PointLess()(a.first, b.first) : PointLess()(a.second, b.second);
  }
};

/// Two pieces lie along all of each run, one on either side.
void expect_runs_separate(const Cut& cut, const std::map<Edge, std::size_t, EdgeLess>& piece_at) {
  ASSERT_FALSE(cut.runs.empty());
  EXPECT_EQ(cut.runs.front()[0], cut.from);
  EXPECT_EQ(cut.runs.back()[1], cut.to);
  for (const RationalSegment& run : cut.runs) {
    EXPECT_TRUE(run[0] != run[1] && lies_on(cut.from, cut.to, run[0]) && lies_on(cut.from, cut.to, run[1]));
    Rational along, against;
    for (const auto& [edge, piece] : piece_at) {
      if (!lies_on(run[0], run[1], edge.first) || !lies_on(run[0], run[1], edge.second)) continue;
      const auto other = piece_at.find({edge.second, edge.first});
      ASSERT_NE(other, piece_at.end());
      EXPECT_NE(other->second, piece) << "a slit";
      const Rational length = dot_of(run[0], run[1], edge.second) - dot_of(run[0], run[1], edge.first);
      (length.sign() > 0 ? along : against) += length;
    }
    EXPECT_EQ(along, dot_of(run[0], run[1], run[1]));
    EXPECT_EQ(against, -along);
  }
}

/// No two pieces have the same directed edge; every part of a cut has two pieces, others one.
void expect_tiled(const Region& region, const Decomposition& made) {
  Rational sum;
  std::map<Edge, std::size_t, EdgeLess> piece_at;
  for (std::size_t i = 0; i < made.pieces.size(); ++i) {
    std::vector<RationalRing> rings{made.pieces[i].outer};
    rings.insert(rings.end(), made.pieces[i].holes.begin(), made.pieces[i].holes.end());
    for (const RationalRing& ring : rings) {
      sum += twice_area(ring);
      for (std::size_t k = 0; k < ring.size(); ++k)
        EXPECT_TRUE(piece_at.insert({{ring[k], ring[(k + 1) % ring.size()]}, i}).second);
    }
  }
  EXPECT_EQ(sum, area_of(region));
  for (const Cut& cut : made.cuts) expect_runs_separate(cut, piece_at);
  std::vector<RationalSegment> runs;
  for (const Cut& cut : made.cuts) runs.insert(runs.end(), cut.runs.begin(), cut.runs.end());
  for (std::size_t i = 0; i < runs.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(cross_properly(runs[i][0], runs[i][1], runs[j][0], runs[j][1]));
}

/// What there was to look at.
struct Seen {
  int partners = 0, single = 0, passing = 0;
};

void expect_decomposed(const Region& region, const std::vector<Rational>& taus, Seen& seen) {
  const ShapeFeatures features = ShapeFeatures::create(region).value();
  std::optional<Decomposition> finer;
  for (const Rational& tau : taus) {
    const Decomposition made = decompose(features, {tau, 0, std::nullopt, {}}).value();
    Definition definition(region);
    definition.follow(features.bars(), features.significant(tau), made.cuts);
    seen.single += definition.single_partners();
    for (const Piece& piece : made.pieces) expect_valid(piece);
    expect_tiled(region, made);
    for (const Cut& cut : made.cuts) {
      seen.partners += cut.partner ? 1 : 0;
      seen.passing += cut.runs.size() > 1 ? 1 : 0;
    }
    if (finer) {
      ASSERT_LE(made.cuts.size(), finer->cuts.size());
      EXPECT_TRUE(std::equal(made.cuts.begin(), made.cuts.end(), finer->cuts.begin())) << "levels are not nested";
    }
    finer = made;
  }
}

TEST(Decompose, PlatesAreCutAsDefined) {
  Seen seen;
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_decomposed(plate(seed), {0, 2, 3, 4, 5, 6, 8}, seen);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(seen.partners, 60);
  EXPECT_GT(seen.single, 60);
  EXPECT_GT(seen.passing, 10);
}

TEST(Decompose, PlatesOfAnyDoublesAreCutAsDefined) {
  Seen seen;
  for (unsigned seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_decomposed(loose_plate(seed), {0, Rational::parse("1/10").value(), Rational::parse("1/4").value()}, seen);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(seen.partners, 3);
  EXPECT_GT(seen.single, 3);
}

TEST(Decompose, IslandsAreCutByThemselves) {
  Seen seen;
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_decomposed(nested(seed), {0, 2, 5, 12, 20}, seen);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(seen.passing, 40);
}

RationalSegment segment(int ax, int ay, int bx, int by) {
  return {RationalPoint{Rational(ax), Rational(ay)}, RationalPoint{Rational(bx), Rational(by)}};
}

TEST(Decompose, ACutIsNothingInAHoleThatItPasses) {
  const Region notched = Region::create({{{{{0, 0}, {40, 0}, {40, 40}, {22, 40}, {20, 20}, {18, 40}, {0, 40}},
                                           {{{18, 8}, {18, 14}, {24, 14}, {24, 8}}}},
                                          {{{19, 9}, {23, 9}, {21, 11}, {23, 13}, {19, 13}}, {}}},
                                         {},
                                         {}})
                             .value();
  const Decomposition all = decompose(ShapeFeatures::create(notched).value()).value();
  ASSERT_EQ(all.cuts.size(), 6u);
  EXPECT_EQ(all.cuts[0].runs, (std::vector{segment(20, 20, 20, 14), segment(20, 8, 20, 0)}));
  EXPECT_EQ(all.cuts[1].runs, (std::vector{segment(21, 11, 19, 11)}));
  EXPECT_EQ(all.pieces.size(), 8u);
  const Region whole =
      Region::create(
          {{{{{0, 0}, {60, 0}, {60, 40}, {32, 40}, {30, 20}, {28, 40}, {0, 40}}, {{{26, 4}, {30, 12}, {34, 4}}}},
            {{{29, 6}, {31, 6}, {30, 8}}, {}}},
           {},
           {}})
          .value();
  const Decomposition made = decompose(ShapeFeatures::create(whole).value(), {5, 0, std::nullopt, {}}).value();
  ASSERT_EQ(made.cuts.size(), 1u);
  EXPECT_EQ(made.cuts[0].runs, (std::vector{segment(30, 20, 30, 12), segment(30, 4, 30, 0)}));
  EXPECT_EQ(made.pieces.size(), 3u);
}

TEST(Decompose, ARoundHoleHasFewPartners) {
  Ring hole;
  for (int i = 0; i < 200; ++i) hole.push_back({10 * std::cos(-M_PI * i / 100), 10 * std::sin(-M_PI * i / 100)});
  const Region region = Region::create({{{{{-20, -20}, {20, -20}, {20, 20}, {-20, 20}}, {hole}}}, {}, {}}).value();
  const Decomposition made = decompose(ShapeFeatures::create(region).value()).value();
  const auto partners = std::count_if(made.cuts.begin(), made.cuts.end(), [](const Cut& c) { return c.partner; });
  EXPECT_EQ(made.cuts.size(), 200u);
  EXPECT_EQ(partners, 1);
}

TEST(Decompose, AHoleThatOneCutOpensGetsASecondAndNoSlit) {
  const Region region =
      Region::create(
          {{{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {{{2, 1}, {2, 4}, {3, 4}, {3, 5}, {5, 5}, {5, 1}}}}}, {}, {}})
          .value();
  const Decomposition made =
      decompose(ShapeFeatures::create(region).value(), {Rational(3) / Rational(2), 0, std::nullopt, {}}).value();
  ASSERT_EQ(made.cuts.size(), 2u);
  EXPECT_FALSE(made.cuts[0].partner);
  EXPECT_TRUE(made.cuts[1].partner);
  EXPECT_EQ(made.pieces.size(), 2u);
  EXPECT_TRUE(rounded(made));
}

}  // namespace
}  // namespace dymsum
