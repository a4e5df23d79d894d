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

#include "dymsum/decomposition.h"

namespace dymsum {
namespace {

struct PointLess {
  bool operator()(const RationalPoint& a, const RationalPoint& b) const { return a.x != b.x ? a.x < b.x : a.y < b.y; }
};

RationalPoint exactly(Point p) { return {Rational::of(p.x).value(), Rational::of(p.y).value()}; }

Rational cross_of(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}
Rational dot_of(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c) {
  return (b.x - a.x) * (c.x - a.x) + (b.y - a.y) * (c.y - a.y);
}
bool lies_on(const RationalPoint& a, const RationalPoint& b, const RationalPoint& p) {
  return cross_of(a, b, p).sign() == 0 && dot_of(a, b, p).sign() >= 0 && dot_of(b, a, p).sign() >= 0;
}
bool cross_properly(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c, const RationalPoint& d) {
  return cross_of(a, b, c).sign() * cross_of(a, b, d).sign() < 0 &&
         cross_of(c, d, a).sign() * cross_of(c, d, b).sign() < 0;
}

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
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<Ring> holes;
  const int n = 1 + int(random() % 3);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 2; ++j) {
      Ring hole;
      const int corners = 3 + int(random() % 5);
      const double turn = share(random);
      for (int k = 0; k < corners; ++k) {
        const double angle = -2 * M_PI * (k + turn) / corners, r = 0.1 + 0.35 * share(random);
        hole.push_back({i + 0.5 + r * std::cos(angle), j + 0.5 + r * std::sin(angle)});
      }
      holes.push_back(hole);
    }
  Ring outer{{0, -0.25}};
  for (int i = 0; i < n; ++i) outer.push_back({i + 0.5, -0.2 * share(random)}), outer.push_back({i + 1.0, -0.25});
  outer.insert(outer.end(), {{double(n), 2}, {0, 2}});
  return Region::create({{{outer, holes}}, {}, {}}).value();
}

/// A region's vertices, and the definition of a cut.
class Definition {
 public:
  explicit Definition(const Region& region) {
    for (const Part& part : region.parts()) {
      std::vector<Ring> rings{part.outer};
      rings.insert(rings.end(), part.holes.begin(), part.holes.end());
      for (std::size_t r = 0; r < rings.size(); ++r) add(rings[r], r > 0);
    }
  }

  /// Follows the cuts, bar by bar: each has to be the one that the definition asks for.
  void follow(const std::vector<FeatureBar>& bars, const std::vector<std::uint32_t>& order,
              const std::vector<Cut>& cuts) {
    std::set<std::uint32_t> done;
    std::size_t next = 0;
    const auto partners = [&] {
      for (; next < cuts.size() && cuts[next].partner; ++next) {
        EXPECT_TRUE(hole_[ring_[cuts[next].vertex]]);
        take(cuts[next]);
      }
    };
    for (std::size_t k = 0; k < order.size(); ++k) {
      const FeatureBar& bar = bars[order[k]];
      if (k == 0 || !same_worth(bar, bars[order[k - 1]])) partners();
      for (const std::uint32_t other : order)
        if (bars[other].minimum && same_worth(bars[other], bar)) stands_[ring_[*bars[other].minimum]] = true;
      if (!bar.minimum || !done.insert(*bar.minimum).second || resolved(*bar.minimum)) continue;
      ASSERT_LT(next, cuts.size());
      EXPECT_EQ(cuts[next].vertex, *bar.minimum);
      EXPECT_EQ(cuts[next].bar, order[k]);
      EXPECT_FALSE(cuts[next].partner);
      take(cuts[next++]);
    }
    partners();
    EXPECT_EQ(next, cuts.size());
    for (const std::uint32_t k : order) EXPECT_TRUE(!bars[k].minimum || resolved(*bars[k].minimum));
  }

 private:
  struct Segment {
    RationalPoint a, b;
  };

  static bool same_worth(const FeatureBar& a, const FeatureBar& b) {
    return a.birth == b.birth && a.death == b.death && a.concavity == b.concavity;
  }

  void add(const Ring& ring, bool hole) {
    const auto first = std::uint32_t(at_.size()), n = std::uint32_t(ring.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      at_.push_back(exactly(ring[i]));
      next_.push_back(first + (i + 1) % n);
      previous_.push_back(first + (i + n - 1) % n);
      ring_.push_back(std::uint32_t(hole_.size()));
    }
    hole_.push_back(hole);
    stands_.push_back(!hole);
  }

  bool admits(std::uint32_t v, const RationalPoint& p) const {
    return cross_of(at_[v], at_[next_[v]], p).sign() >= 0 && cross_of(at_[v], at_[previous_[v]], p).sign() <= 0;
  }
  bool resolved(std::uint32_t v) const {
    return std::any_of(made_.begin(), made_.end(), [&](const Segment& s) {
      return lies_on(s.a, s.b, at_[v]) && ((s.a != at_[v] && admits(v, s.a)) || (s.b != at_[v] && admits(v, s.b)));
    });
  }
  /// The square of the distance of the nearest place.
  std::optional<Rational> nearest(std::uint32_t v) const {
    std::vector<Segment> walls(made_);
    for (std::uint32_t e = 0; e < at_.size(); ++e)
      if (e != v && next_[e] != v && stands_[ring_[e]]) walls.push_back({at_[e], at_[next_[e]]});
    std::optional<Rational> best;
    for (const Segment& s : walls)
      for (const RationalPoint& p : places(v, s)) {
        const Rational square = dot_of(at_[v], p, p);
        if (square.sign() > 0 && admits(v, p) && (!best || square < *best)) best = square;
      }
    return best;
  }
  /// Where the nearest place of a segment in the cone can be: its ends, the foot, the sides of the cone.
  std::vector<RationalPoint> places(std::uint32_t v, const Segment& s) const {
    std::vector<RationalPoint> found{s.a, s.b};
    const auto add_at = [&](const Rational& t) {
      if (t.sign() >= 0 && t <= Rational(1))
        found.push_back({s.a.x + t * (s.b.x - s.a.x), s.a.y + t * (s.b.y - s.a.y)});
    };
    add_at(dot_of(s.a, s.b, at_[v]) / dot_of(s.a, s.b, s.b));
    for (const std::uint32_t side : {next_[v], previous_[v]}) {
      const Rational p = cross_of(at_[v], at_[side], s.a), q = cross_of(at_[v], at_[side], s.b);
      if (p != q) add_at(p / (p - q));
    }
    return found;
  }
  /// Adds a cut after looking whether it is the shortest in the cone.
  void take(const Cut& cut) {
    EXPECT_EQ(cut.from, at_[cut.vertex]);
    EXPECT_TRUE(admits(cut.vertex, cut.to));
    EXPECT_FALSE(resolved(cut.vertex));
    EXPECT_EQ(dot_of(cut.from, cut.to, cut.to), nearest(cut.vertex));
    for (const Segment& s : made_) EXPECT_FALSE(cross_properly(s.a, s.b, cut.from, cut.to));
    for (std::uint32_t e = 0; e < at_.size(); ++e) {
      EXPECT_FALSE(stands_[ring_[e]] && cross_properly(cut.from, cut.to, at_[e], at_[next_[e]]));
    }
    for (std::uint32_t e = 0; e < at_.size(); ++e)
      if (cross_properly(cut.from, cut.to, at_[e], at_[next_[e]]) || lies_on(cut.from, cut.to, at_[e]))
        stands_[ring_[e]] = true;
    made_.push_back({cut.from, cut.to});
  }

  std::vector<RationalPoint> at_;
  std::vector<std::uint32_t> next_, previous_, ring_;
  std::vector<bool> hole_, stands_;
  std::vector<Segment> made_;
};

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
  for (const Cut& cut : made.cuts) {
    bool separates = false;
    for (const auto& [edge, piece] : piece_at) {
      if (!lies_on(cut.from, cut.to, edge.first) || !lies_on(cut.from, cut.to, edge.second)) continue;
      const auto other = piece_at.find({edge.second, edge.first});
      if (other == piece_at.end()) continue;  // of a hole
      EXPECT_NE(other->second, piece) << "a slit";
      separates = true;
    }
    EXPECT_TRUE(separates);
  }
}

void expect_decomposed(const Region& region, const std::vector<Rational>& taus, int& partners) {
  const ShapeFeatures features = ShapeFeatures::create(region).value();
  std::optional<Decomposition> finer;
  for (const Rational& tau : taus) {
    const Decomposition made = decompose(features, {tau, 0, std::nullopt, {}}).value();
    Definition(region).follow(features.bars(), features.significant(tau), made.cuts);
    for (const Piece& piece : made.pieces) expect_valid(piece);
    expect_tiled(region, made);
    for (const Cut& cut : made.cuts) partners += cut.partner ? 1 : 0;
    if (finer) {
      ASSERT_LE(made.cuts.size(), finer->cuts.size());
      EXPECT_TRUE(std::equal(made.cuts.begin(), made.cuts.end(), finer->cuts.begin())) << "levels are not nested";
    }
    finer = made;
  }
}

TEST(Decompose, PlatesAreCutAsDefined) {
  int partners = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_decomposed(plate(seed), {0, 2, 3, 4, 5, 6, 8}, partners);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(partners, 60);
}

TEST(Decompose, PlatesOfAnyDoublesAreCutAsDefined) {
  int partners = 0;
  for (unsigned seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_decomposed(loose_plate(seed), {0, Rational::parse("1/10").value(), Rational::parse("1/4").value()},
                      partners);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(partners, 3);
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
