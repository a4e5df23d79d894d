#include "shape/features/tracks.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <tuple>

namespace dymsum::shape {
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
