#include "shape/features/tracks.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <tuple>

namespace dymsum::shape {
namespace {

/// Node -> first node of its junction. Flat edges lie on a line, so their chains are short and simple.
std::vector<std::uint32_t> contracted(const Complex& complex) {
  std::vector<std::uint32_t> root(complex.nodes.size());
  std::iota(root.begin(), root.end(), 0u);
  const auto find = [&](std::uint32_t n) {
    while (root[n] != n) n = root[n] = root[root[n]];
    return n;
  };
  for (const Edge& e : complex.edges) {
    if (!e.flat) continue;
    const std::uint32_t a = find(e.low), b = find(e.high);
    root[std::max(a, b)] = std::min(a, b);
  }
  for (std::uint32_t n = 0; n < root.size(); ++n) root[n] = find(n);
  return root;
}

class Sweep {
 public:
  Sweep(const Complex& complex, const PocketOracle& pockets) : complex_(complex), pockets_(pockets) {
    tracks_.junctions = junctions_of(complex);
    tracks_.bar_of.assign(complex.edges.size(), kNoIndex);
    elder_.assign(complex.edges.size(), kNoIndex);
  }

  Tracks run() {
    ascend();
    for (std::uint32_t e = 0; e < complex_.edges.size(); ++e)
      if (!complex_.edges[e].flat && complex_.edges[e].high == kNoIndex)
        start(e, kNoIndex, Bar::Death::never, kNoIndex);
    for (std::size_t j = tracks_.junctions.size(); j-- > 0;) descend(std::uint32_t(j));
    order();
    return std::move(tracks_);
  }

 private:
  std::uint32_t rank_of(const Junction& j) const { return complex_.nodes[j.nodes.front()].rank; }

  /// elder_: edge -> rank of the oldest birth below it.
  void ascend() {
    for (const Junction& j : tracks_.junctions) {
      if (!j.in.empty() && j.out.size() > 1) throw std::logic_error("a track of the complex splits");
      std::uint32_t oldest = rank_of(j);
      for (const std::uint32_t e : j.in) oldest = std::min(oldest, elder_[e]);
      for (const std::uint32_t e : j.out) elder_[e] = oldest;
    }
  }

  /// A bar that ends at junction `end` on edge `last`.
  void start(std::uint32_t last, std::uint32_t end, Bar::Death death, std::uint32_t parent) {
    Bar bar;
    bar.death = death;
    bar.end = end;
    bar.last = last;
    bar.parent = parent;
    const PocketMinimumAt minimum = pockets_.deepest(last);
    bar.minimum = minimum.vertex;
    bar.concavity = minimum.concavity;
    tracks_.bar_of[last] = std::uint32_t(tracks_.bars.size());
    tracks_.bars.push_back(bar);
  }

  /// Junctions are passed from the last to the first: bars are known above each of them.
  void descend(std::uint32_t index) {
    const Junction& j = tracks_.junctions[index];
    if (j.in.empty()) {
      for (const std::uint32_t e : j.out) {
        tracks_.bars[tracks_.bar_of[e]].birth = index;
        tracks_.bars[tracks_.bar_of[e]].first = e;
      }
      return;
    }
    if (j.out.empty()) {
      for (const std::uint32_t e : j.in) start(e, index, Bar::Death::filled, kNoIndex);
      return;
    }
    const std::uint32_t bar = tracks_.bar_of[j.out.front()], on = continuing(j, bar);
    tracks_.bar_of[on] = bar;
    for (const std::uint32_t e : j.in)
      if (e != on) start(e, index, Bar::Death::merged, bar);
  }

  std::uint32_t continuing(const Junction& j, std::uint32_t index) {
    if (j.in.size() == 1) return j.in.front();
    Bar& bar = tracks_.bars[index];
    const std::uint32_t oldest = elder_[j.out.front()];
    std::vector<std::uint32_t> old;
    for (const std::uint32_t e : j.in)
      if (elder_[e] == oldest) old.push_back(e);
    std::sort(old.begin(), old.end(), [this](std::uint32_t a, std::uint32_t b) {
      const auto name_a = name(a), name_b = name(b);
      return name_a != name_b ? name_a < name_b : a < b;
    });
    for (const std::uint32_t e : old)
      if (bar.minimum != kNoIndex && pockets_.holds(e, bar.minimum)) return e;
    // The minimum belongs to a younger bar, or there is none: from here on it is that of the older one's own pocket.
    std::uint32_t best = old.front();
    PocketMinimumAt deepest = pockets_.deepest(best);
    for (const std::uint32_t e : old) {
      const PocketMinimumAt other = pockets_.deepest(e);
      if (other.concavity > deepest.concavity) best = e, deepest = other;
    }
    if (deepest.vertex == kNoIndex) return best;
    bar.minimum = deepest.vertex;
    bar.concavity = deepest.concavity;
    return best;
  }

  /// Of an edge, for ties: an edge begins where its bar is born.
  std::tuple<std::uint32_t, std::array<std::uint32_t, 4>> name(std::uint32_t edge) const {
    return {complex_.nodes[complex_.edges[edge].low].rank, pockets_.contacts(edge)};
  }

  bool before_in_list(const Bar& a, const Bar& b) const {
    const auto birth_a = name(a.first), birth_b = name(b.first);
    if (birth_a != birth_b) return birth_a < birth_b;
    const auto death = [this](const Bar& bar) {
      return bar.end == kNoIndex ? kNoIndex : rank_of(tracks_.junctions[bar.end]);
    };
    return std::make_tuple(death(a), a.death, a.concavity, a.first) <
           std::make_tuple(death(b), b.death, b.concavity, b.first);
  }

  void order() {
    std::vector<std::uint32_t> sorted(tracks_.bars.size()), place(sorted.size());
    std::iota(sorted.begin(), sorted.end(), 0u);
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
      return before_in_list(tracks_.bars[a], tracks_.bars[b]);
    };
    std::sort(sorted.begin(), sorted.end(), before);
    for (std::uint32_t i = 0; i < sorted.size(); ++i) place[sorted[i]] = i;
    std::vector<Bar> bars;
    for (const std::uint32_t i : sorted) bars.push_back(tracks_.bars[i]);
    for (Bar& bar : bars)
      if (bar.parent != kNoIndex) bar.parent = place[bar.parent];
    for (std::uint32_t& bar : tracks_.bar_of)
      if (bar != kNoIndex) bar = place[bar];
    tracks_.bars = std::move(bars);
  }

  const Complex& complex_;
  const PocketOracle& pockets_;
  Tracks tracks_;
  std::vector<std::uint32_t> elder_;
};

}  // namespace

std::vector<Junction> junctions_of(const Complex& complex) {
  const std::vector<std::uint32_t> root = contracted(complex);
  std::vector<std::uint32_t> place(root.size(), kNoIndex);
  std::vector<Junction> junctions;
  for (std::uint32_t n = 0; n < root.size(); ++n) {
    if (root[n] == n) {
      place[n] = std::uint32_t(junctions.size());
      junctions.emplace_back();
    }
    junctions[place[root[n]]].nodes.push_back(n);
  }
  for (std::uint32_t e = 0; e < complex.edges.size(); ++e) {
    const Edge& edge = complex.edges[e];
    if (edge.flat) continue;
    junctions[place[root[edge.low]]].out.push_back(e);
    if (edge.high != kNoIndex) junctions[place[root[edge.high]]].in.push_back(e);
  }
  return junctions;
}

Tracks tracks_of(const Complex& complex, const PocketOracle& pockets) { return Sweep(complex, pockets).run(); }

}  // namespace dymsum::shape
