#include "shape/features/chain_extremes.h"

#include <algorithm>
#include <utility>

#include "exact/orient.h"

namespace dymsum::shape {
namespace {

constexpr std::uint32_t kRun = 16;  // shorter runs are looked through

bool left_of(const BoundaryLoops& loops, std::uint32_t a, std::uint32_t b) {
  const Point p = loops.vertices[a].at, q = loops.vertices[b].at;
  return p.x != q.x ? p.x < q.x : p.y < q.y;
}

/// The chain of the hull above (turn > 0: the hull lies to the right of its edges) or below sorted vertices.
std::vector<std::uint32_t> half_hull(const BoundaryLoops& loops, const std::vector<std::uint32_t>& sorted, int turn) {
  std::vector<std::uint32_t> hull;
  for (const std::uint32_t v : sorted) {
    const auto at = [&](std::size_t back) { return loops.vertices[hull[hull.size() - back]].at; };
    if (!hull.empty() && at(1) == loops.vertices[v].at) {  // rings touch there, or a polyline comes back
      const auto name = [&](std::uint32_t w) { return std::make_pair(loops.rank[w], loops.vertices[w].vertex); };
      if (name(v) < name(hull.back())) hull.back() = v;
      continue;
    }
    while (hull.size() > 1 && exact::orient_sign(at(2), at(1), loops.vertices[v].at) * turn >= 0) hull.pop_back();
    hull.push_back(v);
  }
  return hull;
}

std::vector<std::uint32_t> merged(const BoundaryLoops& loops, const std::vector<std::uint32_t>& a,
                                  const std::vector<std::uint32_t>& b) {
  std::vector<std::uint32_t> all(a.size() + b.size());
  std::merge(a.begin(), a.end(), b.begin(), b.end(), all.begin(),
             [&](std::uint32_t x, std::uint32_t y) { return left_of(loops, x, y); });
  return all;
}

}  // namespace

ChainExtremes::ChainExtremes(const BoundaryLoops& loops) : loops_(&loops) {
  const std::uint32_t n = std::uint32_t(loops.vertices.size());
  levels_.emplace_back();
  for (std::uint32_t first = 0; first < n; first += kRun) {
    std::vector<std::uint32_t> run;
    for (std::uint32_t v = first; v < std::min(n, first + kRun); ++v) run.push_back(v);
    std::stable_sort(run.begin(), run.end(), [&](std::uint32_t a, std::uint32_t b) { return left_of(loops, a, b); });
    levels_[0].push_back({half_hull(loops, run, 1), half_hull(loops, run, -1)});
  }
  while (levels_.back().size() > 1) {
    std::vector<Hull> level;
    const std::vector<Hull>& below = levels_.back();
    for (std::size_t i = 0; i + 1 < below.size(); i += 2) {
      level.push_back({half_hull(loops, merged(loops, below[i].upper, below[i + 1].upper), 1),
                       half_hull(loops, merged(loops, below[i].lower, below[i + 1].lower), -1)});
    }
    levels_.push_back(std::move(level));
  }
}

bool ChainExtremes::better(Line& line, std::uint32_t v, std::uint32_t than) const {
  const Position p{loops_->vertices[v].at, nullptr}, q{loops_->vertices[than].at, nullptr};
  if (const int sign = cross_sign(line.a, line.b, q, p); sign != 0) return sign > 0;
  if (const int sign = dot_sign(line.a, line.b, q, p); sign != 0) {
    line.tied = true;
    return sign == line.wanted;
  }
  const auto name = [&](std::uint32_t w) { return std::make_pair(loops_->rank[w], loops_->vertices[w].vertex); };
  return name(v) < name(than);
}

void ChainExtremes::see(Line& line, std::uint32_t v, std::uint32_t& best) const {
  if (best == kNoIndex || better(line, v, best)) best = v;
}

void ChainExtremes::see_hull(Line& line, const Hull& hull, std::uint32_t& best) const {
  // Along the half hull the distance grows, stays for one edge at most, and falls.
  const std::vector<std::uint32_t>& half = line.dx >= 0 ? hull.upper : hull.lower;
  const auto grows = [&](std::size_t i) {
    const Position p{loops_->vertices[half[i]].at, nullptr}, q{loops_->vertices[half[i + 1]].at, nullptr};
    return cross_sign(line.a, line.b, p, q) > 0;
  };
  std::size_t low = 0, high = half.size() - 1;  // the first that does not grow
  while (low < high) {
    const std::size_t midpoint = (low + high) / 2;
    if (grows(midpoint)) low = midpoint + 1;
    else high = midpoint;
  }
  see(line, half[low], best);
  if (low + 1 < half.size()) see(line, half[low + 1], best);
}

void ChainExtremes::see_run(Line& line, std::uint32_t first, std::uint32_t end, std::uint32_t& best) const {
  while (first < end) {
    if (first % kRun != 0 || end - first < kRun) {
      see(line, first++, best);
      continue;
    }
    std::size_t level = 0, at = first / kRun;
    while (at % 2 == 0 && level + 1 < levels_.size() && at / 2 < levels_[level + 1].size() &&
           (std::uint64_t(kRun) << (level + 1)) <= end - first)
      ++level, at /= 2;
    see_hull(line, levels_[level][at], best);
    first += kRun << level;
  }
}

std::uint32_t ChainExtremes::farthest_on(Line& line, const BoundaryChain& chain) const {
  const BoundaryLoop& loop = loops_->loops[chain.loop];
  std::uint32_t best = kNoIndex;
  if (chain.first <= chain.last) {
    see_run(line, chain.first, chain.last + 1, best);
  } else {
    see_run(line, chain.first, loop.last, best);
    see_run(line, loop.first, chain.last + 1, best);
  }
  return best;
}

std::uint32_t ChainExtremes::farthest(const BoundaryChain& chain, const Position& a, const Position& b) const {
  const Position zero{{0, 0}, nullptr}, up{{0, 1}, nullptr};
  Line line{a, b, cross_sign(a, b, zero, up)};
  const std::uint32_t first = farthest_on(line, chain);
  if (!line.tied) return first;
  line.wanted = 1;
  const std::uint32_t last = farthest_on(line, chain);
  return loops_->rank[last] < loops_->rank[first] ? last : first;
}

}  // namespace dymsum::shape
