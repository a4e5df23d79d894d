#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "shape/complex/assemble.h"
#include "shape/complex/congruence.h"

namespace dymsum::shape {
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
