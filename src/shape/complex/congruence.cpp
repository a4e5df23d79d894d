#include "shape/complex/congruence.h"

#include <algorithm>
#include <array>

#include "exact/orient.h"

namespace dymsum::shape {
namespace {

using exact::BigInteger;
using Exact = Formulas<exact::RootExpression>;
using Key = std::vector<BigInteger>;

/// What a key tells of; keys of different kinds differ.
enum Kind : int { kCorner, kNeckOfVertices, kNeckOfEdge, kVertices, kGap, kEnd, kThree };

/// Sites in the coordinates of an edge, or in those of its mirror image, which is walked from the other end.
class Picture {
 public:
  Picture(const Walks& walks, std::uint32_t edge, bool mirrored)
      : walks_(walks), formulas_(walks), frame_(formulas_.frame(edge)), mirrored_(mirrored) {}

  const BigInteger& length2() const { return frame_.length2; }
  /// A vertex by its coordinates, an edge by its directed line, however long it is.
  void add(std::uint32_t s, Key& key) const {
    const SiteEnds& ends = walks_.ends[s];
    const auto a = local(mirrored_ ? ends.b : ends.a);
    key.emplace_back(walks_.is_edge(s) ? 1 : 0);
    if (!walks_.is_edge(s)) {
      key.insert(key.end(), {a.x, a.y});
      return;
    }
    const auto b = local(mirrored_ ? ends.a : ends.b);
    const BigInteger dx = b.x - a.x, dy = b.y - a.y, c = dx * a.y - dy * a.x, divisor = gcd(gcd(dx, dy), c);
    key.insert(key.end(), {BigInteger(dx / divisor), BigInteger(dy / divisor), BigInteger(c / divisor)});
  }

 private:
  Vec<BigInteger> local(std::uint32_t point) const {
    const auto p = formulas_.local(frame_, point);
    return {mirrored_ ? BigInteger(frame_.length2 - p.x) : p.x, p.y};
  }

  const Walks& walks_;
  Exact formulas_;
  Exact::Frame frame_;
  bool mirrored_;
};

BigInteger distance2(const Walks& walks, std::uint32_t s, std::uint32_t t) {
  const auto v = Exact(walks).between(walks.ends[s].a, walks.ends[t].a);
  return dot(v, v);
}

/// A disc between parallel lines, as wide as the gap: the square of that, in lowest terms.
Key of_gap(const Walks& walks, std::uint32_t s, std::uint32_t t) {
  const Exact formulas(walks);
  const auto f = formulas.frame(s);
  const BigInteger y = formulas.local(f, walks.ends[t].a).y, num = y * y, divisor = gcd(num, f.length2);
  return {BigInteger(kGap), BigInteger(num / divisor), BigInteger(f.length2 / divisor)};
}
bool are_parallel(const Walks& walks, std::uint32_t s, std::uint32_t t) {
  if (!walks.is_edge(s) || !walks.is_edge(t)) return false;
  const Site &a = walks.sites[s], &b = walks.sites[t];
  return exact::cross_sign(a.a, a.b, b.a, b.b) == 0;
}

/// The disc that touches the line of an edge at its start (or end) and another site.
Key of_end(const Walks& walks, std::uint32_t edge, bool at_end, std::uint32_t other) {
  if (are_parallel(walks, edge, other)) return of_gap(walks, edge, other);
  const Picture picture(walks, edge, at_end);
  Key key{BigInteger(kEnd), picture.length2()};
  picture.add(other, key);
  return key;
}

/// Where a transition of a row from one site to another is: the sign of what the other makes of the disc, less what the
/// first does, is positive before it along an edge, where the smaller radius counts, and negative about a vertex.
bool is_transition(const Walks& walks, const DiscSource& d, std::uint32_t before) {
  const Mark& m = d.mark;
  const int before_first = m.lead == 0 ? -m.slope : m.root == 0 ? m.lead : -m.lead;  // of j less i
  const int wanted = walks.is_edge(d.section.site) ? 1 : -1;
  return before_first * (m.i == before ? 1 : -1) == wanted;
}

/// Of the disc that touches three sites in this order. There is one: of two that touch lines and points on their right
/// sides, one touches them clockwise, the other counter-clockwise; three lines have one in any case.
Key of_three(const Walks& walks, const std::array<std::uint32_t, 3>& sites) {
  Key best;
  for (std::size_t k = 0; k < 3; ++k) {
    if (are_parallel(walks, sites[k], sites[(k + 1) % 3])) return of_gap(walks, sites[k], sites[(k + 1) % 3]);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (!walks.is_edge(sites[k])) continue;
    for (const bool mirrored : {false, true}) {
      const std::uint32_t first = sites[(k + 1) % 3], second = sites[(k + 2) % 3];
      const Picture picture(walks, sites[k], mirrored);
      Key key{BigInteger(kThree), picture.length2()};
      picture.add(mirrored ? second : first, key);
      picture.add(mirrored ? first : second, key);
      if (best.empty() || key < best) best = std::move(key);
    }
  }
  if (!best.empty()) return best;
  best = {distance2(walks, sites[0], sites[1]), distance2(walks, sites[1], sites[2]),
          distance2(walks, sites[2], sites[0])};
  std::sort(best.begin(), best.end());
  best.insert(best.begin(), BigInteger(kVertices));
  return best;
}

Key of_neck(const Walks& walks, std::uint32_t edge, std::uint32_t vertex) {
  const Exact formulas(walks);
  const auto f = formulas.frame(edge);
  return {BigInteger(kNeckOfEdge), f.length2, formulas.local(f, walks.ends[vertex].a).y};
}

}  // namespace

std::vector<BigInteger> congruence_key(const Walks& walks, const DiscSource& d) {
  if (d.kind == DiscSource::Kind::corner) return {BigInteger(kCorner)};
  const std::uint32_t s = d.section.site;
  if (d.kind == DiscSource::Kind::neck) return {BigInteger(kNeckOfVertices), distance2(walks, s, d.other)};
  const Mark& m = d.mark;
  const bool on_edge = walks.is_edge(s);
  switch (m.kind) {
    case Mark::Kind::tangent:
      return of_end(walks, m.i, m.root == 1, s);
    case Mark::Kind::start:
    case Mark::Kind::end: {
      const bool end = m.kind == Mark::Kind::end;
      if (on_edge) return of_end(walks, s, end, d.other);
      if (walks.is_isolated(s)) return {};
      return of_end(walks, end ? walks.ends[s].next : walks.ends[s].prev, !end, d.other);
    }
    case Mark::Kind::crossing: {
      if (m.j == kNoIndex || (d.other != m.i && d.other != m.j) || !is_transition(walks, d, d.other)) return {};
      return of_three(walks, {s, d.other, d.other == m.i ? m.j : m.i});
    }
    case Mark::Kind::toward:
      return on_edge && !walks.is_edge(d.other) ? of_neck(walks, s, d.other) : Key{};
    default:
      return {};
  }
}

}  // namespace dymsum::shape
