#include "shape/features/since.h"

#include <algorithm>
#include <cmath>

#include "exact/interval.h"

namespace dymsum::shape {
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

}  // namespace dymsum::shape
