#include "shape/complex/ranked.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "exact/orient.h"
#include "shape/complex/make_complex.h"

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

namespace {

using exact::FineInterval;
using exact::Interval;
using exact::RootExpression;

bool is_narrow(const Interval& v, double scale) { return !v.is_whole() && v.high() - v.low() <= scale * 0x1p-46; }

bool is_narrow(const DiscOf<Interval>& d) {
  const double scale = std::max(std::abs(d.x.midpoint()), std::abs(d.y.midpoint()));
  return is_narrow(d.x, scale) && is_narrow(d.y, scale) && is_narrow(d.radius, d.radius.midpoint());
}

/// Discs, and their radii in order.
class Ranking {
 public:
  Ranking(const Walks& walks, const std::vector<DiscSource>& discs, Work& work)
      : walks_(walks), discs_(discs), work_(work), fine_(discs.size()), exact_(discs.size()), keys_(discs.size()) {
    near_.reserve(discs.size());
    for (const DiscSource& d : discs) {
      near_.push_back(disc_of<Interval>(walks, d));
      if (is_narrow(near_.back())) continue;
      const DiscOf<FineInterval> fine = disc_of<FineInterval>(walks, d);
      near_.back() = {fine.x.rounded(), fine.y.rounded(), fine.radius.rounded()};
    }
  }

  /// The rank of every disc.
  std::vector<std::uint32_t> ranks() {
    std::vector<std::uint32_t> order(discs_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) { return low(i) < low(j); });
    std::vector<std::uint32_t> ranks(discs_.size());
    std::uint32_t rank = 0;
    for (auto first = order.begin(); first != order.end();) {
      auto last = first + 1;
      double top = high(*first);
      while (last != order.end() && low(*last) <= top) top = std::max(top, high(*last++));
      rank = rank_cluster(first, last, rank, ranks);
      first = last;
    }
    return ranks;
  }

  const DiscOf<Interval>& near(std::uint32_t i) const { return near_[i]; }
  /// The double nearest to a radius.
  double nearest_radius(std::uint32_t i) {
    if (const std::optional<double> radius = finely(i).nearest()) {
      const double scaled = std::ldexp(*radius, walks_.unit_exponent);
      if (scaled == 0 || std::abs(scaled) >= std::numeric_limits<double>::min()) return scaled;
    }
    work_.signs.count(exact::Rung::big);
    return exact::nearest_double(exactly(i) * exact::RootExpression(std::ldexp(1.0, walks_.grid_exponent)));
  }

 private:
  using Iterator = std::vector<std::uint32_t>::iterator;
  double low(std::uint32_t i) const { return near_[i].radius.low(); }
  double high(std::uint32_t i) const { return near_[i].radius.high(); }

  /// Radii whose intervals hang together: classes of equal ones, found by halving.
  std::uint32_t rank_cluster(Iterator first, Iterator last, std::uint32_t rank, std::vector<std::uint32_t>& ranks) {
    if (last - first == 1) {
      ranks[*first] = rank;
      return rank + 1;
    }
    std::vector<std::vector<std::uint32_t>> classes;
    for (; first != last; ++first) {
      std::size_t low = 0, high = classes.size();
      bool found = false;
      while (low < high && !found) {
        const std::size_t midpoint = (low + high) / 2;
        const int sign = compare(*first, classes[midpoint][0]);
        found = sign == 0;
        if (found) low = midpoint;
        if (sign < 0) high = midpoint;
        if (sign > 0) low = midpoint + 1;
      }
      if (!found) classes.insert(classes.begin() + static_cast<std::ptrdiff_t>(low), std::vector<std::uint32_t>{});
      classes[low].push_back(*first);
    }
    for (const auto& equal : classes) {
      for (const std::uint32_t i : equal) ranks[i] = rank;
      ++rank;
    }
    return rank;
  }

  int compare(std::uint32_t i, std::uint32_t j) {
    if (high(i) < low(j)) return -1;
    if (low(i) > high(j)) return 1;
    if (near_[i].radius.is_point() && near_[j].radius.is_point()) return 0;
    if (const std::optional<int> sign = sign_of(finely(i) - finely(j))) return *sign;
    if (!key(i).empty() && key(i) == key(j)) return 0;
    work_.signs.count(exact::Rung::big);
    return exact::compare(exactly(i), exactly(j));
  }
  const FineInterval& finely(std::uint32_t i) {
    if (!fine_[i]) fine_[i] = radius_of<FineInterval>(walks_, discs_[i]);
    return *fine_[i];
  }
  const std::vector<exact::BigInteger>& key(std::uint32_t i) {
    if (!keys_[i]) keys_[i] = congruence_key(walks_, discs_[i]);
    return *keys_[i];
  }
  const RootExpression& exactly(std::uint32_t i) {
    if (!exact_[i]) exact_[i] = radius_of<RootExpression>(walks_, discs_[i]);
    return *exact_[i];
  }

  const Walks& walks_;
  const std::vector<DiscSource>& discs_;
  Work& work_;
  std::vector<DiscOf<Interval>> near_;
  std::vector<std::optional<FineInterval>> fine_;
  std::vector<std::optional<RootExpression>> exact_;
  std::vector<std::optional<std::vector<exact::BigInteger>>> keys_;
};

/// The centre as doubles.
Point rounded_centre(const Walks& walks, const DiscSource& source, const DiscOf<Interval>& near) {
  if (is_narrow(near)) {
    const int e = walks.unit_exponent;
    return {std::ldexp(near.x.midpoint(), e), std::ldexp(near.y.midpoint(), e)};
  }
  const DiscOf<RootExpression> disc = disc_of<RootExpression>(walks, source);
  const RootExpression unit(std::ldexp(1.0, walks.grid_exponent));
  return {exact::nearest_double(disc.x * unit), exact::nearest_double(disc.y * unit)};
}

/// Ranks, centres and radii: equal ones are rounded once.
void fill_in(Graph& graph, const Walks& walks, Ranking& ranking) {
  const std::vector<std::uint32_t> ranks = ranking.ranks();
  std::vector<double> radius(graph.nodes.size(), -1);
  for (std::uint32_t n = 0; n < graph.nodes.size(); ++n) {
    Node& node = graph.nodes[n];
    node.rank = ranks[n];
    node.centre = rounded_centre(walks, graph.discs[n], ranking.near(n));
    if (radius[node.rank] < 0) radius[node.rank] = ranking.nearest_radius(n);
    node.radius = radius[node.rank];
  }
}

template <class V>
void permute(V& list, const std::vector<std::uint32_t>& order) {
  V out;
  out.reserve(list.size());
  for (const std::uint32_t i : order) out.push_back(std::move(list[i]));
  list = std::move(out);
}

}  // namespace

Complex ranked(Graph graph, std::shared_ptr<ExactComplex> exact, Work work) {
  const Walks& walks = exact->walks;
  Ranking ranking(walks, graph.discs, work);
  fill_in(graph, walks, ranking);
  std::vector<std::uint32_t> order(graph.nodes.size()), position(order.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t i, std::uint32_t j) { return graph.nodes[i].rank < graph.nodes[j].rank; });
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    position[order[i]] = i;
    exact->radii.push_back(ranking.near(i).radius);
  }
  permute(graph.nodes, order);
  permute(graph.discs, order);
  permute(graph.contacts, order);
  permute(graph.spokes, order);
  permute(exact->radii, order);

  Complex complex;
  complex.side = walks.side;
  complex.sites = walks.sites;
  complex.nodes = std::move(graph.nodes);
  complex.edges = std::move(graph.edges);
  for (Edge& e : complex.edges) {
    e.low = position[e.low];
    if (e.high != kNoIndex) e.high = position[e.high];
  }
  complex.first_spoke.push_back(0);
  for (const std::vector<Spoke>& spokes : graph.spokes) {
    complex.spokes.insert(complex.spokes.end(), spokes.begin(), spokes.end());
    complex.first_spoke.push_back(static_cast<std::uint32_t>(complex.spokes.size()));
  }
  exact->discs = std::move(graph.discs);
  exact->contacts = std::move(graph.contacts);
  complex.exact = std::move(exact);
  complex.work = work;
  return complex;
}

}  // namespace dymsum::shape
