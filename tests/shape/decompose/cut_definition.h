// The definition of cuts, slowly and in rational numbers.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "dymsum/decomposition.h"

namespace dymsum::cut_definition {

struct PointLess {
  bool operator()(const RationalPoint& a, const RationalPoint& b) const { return a.x != b.x ? a.x < b.x : a.y < b.y; }
};

inline RationalPoint exactly(Point p) { return {Rational::of(p.x).value(), Rational::of(p.y).value()}; }

inline Rational cross_of(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}
inline Rational dot_of(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c) {
  return (b.x - a.x) * (c.x - a.x) + (b.y - a.y) * (c.y - a.y);
}
inline bool lies_on(const RationalPoint& a, const RationalPoint& b, const RationalPoint& p) {
  return cross_of(a, b, p).sign() == 0 && dot_of(a, b, p).sign() >= 0 && dot_of(b, a, p).sign() >= 0;
}
inline bool cross_properly(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c,
                           const RationalPoint& d) {
  return cross_of(a, b, c).sign() * cross_of(a, b, d).sign() < 0 &&
         cross_of(c, d, a).sign() * cross_of(c, d, b).sign() < 0;
}

/// A region's vertices, and the definition of a cut.
class Definition {
 public:
  explicit Definition(const Region& region) {
    for (const Part& part : region.parts()) {
      std::vector<Ring> rings{part.outer};
      rings.insert(rings.end(), part.holes.begin(), part.holes.end());
      for (std::size_t r = 0; r < rings.size(); ++r) add(rings[r], r > 0);
      ++parts_;
    }
  }

  /// Follows the cuts, bar by bar: each has to be the one that the definition requests.
  void follow(const std::vector<FeatureBar>& bars, const std::vector<std::uint32_t>& order,
              const std::vector<Cut>& cuts) {
    std::set<std::uint32_t> done;
    std::size_t next = 0;
    const auto partners = [&] {
      for (; next < cuts.size() && cuts[next].partner; ++next) {
        EXPECT_TRUE(hole_[ring_[cuts[next].vertex]]);
        look_at_partner(cuts[next]);
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

  /// Partners whose choice was looked at.
  int single_partners() const { return single_; }

 private:
  struct Segment {
    RationalPoint a, b;
    std::uint32_t ring = 0;  ///< of a cut: where it begins
  };
  /// The nearest position of what stands.
  struct Near {
    Rational square;
    std::optional<std::size_t> cut;  ///< the cut made before that it lies on
  };

  static bool same_worth(const FeatureBar& a, const FeatureBar& b) {
    return a.birth == b.birth && a.death == b.death && a.concavity == b.concavity && a.significance == b.significance;
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
    part_.push_back(parts_);
    stands_.push_back(!hole);
  }

  bool admits(std::uint32_t v, const RationalPoint& p) const {
    return cross_of(at_[v], at_[next_[v]], p).sign() >= 0 && cross_of(at_[v], at_[previous_[v]], p).sign() <= 0;
  }
  bool resolved(std::uint32_t v) const {
    return std::any_of(made_.begin(), made_.end(), [&](const Segment& s) {
      return part_[s.ring] == part_[ring_[v]] && lies_on(s.a, s.b, at_[v]) &&
             ((s.a != at_[v] && admits(v, s.a)) || (s.b != at_[v] && admits(v, s.b)));
    });
  }
  std::optional<Near> nearest(std::uint32_t v) const {
    std::optional<Near> best;
    const auto look = [&](const Segment& s, std::optional<std::size_t> cut) {
      for (const RationalPoint& p : positions(v, s)) {
        const Rational square = dot_of(at_[v], p, p);
        if (square.sign() > 0 && admits(v, p) && (!best || square < best->square)) best = Near{square, cut};
      }
    };
    for (std::uint32_t e = 0; e < at_.size(); ++e)
      if (e != v && next_[e] != v && stands_[ring_[e]] && part_[ring_[e]] == part_[ring_[v]])
        look({at_[e], at_[next_[e]]}, std::nullopt);
    for (std::size_t c = 0; c < made_.size(); ++c)
      if (part_[made_[c].ring] == part_[ring_[v]]) look(made_[c], c);
    return best;
  }
  /// Where the nearest position of a segment in the cone can be: its ends, the foot, the sides of the cone.
  std::vector<RationalPoint> positions(std::uint32_t v, const Segment& s) const {
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
    const std::optional<Near> near = nearest(cut.vertex);
    ASSERT_TRUE(near);
    EXPECT_EQ(dot_of(cut.from, cut.to, cut.to), near->square);
    const std::uint32_t ring = ring_[cut.vertex];
    for (const Segment& s : made_)
      EXPECT_FALSE(part_[s.ring] == part_[ring] && cross_properly(s.a, s.b, cut.from, cut.to));
    for (std::uint32_t e = 0; e < at_.size(); ++e) {
      if (part_[ring_[e]] != part_[ring]) continue;
      EXPECT_FALSE(stands_[ring_[e]] && cross_properly(cut.from, cut.to, at_[e], at_[next_[e]]));
    }
    for (std::uint32_t e = 0; e < at_.size(); ++e)
      if (part_[ring_[e]] == part_[ring] && touches({cut.from, cut.to}, e)) stands_[ring_[e]] = true;
    made_.push_back({cut.from, cut.to, ring});
  }

  bool touches(const Segment& s, std::uint32_t e) const {
    return cross_properly(s.a, s.b, at_[e], at_[next_[e]]) || lies_on(s.a, s.b, at_[e]) ||
           lies_on(at_[e], at_[next_[e]], s.b);
  }

  /// Whether v is a corner of the convex hull of its ring: all else is left of a ray from v through another vertex, or
  /// on it.
  bool on_hull(std::uint32_t v) const {
    std::vector<RationalPoint> others;
    for (std::uint32_t u = 0; u < at_.size(); ++u)
      if (ring_[u] == ring_[v] && u != v) others.push_back(at_[u]);
    return std::any_of(others.begin(), others.end(), [&](const RationalPoint& a) {
      return std::all_of(others.begin(), others.end(), [&](const RationalPoint& b) {
        const int side = cross_of(at_[v], a, b).sign();
        return side > 0 || (side == 0 && dot_of(at_[v], a, b).sign() > 0);
      });
    });
  }

  /// Of a hole that one cut connects with the rest: its partner is the shortest that ends elsewhere than at that cut,
  /// or, where there is none, the shortest.
  void look_at_partner(const Cut& cut) {
    const std::uint32_t ring = ring_[cut.vertex];
    std::set<std::size_t> touching;
    bool ends = false;
    for (std::size_t c = 0; c < made_.size(); ++c)
      for (std::uint32_t e = 0; e < at_.size(); ++e)
        if (ring_[e] == ring && touches(made_[c], e)) {
          touching.insert(c);
          ends = ends || made_[c].ring == ring || lies_on(at_[e], at_[next_[e]], made_[c].b);
        }
    if (touching.size() != 1 || !ends) return;  // it passes over the hole, or there is a group of holes
    std::optional<std::pair<bool, Rational>> best;
    for (std::uint32_t v = 0; v < at_.size(); ++v) {
      if (ring_[v] != ring || !on_hull(v) || resolved(v)) continue;
      const std::optional<Near> near = nearest(v);
      if (!near) continue;
      const std::pair<bool, Rational> rank{near->cut == *touching.begin(), near->square};
      if (!best || rank < *best) best = rank;
    }
    ASSERT_TRUE(best);
    EXPECT_EQ(dot_of(cut.from, cut.to, cut.to), best->second);
    ++single_;
  }

  std::vector<RationalPoint> at_;
  std::vector<std::uint32_t> next_, previous_, ring_, part_;
  std::vector<bool> hole_, stands_;
  std::vector<Segment> made_;
  std::uint32_t parts_ = 0;
  int single_ = 0;
};

}  // namespace dymsum::cut_definition
