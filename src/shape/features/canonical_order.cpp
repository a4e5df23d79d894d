#include "shape/features/canonical_order.h"

#include <algorithm>
#include <numeric>

#include "exact/grid.h"

namespace dymsum::shape {
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

struct Lengths {
  std::vector<std::uint32_t> from_mean, to_next;  ///< ranks of the squares
};

Lengths lengths_of(const BoundaryLoops& loops, int grid_exponent) {
  const auto coordinate = [&](double v) { return exact::grid_coordinate<exact::Big>(v, grid_exponent).value(); };
  std::vector<BigInteger> x, y;
  BigInteger sum_x, sum_y;
  for (const LoopVertex& v : loops.vertices) {
    x.push_back(coordinate(v.at.x));
    y.push_back(coordinate(v.at.y));
    sum_x += x.back();
    sum_y += y.back();
  }
  const BigInteger n(loops.vertices.size());
  std::vector<BigInteger> from_mean, to_next;
  for (std::uint32_t v = 0; v < x.size(); ++v) {
    const BigInteger dx = n * x[v] - sum_x, dy = n * y[v] - sum_y;
    from_mean.push_back(dx * dx + dy * dy);
    const std::uint32_t w = loops.next(v);
    const BigInteger ex = x[w] - x[v], ey = y[w] - y[v];
    to_next.push_back(ex * ex + ey * ey);
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

/// What is seen from every vertex forwards (at v) and backwards (at n + v), over ever longer stretches: ranks of twice
/// as many steps come from those of two stretches one behind the other.
class Stretches {
 public:
  Stretches(const BoundaryLoops& loops, const Lengths& lengths) : loops_(loops), n_(loops.vertices.size()) {
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

}  // namespace

std::vector<std::uint32_t> canonical_ranks(const BoundaryLoops& loops, const Walks& walks) {
  if (loops.vertices.empty()) return {};
  const Lengths lengths = lengths_of(loops, walks.grid_exponent);
  std::uint64_t longest = 0;
  for (const BoundaryLoop& loop : loops.loops) longest = std::max<std::uint64_t>(longest, loop.last - loop.first);
  Stretches stretches(loops, lengths);
  for (std::uint64_t steps = 1; steps < longest; steps *= 2) stretches.lengthen(steps);
  // The distance comes first, whatever follows.
  const std::vector<std::uint32_t> around = stretches.of_vertices();
  std::vector<Pair> keys(around.size());
  for (std::size_t v = 0; v < keys.size(); ++v) keys[v] = {lengths.from_mean[v], around[v]};
  return ranks_of(keys);
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
