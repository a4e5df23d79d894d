#include "shape/features/tracks.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <tuple>

#include "base/scratch.h"
#include "exact/interval.h"

namespace dymsum::shape {
namespace {

/// Node -> first node of its junction. Flat edges lie on a line, so their chains are short and simple.
std::vector<std::uint32_t> contracted(const Complex& complex) {
  UnionFind junctions(static_cast<std::uint32_t>(complex.nodes.size()));
  for (const Edge& e : complex.edges) {
    if (!e.flat) continue;
    const auto [first, second] = std::minmax({junctions.root(e.low), junctions.root(e.high)});
    junctions.unite(second, first);
  }
  std::vector<std::uint32_t> root(complex.nodes.size());
  for (std::uint32_t n = 0; n < root.size(); ++n) root[n] = junctions.root(n);
  return root;
}

}  // namespace

std::vector<Junction> junctions_of(const Complex& complex) {
  const std::vector<std::uint32_t> root = contracted(complex);
  std::vector<std::uint32_t> position(root.size(), kNoIndex);
  std::vector<Junction> junctions;
  for (std::uint32_t n = 0; n < root.size(); ++n) {
    if (root[n] == n) {
      position[n] = std::uint32_t(junctions.size());
      junctions.emplace_back();
    }
    junctions[position[root[n]]].nodes.push_back(n);
  }
  for (std::uint32_t e = 0; e < complex.edges.size(); ++e) {
    const Edge& edge = complex.edges[e];
    if (edge.flat) continue;
    junctions[position[root[edge.low]]].out.push_back(e);
    if (edge.high != kNoIndex) junctions[position[root[edge.high]]].in.push_back(e);
  }
  return junctions;
}

namespace {

using exact::Interval;
using exact::RootExpression;

template <class N>
N radius_as(const Complex& complex, std::uint32_t node);
template <>
Interval radius_as(const Complex& complex, std::uint32_t node) {
  const double r = complex.nodes[node].radius;  // the nearest double
  return complex.nodes[node].kind == Node::Kind::corner ? Interval(0)
                                                        : Interval(std::nextafter(r, -1), std::nextafter(r, INFINITY));
}
template <>
RootExpression radius_as(const Complex& complex, std::uint32_t node) {
  return exact_radius(complex, node);
}

template <class N>
N half(const Complex& complex, const Since& since) {
  const N radius = radius_as<N>(complex, since.node);
  return since.depth == 0 ? radius : radius - N(kAgePerDepth / 2) * N(since.depth);
}

/// Half of what a track is worth at a node.
template <class N>
N half_worth(const Complex& complex, std::uint32_t node, const TrackWorth& worth, bool by_depth) {
  if (by_depth) return N(*worth.depth) / N(2);
  return radius_as<N>(complex, node) - half<N>(complex, worth.since);
}

/// The sign of a - b, each a template over the number type.
template <class A, class B>
int difference_sign(const A& a, const B& b) {
  const Interval x = a(Interval()), y = b(Interval());
  if (x.low() > y.high()) return 1;
  if (x.high() < y.low()) return -1;
  return exact::compare(a(RootExpression()), b(RootExpression()));
}

bool alike(const Complex& complex, const Since& a, const Since& b) {
  return a.depth == b.depth && complex.nodes[a.node].rank == complex.nodes[b.node].rank;
}

bool counts_by_depth(const Complex& complex, std::uint32_t node, const TrackWorth& worth) {
  if (!worth.depth) return false;
  return difference_sign([&](auto n) { return half_worth<decltype(n)>(complex, node, worth, true); },
                         [&](auto n) { return half_worth<decltype(n)>(complex, node, worth, false); }) < 0;
}

/// Goes through the edges, inlets before what they lead to.
class SinceSearch {
 public:
  SinceSearch(const Complex& complex, const std::vector<Junction>& junctions, const PocketOracle& pockets)
      : complex_(complex), junctions_(junctions), pockets_(pockets) {
    const std::size_t n = complex.edges.size();
    since_.resize(n);
    low_.resize(n, kNoIndex);
    high_.resize(n, kNoIndex);
    state_.resize(n, State::open);
    for (std::uint32_t j = 0; j < junctions.size(); ++j) {
      for (const std::uint32_t e : junctions[j].out) low_[e] = j;
      for (const std::uint32_t e : junctions[j].in) high_[e] = j;
    }
  }

  std::vector<Since> run() {
    for (const Junction& j : junctions_)
      for (const std::uint32_t e : j.out) settle(e);
    return std::move(since_);
  }

 private:
  enum class State : std::uint8_t { open, entered, settled };

  void settle(std::uint32_t edge) {
    std::vector<std::uint32_t> stack{edge};
    while (!stack.empty()) {
      const std::uint32_t e = stack.back();
      const std::vector<std::uint32_t> inlets = inlets_before(e);
      if (state_[e] == State::open) {
        state_[e] = State::entered;
        for (const std::uint32_t i : inlets)
          if (state_[i] == State::open) stack.push_back(i);
        continue;
      }
      if (state_[e] == State::entered) {
        since_[e] = at_outer_end(e, inlets);
        state_[e] = State::settled;
      }
      stack.pop_back();
    }
  }

  bool is_ahead(std::uint32_t e) const { return pockets_.at(e) == PocketAt::ahead; }
  const Junction& inner(std::uint32_t e) const { return junctions_[is_ahead(e) ? high_[e] : low_[e]]; }

  /// What enters the junction that the edge leaves.
  std::vector<std::uint32_t> inlets_before(std::uint32_t e) const {
    if (is_ahead(e) && high_[e] == kNoIndex) return {};
    std::vector<std::uint32_t> inlets = inlets_of(inner(e), pockets_);
    const bool gap = pockets_.at(e) == PocketAt::gap;
    std::erase_if(inlets, [&](std::uint32_t i) { return i == e || (gap && pockets_.at(i) != PocketAt::gap); });
    return inlets;
  }

  Since at_outer_end(std::uint32_t e, const std::vector<std::uint32_t>& inlets) const {
    const bool ahead = is_ahead(e);
    const Since own{junctions_[ahead && high_[e] != kNoIndex ? high_[e] : low_[e]].node(), 0};
    Since least = own;
    for (const std::uint32_t i : inlets)
      if (state_[i] == State::settled && compare(complex_, since_[i], least) < 0) least = since_[i];
    if (ahead) {
      const Since end{junctions_[low_[e]].node(), 0};
      return compare(complex_, end, least) < 0 ? end : least;
    }
    if (high_[e] == kNoIndex || pockets_.at(e) == PocketAt::gap || junctions_[high_[e]].in.size() < 2) return least;
    const Since shallow{complex_.edges[e].high, pockets_.deepest(e).concavity};
    return compare(complex_, shallow, least) > 0 ? shallow : least;
  }

  const Complex& complex_;
  const std::vector<Junction>& junctions_;
  const PocketOracle& pockets_;
  std::vector<Since> since_;
  std::vector<std::uint32_t> low_, high_;  ///< edge -> junction
  std::vector<State> state_;
};

}  // namespace

RootExpression half_of(const Complex& complex, const Since& since) { return half<RootExpression>(complex, since); }

int compare(const Complex& complex, const Since& a, const Since& b) {
  if (alike(complex, a, b)) return 0;
  return difference_sign([&](auto n) { return half<decltype(n)>(complex, a); },
                         [&](auto n) { return half<decltype(n)>(complex, b); });
}

int compare_at(const Complex& complex, std::uint32_t node, const TrackWorth& a, const TrackWorth& b) {
  const bool x = counts_by_depth(complex, node, a), y = counts_by_depth(complex, node, b);
  if (x && y) return *a.depth < *b.depth ? -1 : *a.depth > *b.depth ? 1 : 0;
  if (!x && !y && alike(complex, a.since, b.since)) return 0;
  return difference_sign([&](auto n) { return half_worth<decltype(n)>(complex, node, a, x); },
                         [&](auto n) { return half_worth<decltype(n)>(complex, node, b, y); });
}

std::vector<Since> since_of(const Complex& complex, const std::vector<Junction>& junctions,
                            const PocketOracle& pockets) {
  return SinceSearch(complex, junctions, pockets).run();
}

std::vector<std::uint32_t> inlets_of(const Junction& junction, const PocketOracle& pockets) {
  std::vector<std::uint32_t> inlets;
  for (const std::uint32_t e : junction.in)
    if (pockets.at(e) != PocketAt::ahead) inlets.push_back(e);
  for (const std::uint32_t e : junction.out)
    if (pockets.at(e) == PocketAt::ahead) inlets.push_back(e);
  return inlets;
}

namespace {

class Sweep {
 public:
  Sweep(const Complex& complex, const PocketOracle& pockets) : complex_(complex), pockets_(pockets) {
    deepest_.resize(complex.edges.size());
    pockets_.deepest = [this, queried = pockets.deepest](std::uint32_t e) {
      if (!deepest_[e]) deepest_[e] = queried(e);
      return *deepest_[e];
    };
    tracks_.junctions = junctions_of(complex);
    tracks_.bar_of.assign(complex.edges.size(), kNoIndex);
    for (const Junction& j : tracks_.junctions)
      if (!j.in.empty() && j.out.size() > 1) throw std::logic_error("a track of the complex splits");
    since_ = since_of(complex, tracks_.junctions, pockets_);
  }

  Tracks run() {
    for (std::uint32_t e = 0; e < complex_.edges.size(); ++e)
      if (!complex_.edges[e].flat && complex_.edges[e].high == kNoIndex)
        start(e, kNoIndex, Bar::Death::never, kNoIndex);
    for (std::size_t j = tracks_.junctions.size(); j-- > 0;) descend(std::uint32_t(j));
    count_from_necks();
    order();
    return std::move(tracks_);
  }

 private:
  std::uint32_t rank_of(const Junction& j) const { return complex_.nodes[j.node()].rank; }

  TrackWorth worth_of(std::uint32_t edge) const {
    if (pockets_.at(edge) != PocketAt::behind) return {since_[edge], std::nullopt};
    return {since_[edge], pockets_.deepest(edge).concavity};
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
    bar.worth = {since_[last], std::nullopt};
    if (pockets_.at(last) != PocketAt::gap) bar.worth.depth = minimum.concavity;
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
    std::uint32_t on = kNoIndex, bar = kNoIndex;
    if (!j.out.empty()) {
      bar = tracks_.bar_of[j.out.front()];
      on = continuing(j, bar);
      tracks_.bar_of[on] = bar;
    }
    for (const std::uint32_t e : j.in)
      if (e != on) start(e, index, bar == kNoIndex ? Bar::Death::filled : Bar::Death::merged, bar);
    share_worth(j, on);
  }

  /// The edge whose track goes on as the bar above.
  std::uint32_t continuing(const Junction& j, std::uint32_t index) {
    if (j.in.size() == 1) return j.in.front();
    Bar& bar = tracks_.bars[index];
    for (const std::uint32_t e : j.in)
      if (bar.minimum != kNoIndex && pockets_.holds(e, bar.minimum)) return e;
    std::vector<std::uint32_t> able = j.in;
    const auto is_pocket = [this](std::uint32_t e) { return pockets_.at(e) != PocketAt::gap; };
    if (!std::all_of(able.begin(), able.end(), is_pocket)) std::erase_if(able, is_pocket);
    const std::uint32_t best = worthiest(j, able);
    // All are pockets, and none has the minimum: the bar is named after what is left to it.
    if (const PocketMinimumAt own = pockets_.deepest(best); own.vertex != kNoIndex) {
      bar.minimum = own.vertex;
      bar.concavity = own.concavity;
    }
    return best;
  }

  /// What counts most at a junction; among equals the one with the least name.
  std::uint32_t worthiest(const Junction& j, const std::vector<std::uint32_t>& edges) const {
    std::uint32_t best = edges.front();
    for (const std::uint32_t e : edges) {
      if (e == best) continue;
      const int sign = compare_at(complex_, j.node(), worth_of(e), worth_of(best));
      if (sign > 0 || (sign == 0 && std::make_pair(name(e), e) < std::make_pair(name(best), best))) best = e;
    }
    return best;
  }

  /// Of the pockets that enter a junction, what counts most goes on with its outlet: a bar that ends there although it
  /// counts most is worth what the one is that goes on in its place. At a full pocket it goes on down to the neck, and
  /// the bar is worth no more than what ends with the neck.
  void share_worth(const Junction& j, std::uint32_t on) {
    std::vector<std::uint32_t> inlets = inlets_of(j, pockets_);
    std::uint32_t outlet = kNoIndex;
    for (const std::uint32_t e : j.in)
      if (pockets_.at(e) == PocketAt::ahead) outlet = e;
    if (outlet == kNoIndex && (j.out.empty() || pockets_.at(j.out.front()) == PocketAt::gap)) return;
    if (inlets.empty()) return;
    std::uint32_t best = worthiest(j, inlets);
    const auto ends = [&](std::uint32_t e) {
      return complex_.edges[e].high != kNoIndex && e != on && std::find(j.in.begin(), j.in.end(), e) != j.in.end();
    };
    std::uint32_t stays = on;  // the inlet that goes on
    if (outlet != kNoIndex) stays = j.out.empty() ? kNoIndex : j.out.front();
    if (!ends(best) || best == stays) return;
    Bar& bar = tracks_.bars[tracks_.bar_of[best]];
    if (stays != kNoIndex) bar.worth = worth_of(stays);
    else bar.until_neck_of = tracks_.bar_of[outlet];
  }

  /// A bar that ends where its pocket lies ahead counts from its birth.
  void count_from_necks() {
    const auto birth_of = [&](const Bar& bar) { return Since{tracks_.junctions[bar.birth].node(), 0}; };
    for (Bar& bar : tracks_.bars)
      if (pockets_.at(bar.last) == PocketAt::ahead) bar.worth.since = birth_of(bar);
    for (Bar& bar : tracks_.bars) {
      if (bar.until_neck_of == kNoIndex) continue;
      const Since neck = birth_of(tracks_.bars[bar.until_neck_of]);
      if (compare(complex_, bar.worth.since, neck) < 0) bar.worth.since = neck;
    }
  }

  /// The name of an edge, for ties: an edge begins where its bar is born.
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
    std::vector<std::uint32_t> sorted(tracks_.bars.size()), position(sorted.size());
    std::iota(sorted.begin(), sorted.end(), 0u);
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
      return before_in_list(tracks_.bars[a], tracks_.bars[b]);
    };
    std::sort(sorted.begin(), sorted.end(), before);
    for (std::uint32_t i = 0; i < sorted.size(); ++i) position[sorted[i]] = i;
    std::vector<Bar> bars;
    for (const std::uint32_t i : sorted) bars.push_back(tracks_.bars[i]);
    for (Bar& bar : bars)
      if (bar.parent != kNoIndex) bar.parent = position[bar.parent];
    for (std::uint32_t& bar : tracks_.bar_of)
      if (bar != kNoIndex) bar = position[bar];
    tracks_.bars = std::move(bars);
  }

  const Complex& complex_;
  PocketOracle pockets_;  ///< remembers what is deepest
  std::vector<std::optional<PocketMinimumAt>> deepest_;
  Tracks tracks_;
  std::vector<Since> since_;
};

}  // namespace

Tracks tracks_of(const Complex& complex, const PocketOracle& pockets) { return Sweep(complex, pockets).run(); }

}  // namespace dymsum::shape
