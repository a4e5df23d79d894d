#include <algorithm>
#include <map>
#include <set>

#include "shape/decompose/cut_search.h"

namespace dymsum::shape {
namespace {

struct Less {
  bool operator()(const RationalPoint& a, const RationalPoint& b) const { return a.x != b.x ? a.x < b.x : a.y < b.y; }
};

Rational turn(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Whether p lies on the closed segment.
bool on(const RationalPoint& a, const RationalPoint& b, const RationalPoint& p) {
  return turn(a, b, p).sign() == 0 && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) &&
         std::min(a.y, b.y) <= p.y && p.y <= std::max(a.y, b.y);
}

/// Whether a ray from p to the right crosses the edge.
bool crosses_ray(const RationalPoint& a, const RationalPoint& b, const RationalPoint& p) {
  if ((a.y > p.y) == (b.y > p.y)) return false;
  return (turn(a, b, p).sign() > 0) == (b.y > a.y);
}

/// Counter-clockwise from the positive x direction.
bool turns_before(const RationalPoint& at, const RationalPoint& p, const RationalPoint& q) {
  const auto lower = [&](const RationalPoint& r) {
    const int dy = (r.y - at.y).sign();
    return dy < 0 || (dy == 0 && (r.x - at.x).sign() < 0);
  };
  if (lower(p) != lower(q)) return lower(q);
  return turn(at, p, q).sign() > 0;
}

class Subdivision {
 public:
  Subdivision(const RingTable& table, const std::vector<Cut>& cuts) {
    for (std::uint32_t v = 0; v < table.at.size(); ++v) corners_.push_back(rational_point(table.at[v]));
    std::vector<std::vector<RationalPoint>> on_edge(corners_.size()), on_cut(cuts.size());
    for (std::size_t c = 0; c < cuts.size(); ++c) {
      for (std::uint32_t e = 0; e < corners_.size(); ++e)
        meet(table, cuts[c], e, corners_[table.next[e]], on_edge[e], on_cut[c]);
      for (std::size_t d = 0; d < cuts.size(); ++d)
        if (d != c && on(cuts[c].from, cuts[c].to, cuts[d].to)) on_cut[c].push_back(cuts[d].to);
    }
    for (std::uint32_t e = 0; e < corners_.size(); ++e)
      add_pieces(corners_[e], corners_[table.next[e]], std::move(on_edge[e]),
                 [&](const auto& a, const auto& b) { out_[a].push_back(b); });
    for (std::size_t c = 0; c < cuts.size(); ++c) {
      const bool plain = on_cut[c].size() <= 2;
      add_pieces(cuts[c].from, cuts[c].to, std::move(on_cut[c]), [&](const auto& a, const auto& b) {
        const RationalPoint middle{(a.x + b.x) / Rational(2), (a.y + b.y) / Rational(2)};
        if (!plain && !inside(table, middle)) return;  // over a hole, or along its boundary
        out_[a].push_back(b);
        out_[b].push_back(a);
      });
    }
  }

  std::vector<RationalRing> cycles() {
    std::vector<RationalRing> rings;
    std::set<std::pair<RationalPoint, RationalPoint>, LessPair> used;
    for (const auto& [a, ends] : out_)
      for (const RationalPoint& b : ends) {
        RationalRing ring;
        RationalPoint p = a, q = b;
        while (used.insert({p, q}).second) {
          ring.push_back(p);
          const RationalPoint r = following(p, q);
          p = q;
          q = r;
        }
        if (!ring.empty()) rings.push_back(std::move(ring));
      }
    return rings;
  }

 private:
  struct LessPair {
    bool operator()(const std::pair<RationalPoint, RationalPoint>& a,
                    const std::pair<RationalPoint, RationalPoint>& b) const {
      return a.first != b.first ? Less()(a.first, b.first) : Less()(a.second, b.second);
    }
  };

  void meet(const RingTable& table, const Cut& cut, std::uint32_t e, const RationalPoint& b,
            std::vector<RationalPoint>& on_edge, std::vector<RationalPoint>& on_cut) const {
    const RationalPoint& a = corners_[e];
    const Point p = table.at[e], q = table.at[table.next[e]];
    const double x0 = std::min(p.x, q.x), x1 = std::max(p.x, q.x), y0 = std::min(p.y, q.y), y1 = std::max(p.y, q.y);
    // Rounding is monotone: boxes of rounded ends that are apart tell exact ones that are.
    const double fx = cut.from.x.to_double(), tx = cut.to.x.to_double();
    const double fy = cut.from.y.to_double(), ty = cut.to.y.to_double();
    if (std::max(fx, tx) < x0 || std::min(fx, tx) > x1 || std::max(fy, ty) < y0 || std::min(fy, ty) > y1) return;
    for (const RationalPoint* end : {&cut.from, &cut.to})
      if (on(a, b, *end)) on_edge.push_back(*end), on_cut.push_back(*end);
    for (const RationalPoint* end : {&a, &b})
      if (on(cut.from, cut.to, *end)) on_cut.push_back(*end);
    const Rational s = turn(a, b, cut.from), t = turn(a, b, cut.to);
    const int u = turn(cut.from, cut.to, a).sign(), w = turn(cut.from, cut.to, b).sign();
    if (s.sign() * t.sign() >= 0 || u * w >= 0) return;
    const Rational k = s / (s - t);
    const RationalPoint x{cut.from.x + k * (cut.to.x - cut.from.x), cut.from.y + k * (cut.to.y - cut.from.y)};
    on_edge.push_back(x);
    on_cut.push_back(x);
  }

  template <class Add>
  static void add_pieces(const RationalPoint& a, const RationalPoint& b, std::vector<RationalPoint> between,
                         const Add& add) {
    between.push_back(a);
    between.push_back(b);
    std::sort(between.begin(), between.end(), Less());
    between.erase(std::unique(between.begin(), between.end()), between.end());
    if (!Less()(a, b)) std::reverse(between.begin(), between.end());
    for (std::size_t i = 0; i + 1 < between.size(); ++i) add(between[i], between[i + 1]);
  }

  bool inside(const RingTable& table, const RationalPoint& p) const {
    bool odd = false;
    for (std::uint32_t e = 0; e < corners_.size(); ++e) {
      if (on(corners_[e], corners_[table.next[e]], p)) return false;
      odd = odd != crosses_ray(corners_[e], corners_[table.next[e]], p);
    }
    return odd;
  }

  /// The way on from p -> q with the piece on the left: the last direction before that back to p.
  RationalPoint following(const RationalPoint& p, const RationalPoint& q) const {
    const std::vector<RationalPoint>& ends = out_.at(q);
    if (ends.size() == 1) return ends.front();
    const RationalPoint *below = nullptr, *last = nullptr;
    for (const RationalPoint& r : ends) {
      if (turns_before(q, r, p) && (below == nullptr || turns_before(q, *below, r))) below = &r;
      if (last == nullptr || turns_before(q, *last, r)) last = &r;
    }
    return below != nullptr ? *below : *last;
  }

  std::vector<RationalPoint> corners_;
  std::map<RationalPoint, std::vector<RationalPoint>, Less> out_;
};

bool contains(const RationalRing& ring, const RationalPoint& p) {
  bool odd = false;
  for (std::size_t i = 0; i < ring.size(); ++i) odd = odd != crosses_ray(ring[i], ring[(i + 1) % ring.size()], p);
  return odd;
}

}  // namespace

std::vector<Piece> pieces_between(const RingTable& table, const std::vector<Cut>& cuts) {
  std::vector<Piece> pieces;
  std::vector<Rational> areas;
  std::vector<RationalRing> holes;
  for (RationalRing& ring : Subdivision(table, cuts).cycles()) {
    Rational area = twice_area(ring);
    if (area.sign() < 0) {
      holes.push_back(std::move(ring));
      continue;
    }
    areas.push_back(std::move(area));
    pieces.push_back({std::move(ring), {}});
  }
  for (RationalRing& hole : holes) {
    std::size_t best = pieces.size();
    for (std::size_t i = 0; i < pieces.size(); ++i)
      if (contains(pieces[i].outer, hole.front()) && (best == pieces.size() || areas[i] < areas[best])) best = i;
    pieces.at(best).holes.push_back(std::move(hole));
  }
  return pieces;
}

}  // namespace dymsum::shape
