#include "shape/features/boundary_loops.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "exact/grid.h"
#include "exact/orient.h"
#include "shape/complex/exact_complex.h"

namespace dymsum::shape {
namespace {

bool less(Point a, Point b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

/// Sites [first, last) are one loop: edges in order, each perhaps led by the convex vertex that it starts at, or a
/// point.
void add_loop(const Complex& complex, std::uint32_t first, std::uint32_t last, BoundaryLoops& loops) {
  BoundaryLoop loop;
  loop.first = std::uint32_t(loops.vertices.size());
  loop.component = complex.sites[first].component;
  const std::uint32_t index = std::uint32_t(loops.loops.size());
  bool any_edge = false;
  for (std::uint32_t s = first; s < last; ++s) any_edge = any_edge || complex.sites[s].kind == Site::Kind::edge;
  for (std::uint32_t s = first; s < last; ++s) {
    const Site& site = complex.sites[s];
    if (site.kind == Site::Kind::vertex && any_edge) continue;
    LoopVertex v;
    v.at = site.a;
    v.edge = any_edge ? s : kNoIndex;
    const std::uint32_t led = s == first ? last - 1 : s - 1;
    const bool convex = !any_edge || (complex.sites[led].kind == Site::Kind::vertex);
    v.convex = convex;
    v.vertex = !any_edge ? site.index : convex ? complex.sites[led].index : kNoIndex;
    loops.vertices.push_back(v);
  }
  loop.last = std::uint32_t(loops.vertices.size());
  loops.loop_of.resize(loop.last, index);
  loops.loops.push_back(loop);
  // Where a contact of each site lies among the vertices.
  std::uint32_t at = loop.last - 1;
  for (std::uint32_t s = first; s < last; ++s) {
    const bool edge = complex.sites[s].kind == Site::Kind::edge;
    if (edge) at = at + 1 == loop.last ? loop.first : at + 1;
    loops.loop_of_site[s] = index;
    loops.before[s] = at;
    loops.after[s] = edge ? loops.next(at) : loops.next(loops.next(at));
    if (!any_edge) loops.before[s] = loops.after[s] = loop.first;
  }
}

/// The vertices of reflex corners are known to the nodes at radius 0.
void name_corners(const Complex& complex, BoundaryLoops& loops) {
  for (const Edge& e : complex.edges) {
    const Node& low = complex.nodes[e.low];
    if (low.kind != Node::Kind::corner) continue;
    loops.vertices[loops.after[e.right]].vertex = low.vertex;
  }
}

/// -1, 0, 1: d lies less far to the left of the line a -> b than c, as far, farther.
int farther(Point a, Point b, Point c, Point d) { return exact::cross_sign(a, b, c, d); }

void find_outermost(const BoundaryLoops& loops, BoundaryLoop& loop) {
  const auto at = [&](std::uint32_t v) { return loops.vertices[v].at; };
  std::uint32_t low = loop.first, high = loop.first;
  const auto better = [&](std::uint32_t v, std::uint32_t than, bool smaller) {
    if (at(v) == at(than)) return loops.vertices[v].convex && !loops.vertices[than].convex;
    return smaller ? less(at(v), at(than)) : less(at(than), at(v));
  };
  for (std::uint32_t v = loop.first; v < loop.last; ++v) {
    if (better(v, low, true)) low = v;
    if (better(v, high, false)) high = v;
  }
  loop.encloses = !loops.vertices[low].convex;
  if (loop.encloses) return;
  std::uint32_t left = low, right = low;
  for (std::uint32_t v = loop.first; v < loop.last; ++v) {
    if (!loops.vertices[v].convex) continue;
    if (farther(at(low), at(high), at(left), at(v)) > 0) left = v;
    if (farther(at(low), at(high), at(right), at(v)) < 0) right = v;
  }
  loop.outermost = {low, high, left != low ? left : right != low ? right : kNoIndex};
}

}  // namespace

std::uint32_t BoundaryLoops::next(std::uint32_t v) const {
  const BoundaryLoop& loop = loops[loop_of[v]];
  return v + 1 == loop.last ? loop.first : v + 1;
}

std::uint32_t BoundaryLoops::previous(std::uint32_t v) const {
  const BoundaryLoop& loop = loops[loop_of[v]];
  return v == loop.first ? loop.last - 1 : v - 1;
}

std::uint32_t length(const BoundaryLoops& loops, const BoundaryChain& chain) {
  const BoundaryLoop& loop = loops.loops[chain.loop];
  return (chain.last >= chain.first ? chain.last - chain.first : loop.last - loop.first - (chain.first - chain.last)) +
         1;
}

bool holds(const BoundaryLoops& loops, const BoundaryChain& chain, std::uint32_t vertex) {
  if (loops.loop_of[vertex] != chain.loop) return false;
  if (chain.first <= chain.last) return chain.first <= vertex && vertex <= chain.last;
  return vertex >= chain.first || vertex <= chain.last;
}

BoundaryLoops boundary_loops(const Complex& complex) {
  BoundaryLoops loops;
  const std::uint32_t n = std::uint32_t(complex.sites.size());
  loops.before.resize(n);
  loops.after.resize(n);
  loops.loop_of_site.resize(n);
  for (std::uint32_t first = 0, last = 0; first < n; first = last) {
    while (last < n && complex.sites[last].loop == complex.sites[first].loop) ++last;
    add_loop(complex, first, last, loops);
  }
  name_corners(complex, loops);
  for (BoundaryLoop& loop : loops.loops) find_outermost(loops, loop);
  loops.rank = canonical_ranks(loops, complex.exact->walks);
  return loops;
}

namespace {

using exact::BigInteger;

/// The rank of every key: equal ones have one rank.
template <class Key>
std::vector<std::uint32_t> ranks_of(const std::vector<Key>& keys) {
  std::vector<std::uint32_t> order(keys.size()), rank(keys.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) { return keys[i] < keys[j]; });
  std::uint32_t next = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i > 0 && keys[order[i - 1]] < keys[order[i]]) ++next;
    rank[order[i]] = next;
  }
  return rank;
}

/// Vertices by their differences from the mean of all, multiplied by their number.
struct FromMean {
  std::vector<BigInteger> x, y;
};

FromMean from_mean_of(const BoundaryLoops& loops, int grid_exponent) {
  const auto coordinate = [&](double v) { return exact::grid_coordinate<exact::Big>(v, grid_exponent).value(); };
  FromMean all;
  BigInteger sum_x, sum_y;
  for (const LoopVertex& v : loops.vertices) {
    all.x.push_back(coordinate(v.at.x));
    all.y.push_back(coordinate(v.at.y));
    sum_x += all.x.back();
    sum_y += all.y.back();
  }
  const BigInteger n(loops.vertices.size());
  for (BigInteger& x : all.x) x = n * x - sum_x;
  for (BigInteger& y : all.y) y = n * y - sum_y;
  return all;
}

struct Lengths {
  std::vector<std::uint32_t> from_mean, to_next;  ///< ranks of the squares
};

Lengths lengths_of(const BoundaryLoops& loops, const FromMean& at) {
  const auto square = [](const BigInteger& x, const BigInteger& y) { return BigInteger(x * x + y * y); };
  std::vector<BigInteger> from_mean, to_next;
  for (std::uint32_t v = 0; v < at.x.size(); ++v) {
    const std::uint32_t w = loops.next(v);
    from_mean.push_back(square(at.x[v], at.y[v]));
    to_next.push_back(square(BigInteger(at.x[w] - at.x[v]), BigInteger(at.y[w] - at.y[v])));
  }
  return {ranks_of(from_mean), ranks_of(to_next)};
}

using Pair = std::array<std::uint32_t, 2>;

Pair sorted(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

/// The vertex some steps ahead on its loop.
std::uint32_t ahead(const BoundaryLoops& loops, std::uint32_t v, std::uint64_t steps) {
  const BoundaryLoop& loop = loops.loops[loops.loop_of[v]];
  const std::uint64_t size = loop.last - loop.first;
  return loop.first + static_cast<std::uint32_t>((v - loop.first + steps % size) % size);
}
std::uint32_t behind(const BoundaryLoops& loops, std::uint32_t v, std::uint64_t steps) {
  const BoundaryLoop& loop = loops.loops[loops.loop_of[v]];
  const std::uint64_t size = loop.last - loop.first;
  return ahead(loops, v, size - steps % size);
}

/// What is seen from every vertex forwards (at v) and backwards (at n + v), over ever longer runs: ranks of twice
/// as many steps come from those of two runs one after the other.
class Intervals {
 public:
  Intervals(const BoundaryLoops& loops, const Lengths& lengths) : loops_(loops), n_(loops.vertices.size()) {
    std::vector<std::array<std::uint32_t, 3>> keys(2 * n_);
    for (std::uint32_t v = 0; v < n_; ++v) {
      const BoundaryLoop& loop = loops.loops[loops.loop_of[v]];
      const std::uint32_t size = loop.last - loop.first, from = lengths.from_mean[v];
      keys[v] = {from, size, lengths.to_next[v]};
      keys[n_ + v] = {from, size, lengths.to_next[loops.previous(v)]};
    }
    ranks_ = ranks_of(keys);
  }

  void lengthen(std::uint64_t steps) {
    std::vector<Pair> keys(2 * n_);
    for (std::uint32_t v = 0; v < n_; ++v) {
      keys[v] = {ranks_[v], ranks_[ahead(loops_, v, steps)]};
      keys[n_ + v] = {ranks_[n_ + v], ranks_[n_ + behind(loops_, v, steps)]};
    }
    ranks_ = ranks_of(keys);
  }

  std::vector<std::uint32_t> of_vertices() const {
    std::vector<Pair> keys(n_);
    for (std::uint32_t v = 0; v < n_; ++v) keys[v] = sorted(ranks_[v], ranks_[n_ + v]);
    return ranks_of(keys);
  }

 private:
  const BoundaryLoops& loops_;
  std::size_t n_;
  std::vector<std::uint32_t> ranks_;
};

/// Coordinates with the mean for origin and a vertex on the first axis, mirrored or not.
class Frame {
 public:
  Frame(const BoundaryLoops& loops, const FromMean& at, const std::vector<std::uint32_t>& ranks, std::uint32_t axis,
        bool mirrored)
      : order_(ranks.size()), position_(ranks.size()) {
    for (std::uint32_t v = 0; v < ranks.size(); ++v) {
      along_.push_back(at.x[axis] * at.x[v] + at.y[axis] * at.y[v]);
      across_.push_back(at.x[axis] * at.y[v] - at.y[axis] * at.x[v]);
      if (mirrored) across_.back() = -across_.back();
    }
    std::iota(order_.begin(), order_.end(), 0U);
    std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
      if (ranks[a] != ranks[b]) return ranks[a] < ranks[b];
      return std::tie(along_[a], across_[a], a) < std::tie(along_[b], across_[b], b);
    });
    for (std::uint32_t k = 0; k < order_.size(); ++k) position_[order_[k]] = k;
    for (const std::uint32_t v : order_) {
      neighbours_.push_back({position_[loops.next(v)], position_[loops.previous(v)]});
      if (mirrored) std::swap(neighbours_.back()[0], neighbours_.back()[1]);
    }
  }

  /// The order by what is seen in a frame: equal frames are images of each other under a symmetry of the region.
  bool operator<(const Frame& other) const {
    for (std::size_t k = 0; k < order_.size(); ++k) {
      const std::uint32_t v = order_[k], w = other.order_[k];
      if (along_[v] != other.along_[w]) return along_[v] < other.along_[w];
      if (across_[v] != other.across_[w]) return across_[v] < other.across_[w];
    }
    return neighbours_ < other.neighbours_;
  }
  std::vector<std::uint32_t> positions() && { return std::move(position_); }

 private:
  std::vector<BigInteger> along_, across_;
  std::vector<std::uint32_t> order_, position_;
  std::vector<Pair> neighbours_;
};

/// Ranks without ties: those that are equal by their positions in the least of the frames whose axis goes through a
/// vertex of a rank that few have.
std::vector<std::uint32_t> distinguished(const BoundaryLoops& loops, const FromMean& at,
                                         const std::vector<std::uint32_t>& ranks) {
  std::vector<std::uint32_t> count(ranks.size(), 0);
  for (const std::uint32_t rank : ranks) ++count[rank];
  std::uint32_t fewest = kNoIndex;
  for (std::uint32_t v = 0; v < ranks.size(); ++v)
    if ((at.x[v] != 0 || at.y[v] != 0) &&
        (fewest == kNoIndex || std::make_pair(count[ranks[v]], ranks[v]) < std::make_pair(count[fewest], fewest)))
      fewest = ranks[v];
  std::optional<Frame> least;
  for (std::uint32_t v = 0; v < ranks.size() && fewest != kNoIndex; ++v) {
    if (ranks[v] != fewest) continue;
    for (const bool mirrored : {false, true}) {
      Frame frame(loops, at, ranks, v, mirrored);
      if (!least || frame < *least) least = std::move(frame);
    }
  }
  return least ? std::move(*least).positions() : ranks;
}

}  // namespace

std::vector<std::uint32_t> canonical_ranks(const BoundaryLoops& loops, const Walks& walks) {
  if (loops.vertices.empty()) return {};
  const FromMean at = from_mean_of(loops, walks.grid_exponent);
  const Lengths lengths = lengths_of(loops, at);
  std::uint64_t longest = 0;
  for (const BoundaryLoop& loop : loops.loops) longest = std::max<std::uint64_t>(longest, loop.last - loop.first);
  Intervals intervals(loops, lengths);
  for (std::uint64_t steps = 1; steps < longest; steps *= 2) intervals.lengthen(steps);
  // The distance comes first, whatever follows.
  const std::vector<std::uint32_t> around = intervals.of_vertices();
  std::vector<Pair> keys(around.size());
  for (std::size_t v = 0; v < keys.size(); ++v) keys[v] = {lengths.from_mean[v], around[v]};
  const std::vector<std::uint32_t> ranks = ranks_of(keys);
  const bool distinct = *std::max_element(ranks.begin(), ranks.end()) + 1 == ranks.size();
  return distinct ? ranks : distinguished(loops, at, ranks);
}

ContactRanks contact_ranks(const Complex& complex, const BoundaryLoops& loops, std::uint32_t edge) {
  const auto of_site = [&](std::uint32_t s) {
    if (complex.sites[s].kind == Site::Kind::edge)
      return sorted(loops.rank[loops.before[s]], loops.rank[loops.after[s]]);
    const std::uint32_t rank = loops.rank[loops.next(loops.before[s])];
    return Pair{rank, rank};
  };
  Pair left = of_site(complex.edges[edge].left), right = of_site(complex.edges[edge].right);
  if (right < left) std::swap(left, right);
  return {left[0], left[1], right[0], right[1]};
}

}  // namespace dymsum::shape
